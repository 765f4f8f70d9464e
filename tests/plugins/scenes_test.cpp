// SPDX-License-Identifier: GPL-3.0-or-later
// Every shipped rasterizer on every scene of the Standard Procedural Databases, the three solids and our
// scripts, polygons as they are and triangles: it covers the pixels that the internal rasterizer covers, all
// of them and no other.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "geometry/pipeline.h"
#include "parse_nff/parse_nff.h"
#include "parse_sipp/parse_sipp.h"
#include "plugin/plugin_rasterizer.h"
#include "raster/internal_rasterizer.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "spd/spd.h"
#include "support/sanitizers.h"

namespace farop {
namespace {

constexpr bool k_small = test::k_address_sanitizer;  // the scenes with most polygons in smaller sizes

struct NamedLibrary {
  const char *name, *path;
};
const NamedLibrary k_rasterizers[] = {FAROP_POLYGON_RASTERIZERS};

const std::filesystem::path k_scripts = std::filesystem::path(FAROP_SOURCE_DIR) / "spd_scenes/sipp";

Scene load(const std::string& name) {
  if (name.starts_with("script-")) {
    DiagnosticList messages;
    return parse_sipp((k_scripts / (name.substr(7) + ".sipp")).string(), messages).value();
  }
  static const std::map<std::string, int> smaller = {
      {"balls", 2}, {"rings", 2}, {"tree", 5}, {"lattice", 3}, {"shells", 1}};
  SpdRequest request;
  request.name = name;
  if (const auto found = smaller.find(name); k_small && found != smaller.end()) request.size = found->second;
  std::string text;
  write_spd(request, [&](std::string_view block) { text += block; });
  WordReader reader(text, name);
  DiagnosticList messages;
  Scene scene = parse_nff(reader, messages).value();
  tessellate_scene(scene, {3, std::nullopt});
  return scene;
}

/// Hands on every polygon in white, so that a picture on black is its coverage.
class White : public ScreenPolygonSink {
 public:
  explicit White(ScreenPolygonSink& next) : next_(next) {}
  PolygonWants wants() const override { return next_.wants(); }
  void begin_frame(const ScreenFrame& frame) override { next_.begin_frame(frame); }
  void polygons(const ScreenPolygonBatch& batch) override {
    batch_ = batch;
    for (ScreenPolygonRecord& record : batch_.polygons)
      record.material = nullptr;  // opaque for the internal one too
    for (ScreenVertex& v : batch_.vertices) v.r = v.g = v.b = 255;
    next_.polygons(batch_);
  }
  void end_frame() override { next_.end_frame(); }

 private:
  ScreenPolygonSink& next_;
  ScreenPolygonBatch batch_;
};

class Scenes : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  template <class Rasterizer>
  Framebuffer coverage(Rasterizer& rasterizer) const {
    White white(rasterizer);
    GeometryClocks clocks;
    run_geometry(scene_, setup_, options_, white, clocks);
    return rasterizer.take();
  }
  void SetUp() override {
    scene_ = load(std::get<0>(GetParam()));
    options_.triangles = std::get<1>(GetParam());
    options_.two_sided = scene_.drawing.two_sided.value_or(false);
    DiagnosticList messages;
    Viewport viewport;
    const ViewParameters::Size size = complete_resolution(scene_.view, messages);
    viewport.resolution.x = size.x, viewport.resolution.y = size.y;
    setup_ = prepare_geometry(scene_, complete_camera(scene_.view, messages), viewport, options_);
  }
  Scene scene_;
  GeometryOptions options_;
  GeometrySetup setup_;
};

TEST_P(Scenes, AreCoveredPixelForPixel) {
  InternalRasterizer internal({});
  const Framebuffer expected = coverage(internal);
  std::size_t covered = 0;
  for (const std::uint8_t component : expected.rgb) covered += component == 255 ? 1 : 0;
  EXPECT_GT(covered, 3000u);  // 1000 pixels
  for (const NamedLibrary& named : k_rasterizers) {
    HostServices services({}, {});
    const PluginLibrary library = open_plugin(named.path, services);
    ASSERT_EQ(library.failure, LoadFailure::none) << library.message;
    PluginRasterizer rasterizer(library, services, {});
    const Framebuffer got = coverage(rasterizer);
    ASSERT_EQ(got.rgb.size(), expected.rgb.size());
    std::size_t wrong = 0;
    std::string first;
    for (std::size_t i = 0; i < got.rgb.size(); i += 3) {
      // White may come out one step darker where an interpolation is cut off; covered it is all the same.
      if ((got.rgb[i] >= 254) == (expected.rgb[i] == 255) && (got.rgb[i] == 0 || got.rgb[i] >= 254)) continue;
      const std::size_t pixel = i / 3, width = static_cast<std::size_t>(got.width);
      if (wrong++ == 0) first = std::to_string(pixel % width) + "," + std::to_string(pixel / width);
    }
    EXPECT_EQ(wrong, 0u) << named.name << ": the first of them at " << first;
  }
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SpdSceneInfo& scene : spd_scenes()) names.emplace_back(scene.name);
  for (const auto& entry : std::filesystem::directory_iterator(k_scripts)) {
    if (entry.path().extension() == ".sipp") names.push_back("script-" + entry.path().stem().string());
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::Combine(testing::ValuesIn(scene_names()), testing::Bool()),
                         [](const auto& test) {
                           std::string name =
                               std::get<0>(test.param) + (std::get<1>(test.param) ? "_triangles" : "");
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace farop
