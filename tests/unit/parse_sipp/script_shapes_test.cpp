// SPDX-License-Identifier: GPL-3.0-or-later
// The primitives as scripts make them: the specification's table again, through the interpreter.
#include <gtest/gtest.h>

#include "shading/procedural_shaders.h"
#include "solids/check_solid.h"
#include "unit/parse_sipp/script_scene.h"
#include "unit/parse_sipp/shape_cases.h"

namespace farop::sipp {
namespace {

/// Same surfaces, node by node.
void expect_same(const Object& a, const Object& b, const std::string& name) {
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size()) << name;
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    EXPECT_EQ(*a.surfaces[i], *b.surfaces[i]) << name << " surface " << i;
  }
  ASSERT_EQ(a.children.size(), b.children.size()) << name;
  for (std::size_t i = 0; i < a.children.size(); ++i) expect_same(*a.children[i], *b.children[i], name);
}

TEST(ScriptShapes, HaveTheCountsBoxesAndSidesOfTheSpecification) {
  const std::vector<ShapeCase> cases = shape_cases();
  struct Mapping {
    const char* word;
    TextureMapping mapping;
    std::uint64_t ShapeCase::*vertices;
  };
  for (const Mapping& m : {Mapping{"", TextureMapping::world, &ShapeCase::vertices},
                           Mapping{"WORLD", TextureMapping::world, &ShapeCase::vertices},
                           Mapping{"CYLINDRICAL", TextureMapping::cylindrical, &ShapeCase::cylindrical},
                           Mapping{"SPHERICAL", TextureMapping::spherical, &ShapeCase::spherical},
                           Mapping{"NATURAL", TextureMapping::natural, &ShapeCase::natural}}) {
    // A shader that reads texture coordinates, so that they are kept and compared.
    std::string script = "set s [SippShaderMarble .1 .2 .3 7 {1 0 0} {0 1 0}]\n";
    for (const ShapeCase& c : cases) {
      script += "SippObjectAddSubobj WORLD [" + c.command + " " + m.word + "]\n";
    }
    const test::ScriptRun run = test::run_script(script);
    ASSERT_TRUE(run.scene) << run.error();
    ASSERT_EQ(run.world().children.size(), cases.size());
    ShapeLook look{std::make_shared<MarbleShader>(PatternFinish{.1, .2, .3, {1, 1, 1}},
                                                  MarblePattern{7, {1, 0, 0}, {0, 1, 0}}),
                   m.mapping};
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const ShapeCase& c = cases[i];
      const std::string name = c.name + " " + m.word;
      const Shape& shape = run.world().children[i];
      EXPECT_EQ(shape->to_parent, M44d()) << name;
      EXPECT_EQ(shape->surfaces.size(), c.surfaces) << name;
      EXPECT_EQ(totals_of(shape).polygons, c.polygons) << name;
      if (c.*m.vertices != 0) {
        EXPECT_EQ(totals_of(shape).vertices, c.*m.vertices) << name;
      }
      const Bounds box = bounds_of(shape);
      EXPECT_NEAR((box.low - c.low).length(), 0, 1e-9) << name;
      EXPECT_NEAR((box.high - c.high).length(), 0, 1e-9) << name;
      const SolidReport report = check_solid(*without_repeated_corners(*shape));
      EXPECT_EQ(report.ok(), c.closed) << name << (report.flaw ? ": " + describe(*report.flaw) : "");
      const Shape model = c.make(look);
      for_each_surface(*model, M44d(), [](const SurfacePlacement& placed) {
        const_cast<Surface&>(placed.surface).material = placed.surface.shader->approximate();
      });
      expect_same(*shape, *model, name);
    }
  }
}

}  // namespace
}  // namespace farop::sipp
