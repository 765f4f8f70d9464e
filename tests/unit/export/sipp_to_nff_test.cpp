// SPDX-License-Identifier: GPL-3.0-or-later
// A SIPP scene, written as NFF and read again, looks the same; where it cannot, the notice names the loss and
// docs/formats/sipp-to-nff.md has its size.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "export/nff_lights.h"
#include "export/nff_writer.h"
#include "parse_nff/parse_nff.h"
#include "scene/tessellate.h"
#include "shading/procedural_shaders.h"
#include "shadow/shadow_map.h"
#include "support/sipp_scene.h"

namespace farop {
namespace {

using test::PictureDifference;

struct Copy {
  Scene scene;
  std::string text;
  std::vector<std::string> notes;
  /// The one that names what is lost; empty without.
  std::string lost() const {
    const std::string start = "lost, because NFF cannot say it: ";
    std::string found;
    for (const std::string& note : notes) {
      if (!note.starts_with(start)) continue;
      EXPECT_TRUE(found.empty()) << "one notice, not two";
      found = note.substr(start.size());
    }
    return found;
  }
};

Copy copy_of(const Scene& scene) {
  Copy copy;
  DiagnosticList list;
  write_nff(
      scene, {}, [&](std::string_view piece) { copy.text += piece; }, list);
  for (const Diagnostic& d : list.items) copy.notes.push_back(d.message);
  WordReader reader(copy.text, "copy.nff");
  DiagnosticList errors;
  std::optional<Scene> parsed = parse_nff(reader, errors);
  for (const Diagnostic& d : errors.items) ADD_FAILURE() << to_text(d);
  if (parsed) {
    copy.scene = std::move(*parsed);
    tessellate_scene(copy.scene, Detail{1, std::nullopt});
  }
  return copy;
}

Light light_at(const V3d& position, const Rgb& color, LightKind kind = LightKind::point) {
  Light light;
  light.position = kind == LightKind::directional ? position.normalized() : position;
  light.color = color;
  light.kind = kind;
  return light;
}

Light spot_at(const V3d& position, double degrees, const Rgb& color, LightKind kind) {
  Light light = light_at(position, color, kind);
  light.target = V3d(0, 0, 0);
  light.opening_degrees = degrees;
  return light;
}

std::shared_ptr<const Shader> phong(const Rgb& color, double ambient = 0.30, double specular = 0.4,
                                    int exponent = 20, const Rgb& opacity = {1, 1, 1}) {
  return std::make_shared<const PhongShader>(
      PhongParameters{ambient, 0.6, specular, exponent, color, opacity});
}

M44d moved(const V3d& by, const V3d& scale = V3d(1, 1, 1), const V3d& angles = V3d(0, 0, 0)) {
  M44d s, r, t;
  s.setScale(scale), r.setEulerAngles(angles), t.setTranslation(by);
  return s * r * t;
}

/// Two spheres, one stretched and turned, one mirrored, above a floor; `shader` on all three.
Scene still_life(const std::shared_ptr<const Shader>& shader, const std::shared_ptr<const Shader>& ground) {
  Scene scene = test::sipp_scene(V3d(1, -9, 5), V3d(0, 0, 0.4), 0.3, 300, 300);
  scene.view.background = Rgb{0.1, 0.2, 0.3};
  const auto ball = test::sphere(1, 24, shader);
  Object& world = *scene.root.children.front();
  world.surfaces = {test::floor(4, -1, 6, ground)};
  world.children = {test::object({ball}, moved(V3d(-1.2, 0, 0), V3d(1, 0.7, 1.4), V3d(0.3, 0.5, 0.2))),
                    test::object({ball}, moved(V3d(1.3, 0.3, 0), V3d(-1, 1, 1), V3d(0, 0.4, 0)))};
  return scene;
}

Scene phong_scene() {
  Scene scene = still_life(phong({0.8, 0.5, 0.3}), phong({0.3, 0.6, 0.4}, 0.30, 0));
  scene.lights = {light_at(V3d(4, -6, 8), {0.5, 0.5, 0.5})};
  return scene;
}

void expect_same_picture(const Scene& scene, double share = 0.999) {
  const Copy copy = copy_of(scene);
  for (const DrawMode mode : {DrawMode::flat, DrawMode::gouraud}) {
    const PictureDifference d = test::compare(test::draw(scene, mode), test::draw(copy.scene, mode));
    EXPECT_GE(d.within_one, share) << "mean " << d.mean << ", largest " << d.largest << ", lost "
                                   << copy.lost();
  }
}

TEST(SippToNff, PhongUnderAPointLightLooksTheSame) {
  const Scene scene = phong_scene();
  expect_same_picture(scene);
  EXPECT_EQ(copy_of(scene).lost(), "");
  // It would be seen if it did not: the picture has many colours.
  const Framebuffer picture = test::draw(scene, DrawMode::gouraud);
  Framebuffer other = picture;
  for (std::uint8_t& c : other.rgb) c = static_cast<std::uint8_t>(std::min(255, c + 3));
  EXPECT_LT(test::compare(picture, other).within_one, 0.1);
}

TEST(SippToNff, SeveralLightsKeepTheirColours) {
  Scene scene = phong_scene();
  scene.lights = {light_at(V3d(4, -6, 8), {0.4, 0.3, 0.2}), light_at(V3d(-5, -4, 6), {0.1, 0.3, 0.4})};
  expect_same_picture(scene);
}

TEST(SippToNff, DirectionalLightsAreFarAway) {
  Scene scene = phong_scene();
  scene.lights = {light_at(V3d(1, -1, 1), {0.5, 0.5, 0.4}, LightKind::directional),
                  light_at(V3d(-1, -2, 1), {0.2, 0.2, 0.3}, LightKind::directional)};
  expect_same_picture(scene);
  EXPECT_EQ(copy_of(scene).lost(), "directional lights (points far away instead)");
}

TEST(SippToNff, OneOpacityLooksTheSame) {
  Scene scene =
      still_life(phong({0.8, 0.5, 0.3}, 0.30, 0.4, 20, {0.6, 0.6, 0.6}), phong({0.3, 0.6, 0.4}, 0.30, 0));
  scene.lights = {light_at(V3d(4, -6, 8), {0.5, 0.5, 0.5})};
  // The spheres do not overlap in this view, so nothing adds up.
  scene.root.children.front()->children[0]->to_parent = moved(V3d(-1.8, 0, 0), V3d(1, 0.7, 1.4));
  expect_same_picture(scene);
  EXPECT_EQ(copy_of(scene).lost(), "how opacities of surfaces behind each other add up");
}

TEST(SippToNff, WithoutLightNoReaderAddsOne) {
  Scene scene = phong_scene();
  scene.lights.clear();
  expect_same_picture(scene);
  scene.lights = {light_at(V3d(0, -5, 5), {1, 1, 1})};
  scene.lights.front().active = false;
  expect_same_picture(scene);
  EXPECT_EQ(copy_of(scene).lost(), "lights that are switched off");
}

TEST(SippToNff, FlatShadingKeepsItsCornerUnderMirrors) {
  Scene scene = phong_scene();
  for (const V3d& scale : {V3d(-1, 1, 1), V3d(1, 1, -1), V3d(-1, -1, -1), V3d(-2, -0.5, 1)}) {
    scene.root.children.front()->children[1]->to_parent = moved(V3d(1.3, 0, 0), scale);
    expect_same_picture(scene);
  }
}

TEST(SippToNff, TheAngleOfATallPictureIsTheVerticalOne) {
  for (const ViewParameters::Size size : {ViewParameters::Size{160, 320}, ViewParameters::Size{320, 160}}) {
    Scene scene = phong_scene();
    scene.view.resolution = size;
    const Copy copy = copy_of(scene);
    const double half = std::tan(*copy.scene.view.angle * std::numbers::pi / 360);
    EXPECT_NEAR(half, size.y > size.x ? 0.3 * 319 / 159 : 0.3, 1e-12);
    // Exact where the frustum goes through pixel centres, as SIPP means it.
    const PictureDifference d = test::compare(test::draw(scene, DrawMode::gouraud, PixelFit::centres),
                                              test::draw(copy.scene, DrawMode::gouraud, PixelFit::centres));
    EXPECT_GE(d.within_one, 0.999);
  }
}

TEST(SippToNff, NormalsAreMovedByTheMatrixItself) {
  Scene scene = test::sipp_scene(V3d(0, 0, 5), V3d(0, 0, 0), 0.3, 100, 100);
  scene.root.children.front()->children = {
      test::object({test::sphere(1, 8, phong({1, 1, 1}))}, moved(V3d(0, 0, 0), V3d(1, 4, 1)))};
  const Copy copy = copy_of(scene);
  const Surface& moved_surface = *copy.scene.root.children.front()->surfaces.front();
  const Surface& surface = *scene.root.children.front()->children.front()->surfaces.front();
  // The first corner of the first polygon.
  const std::uint32_t first = (*surface.polygons.begin()).corners[0];
  const V3d n = surface.averaged_normals[first];
  const V3d expected(n.x, 4 * n.y, n.z);
  EXPECT_NEAR((moved_surface.normals[0] - expected).length(), 0, 1e-12);
}

TEST(SippToNff, NamesEveryLossOnceInOneNotice) {
  Scene scene = still_life(phong({0.8, 0.5, 0.3}, 0.5), phong({0.8, 0.5, 0.3}, 0.4, 0.3, 9, {1, 0.5, 1}));
  Light spot = spot_at(V3d(3, -3, 6), 40, {1, 1, 1}, LightKind::spot_soft);
  spot.casts_shadows = true;
  scene.lights = {spot, spot, light_at(V3d(1, 1, 1), {1, 1, 1}, LightKind::directional)};
  scene.drawing.two_sided = true;
  EXPECT_EQ(
      copy_of(scene).lost(),
      "cones of spot lights (points instead); shadows; directional lights (points far away instead); ambient "
      "coefficients other than 0.3; opacities that differ by channel (their mean is written); how opacities "
      "of "
      "surfaces behind each other add up; that both sides of surfaces are drawn (--two-sided)");
}

TEST(SippToNff, NamesNormalsThatReadersTurnRound) {
  Scene scene = phong_scene();
  auto& ball = *scene.root.children.front()->children.front()->surfaces.front();
  EXPECT_EQ(copy_of(scene).lost().find("behind their polygon"), std::string::npos);
  for (V3d& n : ball.averaged_normals) n = -n;
  EXPECT_NE(copy_of(scene).lost().find("behind their polygon"), std::string::npos);
}

TEST(SippToNff, LightsKeepPlaceAndColour) {
  Scene scene = phong_scene();
  scene.lights = {light_at(V3d(1, 2, 3), {2, 0.5, 0.25}),
                  spot_at(V3d(4, 5, 6), 30, {1, 0, 1}, LightKind::spot_sharp),
                  light_at(V3d(0, 0, 2), {1, 1, 1}, LightKind::directional)};
  NffLosses losses;
  const std::vector<Light> lights = nff_lights(scene, losses);
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_EQ(lights[0], scene.lights[0]);
  EXPECT_EQ(lights[1], light_at(V3d(4, 5, 6), {1, 0, 1}));
  EXPECT_EQ(lights[2].kind, LightKind::point);
  EXPECT_GT(lights[2].position.z, 4e6);
  EXPECT_LT(lights[2].position.z, 8e6);
  EXPECT_EQ(lights[2].color, scene.lights[2].color);
}

// ------------------------------------------------------------------------------------- the size of the
// losses

/// Rows of the table in docs/formats/sipp-to-nff.md: what differs from phong_scene().
std::map<std::string, Scene> lossy_scenes() {
  std::map<std::string, Scene> scenes;
  const std::vector<Light> lamp = {light_at(V3d(4, -6, 8), {0.5, 0.5, 0.5})};
  const auto ground = phong({0.3, 0.6, 0.4}, 0.30, 0);
  const auto with_shader = [&](const char* name, std::shared_ptr<const Shader> shader) {
    Scene scene = still_life(shader, ground);
    scene.lights = lamp;
    scenes[name] = scene;
  };
  const auto with_lights = [&](const char* name, std::vector<Light> lights) {
    Scene scene = phong_scene();
    scene.lights = std::move(lights);
    scenes[name] = scene;
  };
  const Rgb color{0.8, 0.5, 0.3}, other{0.2, 0.1, 0.1}, solid{1, 1, 1};
  with_shader("Phong, ambient 0.30", phong(color));
  with_shader("Phong, ambient 0.10", phong(color, 0.10));
  with_shader("Phong, ambient 0.50", phong(color, 0.50));
  with_shader("Phong, opacity 0.6 0.6 0.6", phong(color, 0.30, 0.4, 20, {0.6, 0.6, 0.6}));
  with_shader("Phong, opacity 0.9 0.6 0.3", phong(color, 0.30, 0.4, 20, {0.9, 0.6, 0.3}));
  const auto basic = [&](double ambient, double c3) {
    return std::make_shared<const BasicShader>(BasicParameters{ambient, 0.4, c3, color, solid});
  };
  with_shader("basic, ambient 0.30, c3 0.2", basic(0.30, 0.2));
  with_shader("basic, ambient 0.30, c3 0.6", basic(0.30, 0.6));
  with_shader("basic, ambient 0.30, c3 1", basic(0.30, 1));
  const auto strauss = [&](double smoothness, double metalness) {
    return std::make_shared<const StraussShader>(
        StraussParameters{0.30, smoothness, metalness, color, solid});
  };
  with_shader("Strauss, smoothness 0.2, metalness 0.1", strauss(0.2, 0.1));
  with_shader("Strauss, smoothness 0.7, metalness 0.1", strauss(0.7, 0.1));
  with_shader("Strauss, smoothness 0.7, metalness 0.9", strauss(0.7, 0.9));
  const PatternFinish finish{0.30, 0.4, 0.2, solid};
  with_shader("marble", std::make_shared<const MarbleShader>(finish, MarblePattern{4, color, other}));
  with_shader("granite", std::make_shared<const GraniteShader>(finish, GranitePattern{1, color, other}));
  with_shader("bozo",
              std::make_shared<const BozoShader>(finish, BozoPattern{4, {color, other, {0.3, 0.3, 0.9}}}));
  with_shader("wood", std::make_shared<const WoodShader>(finish, WoodPattern{10, color, other}));
  with_shader("planet", std::make_shared<const PlanetShader>(finish, PlanetPattern{}));
  with_shader("bumpy, around basic",
              std::make_shared<const BumpyShader>(basic(0.30, 0.2), BumpParameters{8, true, true}));
  with_shader("mask, stripes of two basics",
              std::make_shared<const MaskShader>(
                  basic(0.30, 0.2),
                  std::make_shared<const BasicShader>(BasicParameters{0.30, 0.4, 0.2, other, solid}),
                  [](const V3d& texture) { return std::fmod(std::abs(texture.z), 0.5) < 0.25; }, "stripes"));
  with_lights("directional lights", {light_at(V3d(1, -1, 1), {0.5, 0.5, 0.5}, LightKind::directional)});
  with_lights("sharp spot, 20 degrees", {spot_at(V3d(4, -6, 8), 20, {0.5, 0.5, 0.5}, LightKind::spot_sharp)});
  with_lights("soft spot, 20 degrees", {spot_at(V3d(4, -6, 8), 20, {0.5, 0.5, 0.5}, LightKind::spot_soft)});
  Light shadows = spot_at(V3d(4, -6, 8), 60, {0.5, 0.5, 0.5}, LightKind::spot_sharp);
  shadows.casts_shadows = true;
  with_lights("sharp spot, 60 degrees, shadows", {shadows});
  with_lights("bright lights, sum 2.4",
              {light_at(V3d(4, -6, 8), {0.8, 0.8, 0.8}), light_at(V3d(4, -5, 8), {0.8, 0.8, 0.8}),
               light_at(V3d(5, -6, 8), {0.8, 0.8, 0.8})});
  with_lights("a light behind (highlights)", {light_at(V3d(0, 9, 1), {1, 1, 1})});
  return scenes;
}

/// Name -> the numbers of its row: mean and largest difference in Gouraud, then in Phong mode.
std::map<std::string, std::vector<double>> documented_rows() {
  std::map<std::string, std::vector<double>> rows;
  std::ifstream file(std::string(FAROP_SOURCE_DIR) + "/docs/formats/sipp-to-nff.md");
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, '|');) {
      const std::size_t first = cell.find_first_not_of(' ');
      if (first != std::string::npos)
        cells.push_back(cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
    }
    if (cells.size() != 5 || cells[1].find_first_not_of("0123456789.") != std::string::npos) continue;
    for (std::size_t i = 1; i < 5; ++i) rows[cells[0]].push_back(std::stod(cells[i]));
  }
  return rows;
}

TEST(SippToNff, TheDocumentedSizesOfTheLossesAreTheMeasuredOnes) {
  const auto rows = documented_rows();
  std::string table;
  bool stale = false;
  const auto scenes = lossy_scenes();
  EXPECT_EQ(rows.size(), scenes.size());
  for (const auto& [name, scene] : scenes) {
    const Copy copy = copy_of(scene);
    std::vector<double> row;
    for (const DrawMode mode : {DrawMode::gouraud, DrawMode::phong}) {
      const PictureDifference d = test::compare(test::draw(scene, mode), test::draw(copy.scene, mode));
      row.push_back(d.mean), row.push_back(d.largest);
    }
    table += fmt::format("| {} | {:.2f} | {} | {:.2f} | {} |\n", name, row[0], row[1], row[2], row[3]);
    const auto found = rows.find(name);
    if (found == rows.end()) {
      stale = true;
      continue;
    }
    // A level or two of rounding, so that the table holds on other machines too.
    for (std::size_t i = 0; i < 4; ++i)
      stale = stale || std::abs(found->second[i] - row[i]) > (i % 2 == 0 ? 0.03 : 2);
  }
  EXPECT_FALSE(stale) << table;
}

}  // namespace
}  // namespace farop
