// SPDX-License-Identifier: GPL-3.0-or-later
// The commands of scripts: what they leave in the scene, and what they say to wrong arguments.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "parse_sipp/sipp_objects.h"
#include "parse_sipp/sipp_shapes.h"
#include "parse_sipp/sipp_transform.h"
#include "scene/merge.h"
#include "scene/traverse.h"
#include "shading/procedural_shaders.h"
#include "unit/parse_sipp/script_scene.h"

namespace farop::test {
namespace {

using Lines = std::vector<std::string>;
using std::numbers::pi;

const std::string k_shader = "set s [SippShaderBasic 0.1 0.2 0.3 {0.4 0.5 0.6}]\n";

const Surface& only_surface(const ScriptRun& run) {
  const Object* object = &run.world();
  while (object->surfaces.empty()) object = object->children.at(0).get();
  return *object->surfaces.at(0);
}

// ---- shaders ----

std::string description(const std::string& shader) {
  const ScriptRun run =
      run_script("set b [SippShaderPhong .1 .2 .3 4 {1 0 0}]\nSippObjectAddSubobj WORLD [SippCube 1 [" +
                 shader + "]]\n");
  EXPECT_EQ(run.error(), "") << shader;
  return run.scene ? only_surface(run).shader->describe() : "";
}

TEST(TclShaders, ArriveWithEveryParameter) {
  EXPECT_EQ(description("SippShaderBasic .1 .2 .3 {.4 .5 .6}"),
            BasicShader({.1, .2, .3, {.4, .5, .6}, {1, 1, 1}}).describe());
  EXPECT_EQ(description("SippShaderBasic .1 .2 .3 {.4 .5 .6} .25"),
            BasicShader({.1, .2, .3, {.4, .5, .6}, {.25, .25, .25}}).describe());
  EXPECT_EQ(description("SippShaderPhong .1 .2 .3 40 {.4 .5 .6} {.7 .8 .9}"),
            PhongShader({.1, .2, .3, 40, {.4, .5, .6}, {.7, .8, .9}}).describe());
  EXPECT_EQ(description("SippShaderStrauss .1 .2 .3 {.4 .5 .6} .9"),
            StraussShader({.1, .2, .3, {.4, .5, .6}, {.9, .9, .9}}).describe());
  const PatternFinish finish{.1, .2, .3, {.5, .5, .5}};
  EXPECT_EQ(description("SippShaderWood .1 .2 .3 7 {1 0 0} {0 1 0} .5"),
            WoodShader(finish, {7, {1, 0, 0}, {0, 1, 0}}).describe());
  EXPECT_EQ(description("SippShaderMarble .1 .2 .3 7 {1 0 0} {0 1 0} .5"),
            MarbleShader(finish, {7, {1, 0, 0}, {0, 1, 0}}).describe());
  EXPECT_EQ(description("SippShaderGranite .1 .2 .3 7 {1 0 0} {0 1 0} .5"),
            GraniteShader(finish, {7, {1, 0, 0}, {0, 1, 0}}).describe());
  EXPECT_EQ(description("SippShaderPlanet .1 .2 .3 .5"), PlanetShader(finish, {}).describe());
  const std::string bozo = BozoShader(finish, {7, {{1, 0, 0}, {0, 0, 1}}}).describe();
  EXPECT_EQ(description("SippShaderBozo {{1 0 0} {0 0 1}} .1 .2 .3 7 .5"), bozo);
  EXPECT_EQ(description("SippShaderBozo .1 .2 .3 7 {{1 0 0} {0 0 1}} .5"), bozo);
  const auto inner = std::make_shared<PhongShader>(PhongParameters{.1, .2, .3, 4, {1, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(description("SippShaderBumpy $b 5"), BumpyShader(inner, {5, true, true}).describe());
  EXPECT_EQ(description("SippShaderBumpy $b 5 HOLES"), BumpyShader(inner, {5, false, true}).describe());
  EXPECT_EQ(description("SippShaderBumpy $b 5 bumps"), BumpyShader(inner, {5, true, false}).describe());
}

TEST(TclShaders, AreBoundLateAndApproximatedAtTheEnd) {
  const ScriptRun run =
      run_script(k_shader +
                 "SippPolygonPush {{0 0 0} {1 0 0} {0 1 0}}\nset f [SippSurfaceCreate $s]\n"
                 "set o [SippObjectCreate]\nSippObjectAddSurface $o $f\nSippObjectAddSubobj WORLD $o\n"
                 "SippSurfaceSetShader $f [SippShaderPhong .1 .2 .3 4 {.5 .6 .7}]\nSippShaderUnref ALL\n"
                 "SippSurfaceUnref ALL\n");
  ASSERT_TRUE(run.scene) << run.error();
  EXPECT_TRUE(only_surface(run).shader->describe().starts_with("phong"));
  EXPECT_EQ(only_surface(run).material.color, (Rgb{.5, .6, .7}));
  EXPECT_EQ(only_surface(run).material.kd, .2);
}

// ---- polygons ----

TEST(TclPolygons, TakeNormalsTexturesAndBothOrders) {
  const ScriptRun run = run_script(
      "set s [SippShaderMarble 0 0 1 1 {1 1 1} {0 0 0}]\nset o [SippObjectCreate]\nSippObjectAddSubobj WORLD "
      "$o\n"
      "SippPolygonPush -clock -norm -tex {{{0 0 0} {0 0 2} {.1 .2 .3}} {{0 1 0} {0 0 3} {.4 .5 .6}} {{1 0 0} "
      "{0 0 4} {.7 .8 .9}}}\n"
      "SippObjectSurfaceCreate $o $s\n");
  ASSERT_TRUE(run.scene) << run.error();
  const Surface& f = only_surface(run);
  ASSERT_EQ(f.positions.size(), 3u);
  EXPECT_EQ(f.positions[0], V3d(1, 0, 0));  // pushed from the end
  EXPECT_EQ(f.positions[2], V3d(0, 0, 0));
  EXPECT_EQ(f.averaged_normals[0], V3d(0, 0, 1));
  EXPECT_EQ(f.textures[0], V3f(.7f, .8f, .9f));
  EXPECT_EQ(f.normal_rule, NormalRule::sipp);
}

TEST(TclPolygons, OfAFailedPushLeaveNothingBehind) {
  const ScriptRun run = run_script(k_shader +
                                   "catch {SippPolygonPush {{0 0 0} {5 0 0} {0 x 0}}}\n"
                                   "SippPolygonPush {{0 0 0} {1 0 0} {0 1 0}}\nset o [SippObjectCreate]\n"
                                   "SippObjectSurfaceCreate $o $s\nSippObjectAddSubobj WORLD $o\n");
  ASSERT_TRUE(run.scene) << run.error();
  EXPECT_EQ(only_surface(run).polygons.size(), 1u);
  EXPECT_EQ(only_surface(run).positions.size(), 3u);
}

TEST(TclPolygons, ShapesAreThoseOfTheModel) {
  const ScriptRun run = run_script(
      "set s [SippShaderPlanet .1 .2 .3]\nSippObjectAddSubobj WORLD [SippTorus 1 .25 12 8 $s NATURAL]\n");
  ASSERT_TRUE(run.scene) << run.error();
  sipp::ShapeLook look;
  look.texture = sipp::TextureMapping::natural;
  look.shader = std::make_shared<PlanetShader>(PatternFinish{.1, .2, .3, {1, 1, 1}}, PlanetPattern{});
  const auto torus = sipp::torus(1, .25, 12, 8, look);
  EXPECT_EQ(only_surface(run), *torus->surfaces.at(0));
}

// ---- objects ----

TEST(TclObjects, MakeATreeWithNames) {
  const ScriptRun run =
      run_script(k_shader +
                 "set a [SippObjectCreate]\nset b [SippCube 1 $s]\nSippObjectMove $b {1 2 3}\n"
                 "SippObjectAddSubobj $a $b\nSippObjectAddSubobj WORLD [list $a $a $b]\n");
  ASSERT_TRUE(run.scene) << run.error();
  const Object& world = run.world();
  EXPECT_EQ(world.name, "test");
  ASSERT_EQ(world.children.size(), 3u);
  EXPECT_EQ(world.children[0], world.children[1]);  // one object in two places
  EXPECT_EQ(world.children[0]->name, "object0");
  EXPECT_EQ(world.children[0]->children.at(0), world.children[2]);
  EXPECT_EQ(world.children[2]->to_parent[3][1], 2);
  EXPECT_EQ(run.scene->inputs.at(0).format, "sipp");
  EXPECT_EQ(run.scene->inputs.at(0).polygons, 18u);
}

TEST(TclObjects, CopiesShareWhatTheirCommandSays) {
  const ScriptRun run =
      run_script(k_shader +
                 "set a [SippObjectCreate]\nset b [SippCube 1 $s]\nSippObjectMove $b {1 2 3}\n"
                 "SippObjectAddSubobj $a $b\nSippObjectMove $a {1 0 0}\n"
                 "SippObjectAddSubobj WORLD [list $a [SippObjectInstance $a] [SippObjectDup $a] "
                 "[SippObjectDeepDup $a]]\n");
  ASSERT_TRUE(run.scene) << run.error();
  const auto& c = run.world().children;
  const auto part = [&](int i) { return c.at(i)->children.at(0); };
  EXPECT_EQ(c[1]->to_parent, M44d());
  EXPECT_EQ(part(1), part(0));
  EXPECT_NE(part(2), part(0));
  EXPECT_EQ(part(2)->surfaces, part(0)->surfaces);
  EXPECT_EQ(part(2)->to_parent, M44d());
  EXPECT_NE(part(3)->surfaces[0], part(0)->surfaces[0]);
  EXPECT_EQ(*part(3)->surfaces[0], *part(0)->surfaces[0]);
}

TEST(TclObjects, TakenAwayTheLastOneFillsTheHole) {
  EXPECT_EQ(prints("foreach n {a b c d} {set $n [SippObjectCreate]; SippObjectAddSubobj WORLD [set $n]}\n"
                   "SippObjectSubSubobj WORLD $b\nputs [catch {SippObjectSubSubobj WORLD $b} m]\nputs $m\n"),
            (Lines{"1", "SippObjectSubSubobj: 'object1' is no sub-object of 'WORLD'"}));
  const ScriptRun run = run_script(
      "foreach n {a b c d} {set $n [SippObjectCreate]; SippObjectAddSubobj WORLD [set $n]}\n"
      "SippObjectSubSubobj WORLD $b\n");
  Lines names;
  for (const auto& child : run.world().children) names.push_back(child->name);
  EXPECT_EQ(names, (Lines{"object0", "object3", "object2"}));
}

TEST(TclObjects, AncestorIsTheNearestWithAHandle) {
  EXPECT_EQ(prints("foreach n {a b c} {set $n [SippObjectCreate]}\nSippObjectAddSubobj $a "
                   "$b\nSippObjectAddSubobj $b $c\n"
                   "SippObjectAddSubobj WORLD $a\nputs [SippObjectAncestor $c]\nSippObjectUnref $b\n"
                   "puts [SippObjectAncestor $c]\nputs <[SippObjectAncestor $a]>\n"),
            (Lines{"object1", "object0", "<>"}));
}

TEST(TclObjects, LiveOnBelowOthersWithoutAHandle) {
  const ScriptRun run =
      run_script(k_shader + "set a [SippCube 1 $s]\nSippObjectAddSubobj WORLD $a\nSippObjectUnref ALL\n");
  ASSERT_TRUE(run.scene) << run.error();
  EXPECT_EQ(totals(*run.scene).polygons, 6u);
}

/// A transformation of a parent equals the same transformation of every descendant's place in the world.
TEST(TclObjects, ATransformationReachesAllDescendants) {
  const std::string tree =
      k_shader +
      "proc grow {depth} {\n  set o [SippCube 1 $::s]\n  SippObjectRotateX $o D[expr {10 * $depth}]\n"
      "  SippObjectMove $o {0.3 0.1 1}\n  SippObjectScale $o {1 1.5 0.8}\n  if {$depth > 0} {\n"
      "    foreach a {30 120} {\n      set part [grow [expr {$depth - 1}]]\n"
      "      SippObjectRotateZ $part D$a\n      SippObjectAddSubobj $o $part\n    }\n  }\n"
      "  return $o\n}\nset top [grow 4]\nSippObjectAddSubobj WORLD $top\n";
  const std::string moves =
      "SippObjectRotate $o {1 2 3} {1 -1 0.5} R0.7\nSippObjectMove $o 1 2 -3\nSippObjectScale $o 0.5 2 1\n";
  const auto placements = [](const ScriptRun& run) {
    std::vector<M44d> all;
    for_each_surface(*run.scene, [&](const SurfacePlacement& p) { all.push_back(p.local_to_world); });
    return all;
  };
  const ScriptRun still = run_script(tree), moved = run_script(tree + "set o $top\n" + moves);
  ASSERT_TRUE(still.scene && moved.scene) << moved.error();
  M44d by;
  sipp::rotate(by, {1, 2, 3}, {1, -1, .5}, .7);
  sipp::translate(by, {1, 2, -3});
  sipp::scale(by, {.5, 2, 1});
  const std::vector<M44d> before = placements(still), after = placements(moved);
  ASSERT_EQ(before.size(), 31u * 6);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE((before[i] * by).equalWithAbsError(after[i], 1e-12)) << i;
  }
}

TEST(TclObjects, AreTransformedByRadiansDegreesAndLists) {
  const std::string m = "puts [lindex [SippObjectGetTransf $a] 0]\n";
  EXPECT_EQ(
      prints("set a [SippObjectCreate]\nset b [SippObjectCreate]\nSippObjectRotateZ [list $a $b] D90\n" + m +
             "SippObjectRotateZ $a D-90\n" + m + "SippObjectScale $a 2\n" + m + "SippObjectClearTransf $a\n" +
             m + "SippObjectRotateY $b R0\nputs [lindex [SippObjectGetTransf $b] 1]\n"),
      (Lines{"0.0 1.0 0.0 0.0", "1.0 0.0 0.0 0.0", "2.0 0.0 0.0 0.0", "1.0 0.0 0.0 0.0",
             "-1.0 0.0 0.0 0.0"}));
  const ScriptRun run =
      run_script("set a [SippObjectCreate]\nSippObjectAddSubobj WORLD $a\nSippObjectRotateX $a 1\n");
  EXPECT_NEAR(run.world().children.at(0)->to_parent[1][1], std::cos(1.0), 1e-15);
}

// ---- lights and cameras ----

TEST(TclLights, ComeNewestFirstWithAllTheyHave) {
  const ScriptRun run = run_script(
      "SippLightSourceCreate {0 0 2} {1 .5 2}\nset p [SippLightSourceCreate {1 2 3} {.1 .2 .3} POINT]\n"
      "SippSpotLightCreate {0 0 5} {0 0 1} 30 {1 1 1} SOFT 1\nset q [SippSpotLightCreate {0 0 5} {0 0 1} "
      "R0.5 {1 1 1} SHARP]\n"
      "SippShadows 1 512\nSippLightActive $p 0\nSippSpotLightAt $q {1 1 1}\nSippSpotLightAt $p {9 9 9}\n"
      "SippLightSourcePut $p {4 5 6}\nset x [SippLightSourceCreate {1 0 0} {1 1 1}]\nSippLightDestruct $x\n");
  ASSERT_TRUE(run.scene) << run.error();
  const auto& l = run.scene->lights;
  ASSERT_EQ(l.size(), 4u);
  EXPECT_EQ(l[0].kind, LightKind::spot_sharp);
  EXPECT_NEAR(l[0].opening_degrees, .5 * 180 / pi, 1e-12);
  EXPECT_EQ(l[0].target, V3d(1, 1, 1));
  EXPECT_FALSE(l[0].casts_shadows);
  EXPECT_EQ(l[1].kind, LightKind::spot_soft);
  EXPECT_NEAR(l[1].opening_degrees, 30, 1e-12);
  EXPECT_TRUE(l[1].casts_shadows);
  EXPECT_EQ(l[1].shadow_size, 512);
  EXPECT_EQ(l[2].kind, LightKind::point);
  EXPECT_EQ(l[2].position, V3d(4, 5, 6));
  EXPECT_EQ(l[2].target, Light{}.target);
  EXPECT_FALSE(l[2].active);
  EXPECT_EQ(l[3].kind, LightKind::directional);
  EXPECT_EQ(l[3].position, V3d(0, 0, 1));
  EXPECT_EQ(*l[3].color, (Rgb{1, .5, 2}));
}

TEST(TclCamera, InUseAtTheRequestMakesTheView) {
  const ScriptRun run = run_script(
      "set c [SippCameraCreate {1 2 3} {} {0 0 1} 0.5]\nset d [SippCameraCreate]\nSippCameraUse "
      "$d\nSippCameraUse $c\n"
      "SippCameraParams $c {} {1 2 13}\nSippBackground {.1 .2 .3}\nSippShowBackFaces t\n"
      "SippRender [SippPBMOpen a.ppm w] 300 200 FLAT 4\nSippCameraParams $c {0 0 0}\nerror {not reached}\n");
  ASSERT_TRUE(run.scene) << run.error();
  const ViewParameters& v = run.scene->view;
  EXPECT_EQ(*v.from, V3d(1, 2, 3));
  EXPECT_EQ(*v.at, V3d(1, 2, 13));
  EXPECT_EQ(*v.up, V3d(0, 0, 1));
  EXPECT_NEAR(*v.angle, 2 * std::atan(.5) * 180 / pi, 1e-12);
  EXPECT_EQ(*v.fit, Fit::smaller);
  EXPECT_NEAR(*v.hither, .1, 1e-15);
  EXPECT_NEAR(*v.yon, 1000, 1e-9);
  EXPECT_TRUE(*v.fit_depth);
  EXPECT_EQ(*v.resolution, (ViewParameters::Size{300, 200}));
  EXPECT_EQ(*v.background, (Rgb{.1, .2, .3}));
  EXPECT_EQ(*run.scene->drawing.mode, DrawMode::flat);
  EXPECT_EQ(*run.scene->drawing.samples, 4);
  EXPECT_TRUE(*run.scene->drawing.two_sided);
}

TEST(TclCamera, DestroyedInUseGivesWayToTheStandardOne) {
  const ScriptRun run =
      run_script("set c [SippCameraCreate {1 2 3}]\nSippCameraUse $c\nSippCameraDestruct $c\n");
  EXPECT_EQ(*run.scene->view.from, V3d(0, 0, 10));
  EXPECT_FALSE(run.scene->view.resolution);
}

TEST(TclRender, EndsTheScriptThroughEveryCatch) {
  for (const std::string text :
       {"catch {SippRender [SippPixMapCreate] 10 10}\nerror later\n",
        "try {SippRender [SippPixMapCreate] 10 10} finally {error later}\n",
        "proc p {} {while 1 {catch {SippRender [SippPixMapCreate] 10 10}}}\np\n",
        "coroutine c apply {{} {catch {SippRender [SippPixMapCreate] 10 10}; error later}}\nerror later\n"}) {
    const ScriptRun run = run_script(text);
    EXPECT_TRUE(run.scene) << text << run.error();
  }
}

TEST(TclRender, ResetStartsOver) {
  const ScriptRun run =
      run_script(k_shader +
                 "set a [SippCube 1 $s]\nSippObjectAddSubobj WORLD $a\nSippObjectMove WORLD {1 0 0}\n"
                 "SippLightSourceCreate {1 1 1} {1 1 1}\nSippReset\nputs [SippObjectCreate]\n");
  ASSERT_TRUE(run.scene) << run.error();
  EXPECT_EQ(run.printed, Lines{"object0"});
  EXPECT_TRUE(run.world().children.empty());
  EXPECT_EQ(run.world().to_parent, M44d());
  EXPECT_TRUE(run.scene->lights.empty());
}

// ---- wrong arguments ----

struct WrongCase {
  std::string command, message;
};

TEST(TclErrors, SayWhatWasFoundAndWhatWasExpected) {
  const WrongCase cases[] = {
      {"SippSphere 1 8",
       "SippSphere: 2 arguments found, expected 3 to 4 | usage: SippSphere radius res shader ?texture?"},
      {"SippSphere x 8 $s", "SippSphere: 'x' found for the radius, expected a finite number"},
      {"SippSphere -1 8 $s", "'-1' found for the radius, expected a number > 0"},
      {"SippSphere 1 8.5 $s", "'8.5' found for the resolution, expected a whole number 1.."},
      {"SippSphere 1 8 $s ROUND",
       "'ROUND' found for the texture mapping, expected NATURAL, CYLINDRICAL, SPHERICAL or WORLD"},
      {"SippSphere 1 8 shader77", "'shader77' found for a handle, expected a shader"},
      {"SippSphere 1 8 WORLD", "'WORLD' found for a handle, expected a shader"},
      {"SippCone 0 0 1 8 $s", "SippCone: no cone of this size can be made"},
      {"SippPrism {{0 0} {1 1}} 1 $s", "expected at least three points {x y}"},
      {"SippBlock {1 2} $s", "'1 2' found for the size, expected {x y z}"},
      {"SippBlock {1 2 0} $s", "expected {x y z}, each > 0"},
      {"SippShaderBasic 0 0 1 {1 1}", "'1 1' found for color, expected {red green blue}"},
      {"SippShaderBasic 0 0 1 {1 1 -1}", "each >= 0"},
      {"SippShaderBasic 0 0 1 {1 1 1} 2",
       "'2' found for opacity, expected {red green blue} or one number, 0..1"},
      {"SippShaderStrauss 0 1.5 1 {1 1 1}", "'1.5' found for smoothness, expected a number 0..1"},
      {"SippShaderBozo 1 2 3 4 5", "expected a list of lists {red green blue}"},
      {"SippSurfaceCreate $s", "no polygons to make a surface of | push some with SippPolygonPush before"},
      {"SippPolygonPush {{0 0 0} {1 1 1}}", "a polygon of 2 vertices found, expected at least 3"},
      {"SippPolygonPush -tex {{0 0 0} {1 1 1} {2 2 2}}", "expected {{x y z} {u v w}}"},
      {"SippPolygonPush -flat {{0 0 0} {1 1 1} {2 2 2}}", "'-flat' found for a flag, expected -norm"},
      {"SippObjectRotateX WORLD X90",
       "'X90' found for the angle, expected a finite number, or one behind R (radians) or D"},
      {"SippObjectRotate WORLD {0 0 0} {0 0 0} 1", "expected a vector other than 0 0 0"},
      {"SippObjectSetTransf WORLD {{1 0 0 0} {0 1 0 0} {0 0 1 0}}", "expected a matrix"},
      {"SippObjectSetTransf WORLD {{1 0 0 1} {0 1 0 0} {0 0 1 0} {0 0 0 1}}", "a last column of 0 0 0 1"},
      {"SippLightSourceCreate {0 0 0} {1 1 1}",
       "'0 0 0' found for the direction, expected a vector other than 0 0 0"},
      {"SippLightSourceCreate {0 0 1} {1 1 1} SUN",
       "'SUN' found for the kind of light, expected DIRECTION or POINT"},
      {"SippSpotLightCreate {0 0 1} {0 0 1} 30 {1 1 1} SOFT", "another place than the light's position"},
      {"SippSpotLightCreate {0 0 1} {0 0 0} 400 {1 1 1} SOFT",
       "expected an angle of more than 0 up to 360 degrees"},
      {"SippCameraParams STDCAMERA {} {} {} 0", "'0' found for the focal ratio, expected a number > 0"},
      {"SippShowBackFaces maybe", "'maybe' found for the flag, expected 0, 1, true or false"},
      {"SippRender x 10 10", "'x' found for a handle, expected an open file, as SippPBMOpen returns it"},
      {"SippRender {} 10", "2 arguments found"},
      {"SippRender -sideways {} 10 10", "'-sideways' found for a flag"},
      {"SippRender -odd {} 10 10 LINE", "-odd and -even do not go with LINE"},
      {"SippRender {} 10 10 TOON", "'TOON' found for the mode, expected PHONG, GOURAUD, FLAT or LINE"},
      {"SippRender {} 10 10 PHONG 17", "'17' found for oversample, expected a whole number 1..16"},
      {"SippPBMOpen a.ppm z", "'z' found for the access"},
      {"SippInfo WEATHER", "'WEATHER' found for a keyword"},
      {"SippVW $s", "there is no data of the Volkswagen"},
      {"SippObjectUnref object5", "'object5' found for a handle, expected an object"},
      {"set o [SippObjectCreate]; SippObjectUnref $o; SippObjectMove $o {1 1 1}",
       "'object0' has been deleted"},
  };
  for (const WrongCase& c : cases) {
    const ScriptRun run = run_script(k_shader + c.command + "\n");
    EXPECT_FALSE(run.scene) << c.command;
    EXPECT_NE(run.error().find(c.message), std::string::npos) << c.command << "\n" << run.error();
    ASSERT_FALSE(run.messages.items.empty()) << c.command;
    EXPECT_EQ(run.messages.items.back().where.line, 2u) << c.command;
  }
}

TEST(TclErrors, CanBeCaughtAndTheScriptGoesOn) {
  EXPECT_EQ(prints("puts [catch {SippCube}]\nputs [catch {nosuch}]\nputs done\n"), (Lines{"1", "1", "done"}));
}

}  // namespace
}  // namespace farop::test
