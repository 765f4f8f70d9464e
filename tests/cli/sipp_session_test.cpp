// SPDX-License-Identifier: GPL-3.0-or-later
// What the program decides for scenes that come from SIPP, and what it says about them.
#include <gtest/gtest.h>

#include "scene_notes.h"
#include "session.h"
#include "shading/procedural_shaders.h"
#include "support/sipp_scene.h"

namespace farop::app {
namespace {

std::shared_ptr<const Shader> wood() {
  return std::make_shared<const WoodShader>(PatternFinish{0.3, 0.1, 0.5, {1, 1, 1}}, WoodPattern{});
}
std::shared_ptr<const Shader> phong() {
  return std::make_shared<const PhongShader>(PhongParameters{0.3, 0.7, 0, 1, {1, 0.5, 0.25}, {1, 1, 1}});
}

Scene scene_of(const std::shared_ptr<const Shader>& shader) {
  Scene scene = test::sipp_scene(V3d(0, -8, 6), V3d(0, 0, 0), 0.4, 64, 64);
  scene.root.children.front()->surfaces = {test::floor(3, 0, 2, shader)};
  return scene;
}

Light shadow_spot() {
  Light light;
  light.kind = LightKind::spot_sharp;
  light.position = V3d(0, 0, 5), light.target = V3d(0, 0, 0), light.opening_degrees = 60;
  light.casts_shadows = true, light.color = Rgb{1, 1, 1};
  return light;
}

/// A run whose inputs have been read, and what it says meanwhile.
struct TestRun {
  explicit TestRun(Scene scene, bool verbose = false) {
    ReportOptions report;
    report.verbose = verbose, report.no_progress = true, report.color = "never";
    session.console.configure(report);
    session.scene = std::move(scene);
  }
  template <class Work>
  std::string said(Work&& work) {
    testing::internal::CaptureStderr();
    work();
    return testing::internal::GetCapturedStderr();
  }
  void prepare(const GeometryOptions& options) {
    DiagnosticList list;
    LoadedView view{complete_camera(session.scene.view, list), Viewport{}};
    view.viewport.resolution = {64, 64, 65536, 256};
    prepare_drawing(session, view, options, 1);
  }
  std::string said_while_drawing(DrawMode mode, bool unlit = false) {
    GeometryOptions options;
    options.unlit = unlit;
    prepare(options);
    InternalRasterizerOptions drawing;
    drawing.mode = mode;
    drawing.shading = session.report.setup->shading;
    InternalRasterizer rasterizer(drawing);
    return said([&] { draw(session, options, rasterizer); });
  }
  Session session;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(SippScenes, HaveNoLightOfOurs) {
  TestRun run(scene_of(phong()));
  GeometryOptions options;
  const std::string said = run.said([&] { options = geometry_options(run.session, {}, false); });
  EXPECT_FALSE(options.light_at_eye);
  EXPECT_TRUE(has(said, "the scene has no light: the ambient term alone is left, as SIPP has it")) << said;
  run.prepare(options);
  EXPECT_TRUE(run.session.report.setup->shading.lights.empty());
}

TEST(SippScenes, ShareThatRuleWithWhatTheyAreMergedWith) {
  Scene scene = scene_of(phong());
  EXPECT_TRUE(all_sipp(scene) && any_sipp(scene));
  scene.inputs.insert(scene.inputs.begin(), {"room.nff", "nff"});
  EXPECT_TRUE(any_sipp(scene));
  EXPECT_FALSE(all_sipp(scene));
  scene.inputs.resize(1);
  EXPECT_FALSE(any_sipp(scene) || all_sipp(scene));
  EXPECT_FALSE(all_sipp(Scene{}));
  TestRun run(scene);
  GeometryOptions options;
  const std::string said = run.said([&] { options = geometry_options(run.session, {}, false); });
  EXPECT_TRUE(options.light_at_eye);
  EXPECT_TRUE(has(said, "a white one at the eye")) << said;
}

TEST(SippScenes, SayWhichSidesAreSeenUnlessAnOptionDoes) {
  for (const std::optional<bool> scene_says :
       {std::optional<bool>(), std::optional(false), std::optional(true)}) {
    for (const std::optional<bool> option :
         {std::optional<bool>(), std::optional(false), std::optional(true)}) {
      Scene scene = scene_of(phong());
      scene.lights = {shadow_spot()};
      scene.drawing.two_sided = scene_says;
      SceneOptions options;
      options.two_sided = option;
      TestRun run(std::move(scene));
      EXPECT_EQ(geometry_options(run.session, options, false).two_sided,
                option.value_or(scene_says.value_or(false)));
    }
  }
}

TEST(SippScenes, SayTheirModeUnlessAnOptionDoes) {
  TestRun run(scene_of(phong()));
  Scene& scene = run.session.scene;
  const auto mode = [&](const char* option, bool internal) {
    return drawing_mode(run.session.console, option, scene, internal);
  };
  EXPECT_EQ(mode("", true), DrawMode::gouraud);
  scene.drawing.mode = DrawMode::flat;
  EXPECT_EQ(mode("", true), DrawMode::flat);
  EXPECT_EQ(mode("", false), DrawMode::flat);
  EXPECT_EQ(mode("line", true), DrawMode::line);
  for (const DrawMode asked : {DrawMode::phong, DrawMode::line}) {
    scene.drawing.mode = asked;
    EXPECT_EQ(mode("", true), asked);
    EXPECT_EQ(run.said([&] { EXPECT_EQ(mode("flat", false), DrawMode::flat); }), "");
    const std::string said = run.said([&] { EXPECT_EQ(mode("", false), DrawMode::gouraud); });
    EXPECT_TRUE(has(said, fmt::format("asks for mode {}", name_of(asked)))) << said;
    EXPECT_TRUE(has(said, "gouraud is used")) << said;
  }
}

TEST(SippScenes, SayTheirSamplesUnlessAnOptionDoes) {
  Scene scene = scene_of(phong());
  EXPECT_EQ(drawing_samples(std::nullopt, scene), 1);
  scene.drawing.samples = 3;
  EXPECT_EQ(drawing_samples(std::nullopt, scene), 3);
  EXPECT_EQ(drawing_samples(2, scene), 2);
  scene.drawing.samples = 1000;
  EXPECT_EQ(drawing_samples(std::nullopt, scene), 16);
}

TEST(SippScenes, CastShadowsAndTakeNoiseFromTheSameSequence) {
  Scene scene = scene_of(wood());
  scene.lights = {shadow_spot()};
  TestRun run(scene);
  run.prepare({});
  const ShadingFrame& shading = run.session.report.setup->shading;
  ASSERT_EQ(shading.lights.size(), 1u);
  EXPECT_NE(shading.lights[0].shadow, nullptr);
  ASSERT_NE(shading.noise, nullptr);
  // 256 numbers went to the shadows before.
  Rand48 random;
  for (int i = 0; i < 256; ++i) random.next();
  const NoiseTable later([&] { return random.next(); });
  EXPECT_EQ(shading.noise->noise(V3d(0.3, 0.4, 0.5)), later.noise(V3d(0.3, 0.4, 0.5)));
  EXPECT_NE(shading.noise->noise(V3d(0.3, 0.4, 0.5)), standard_noise()->noise(V3d(0.3, 0.4, 0.5)));

  GeometryOptions unlit;
  unlit.unlit = true;
  run.prepare(unlit);
  EXPECT_EQ(run.session.report.setup->shading.lights[0].shadow, nullptr) << "a wire frame needs none";
  scene.lights[0].casts_shadows = false;
  TestRun plain(scene);
  plain.prepare({});
  EXPECT_EQ(plain.session.report.setup->shading.noise, nullptr);
}

TEST(LostPatterns, AreNamedOnceWhereShadersAreCalledPerVertex) {
  Scene scene = scene_of(wood());
  scene.root.children.front()->surfaces.push_back(test::floor(3, 1, 2, wood()));
  scene.root.children.front()->surfaces.push_back(
      test::floor(3, 1, 2, std::make_shared<const BumpyShader>(phong(), BumpParameters{})));
  for (const DrawMode mode : {DrawMode::gouraud, DrawMode::flat}) {
    const std::string said = TestRun(scene).said_while_drawing(mode);
    EXPECT_TRUE(has(said, "(bumpy, wood)")) << said;
    EXPECT_EQ(said.find("per vertex"), said.rfind("per vertex")) << said;
  }
  EXPECT_EQ(TestRun(scene).said_while_drawing(DrawMode::phong), "");
  EXPECT_EQ(TestRun(scene).said_while_drawing(DrawMode::line, true), "") << "nothing is shaded";
  EXPECT_EQ(TestRun(scene_of(phong())).said_while_drawing(DrawMode::gouraud), "");
}

TEST(ShaderCounts, CountPlacedSurfacesByKind) {
  Scene scene = scene_of(wood());
  Object& world = *scene.root.children.front();
  const auto child = test::object({test::floor(1, 0, 1, phong())});
  world.children = {child, child};
  world.surfaces.push_back(std::make_shared<Surface>());
  EXPECT_EQ(shader_counts(scene), (std::map<std::string, std::uint64_t>{{"phong", 2}, {"wood", 1}}));
}

TEST(LogOfAScene, NamesShadersAndLights) {
  Scene scene = scene_of(phong());
  Light sun;
  sun.kind = LightKind::directional, sun.position = V3d(0, 0, 1), sun.color = Rgb{0.5, 0.5, 0.5},
  sun.active = false;
  Light lamp;
  lamp.position = V3d(1, 2, 3);
  scene.lights = {shadow_spot(), sun, lamp};
  TestRun run(scene, true);
  EXPECT_EQ(run.said([&] { log_scene(run.session.console, scene); }),
            "SIPP view parameters loaded\n"
            "SIPP light loaded sharp spot, (0.00 0.00 5.00) to (0.00 0.00 0.00), 60 degrees, with shadows "
            "(1.00 1.00 "
            "1.00)\n"
            "SIPP light loaded directional, towards (0.00 0.00 1.00) (0.50 0.50 0.50), switched off\n"
            "SIPP light loaded (1.00 2.00 3.00) (1.00 1.00 1.00)\n"
            "SIPP surface with 4 polygons (phong 0.3 0.7 0 1 {1 0.5 0.25} {1 1 1})\n");
  scene.inputs.front().format = "nff";
  scene.root.children.front()->surfaces.front()->shader = nullptr;
  scene.lights = {lamp};
  EXPECT_EQ(run.said([&] { log_scene(run.session.console, scene); }),
            "NFF view parameters loaded\n"
            "NFF light loaded (1.00 2.00 3.00) (1.00 1.00 1.00)\n"
            "NFF surface with 4 polygons (0.30,0.00,0.70,1,1.00,0.50,0.25)\n");
}

}  // namespace
}  // namespace farop::app
