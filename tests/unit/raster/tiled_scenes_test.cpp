// SPDX-License-Identifier: GPL-3.0-or-later
// The tiled path draws every scene of the Standard Procedural Databases and the three solids as the plain
// path does, in all modes, polygons as they are and triangles.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "geometry/pipeline.h"
#include "parse_nff/parse_nff.h"
#include "raster/internal_rasterizer.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "spd/spd.h"
#include "unit/raster/tiled_support.h"

namespace farop::test {
namespace {

Scene load(const std::string& name) {
  static const std::map<std::string, int> smaller = {{"balls", 2},   {"rings", 2},  {"tree", 6},
                                                     {"lattice", 3}, {"shells", 1}, {"gears", 2},
                                                     {"jacks", 2},   {"mount", 5}};
  SpdRequest request;
  request.name = name;
  if (const auto found = smaller.find(name); found != smaller.end()) request.size = found->second;
  std::string text;
  write_spd(request, [&](std::string_view block) { text += block; });
  WordReader reader(text, name);
  DiagnosticList messages;
  Scene scene = parse_nff(reader, messages).value();
  tessellate_scene(scene, {3, std::nullopt});
  return scene;
}

class TiledScenes : public testing::TestWithParam<std::string> {};

TEST_P(TiledScenes, LookAsThePlainPathDrawsThem) {
  const Scene scene = load(GetParam());
  const std::vector<std::int64_t> all = targets();
  std::size_t turn = 0;
  for (const DrawMode mode : {DrawMode::flat, DrawMode::gouraud, DrawMode::phong}) {
    for (const bool triangles : {false, true}) {
      const int samples = mode == DrawMode::gouraud && !triangles ? 3 : 1;
      GeometryOptions options;
      options.triangles = triangles;
      options.flat = mode == DrawMode::flat;
      DiagnosticList messages;
      Viewport viewport;
      viewport.resolution = {200 * samples, 170 * samples, std::int64_t{1} << 24, 256};
      viewport.pixel_fit = PixelFit::edges;
      viewport.subpixel_bits = 8;
      viewport.half_pixel_border = true;
      const GeometrySetup setup =
          prepare_geometry(scene, complete_camera(scene.view, messages), viewport, options);
      const auto picture = [&](const RasterTuning& tuning) {
        InternalRasterizerOptions how;
        how.mode = mode;
        how.samples = samples;
        how.keep_depth = true;
        how.shading = setup.shading;
        how.tuning = tuning;
        InternalRasterizer rasterizer(how);
        GeometryClocks clocks;
        run_geometry(scene, setup, options, rasterizer, clocks);
        return rasterizer.take();
      };
      RasterTuning tuning;
      tuning.path = RasterPath::plain;
      const Framebuffer expected = picture(tuning);
      tuning.path = RasterPath::tiled;
      for (const std::int64_t target : all) {
        const OnlyTarget only(target);
        tuning.tile_size = turn % 2 == 0 ? 64 : 24;
        tuning.threads = 1 + static_cast<int>(turn % 3);
        ++turn;
        EXPECT_EQ(difference(picture(tuning), expected), "")
            << "mode " << static_cast<int>(mode) << ", triangles " << triangles << ", target "
            << hwy::TargetName(target) << ", tiles of " << tuning.tile_size << ", " << tuning.threads
            << " threads";
      }
    }
  }
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SpdSceneInfo& scene : spd_scenes()) names.emplace_back(scene.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, TiledScenes, testing::ValuesIn(scene_names()), [](const auto& test) {
  std::string name = test.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace farop::test
