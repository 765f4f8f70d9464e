// SPDX-License-Identifier: GPL-3.0-or-later
// Fixed work for a stage, to have its instructions counted: `counted_work parse|geometry|raster`. What
// happens in counted() counts. The same instructions on every processor: vectors are those of SSE4, one
// thread.
#include <hwy/targets.h>

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

#include "geometry/pipeline.h"
#include "parse_nff/parse_nff.h"
#include "raster/internal_rasterizer.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "spd/spd.h"

/// Callgrind collects while this runs.
extern "C" __attribute__((noinline)) void counted(const std::function<void()>& work) {
  work();
}

namespace farop {
namespace {

std::string text_of(const char* name, int size) {
  SpdRequest request;
  request.name = name;
  request.size = size;
  std::string text;
  write_spd(request, [&](std::string_view block) { text += block; });
  return text;
}

Scene parse(const std::string& text) {
  WordReader reader(text, "counted");
  DiagnosticList messages;
  return parse_nff(reader, messages).value();
}

/// Keeps all batches, to play them again without the stage before.
class Tape : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame& f) override { frame = f; }
  void polygons(const ScreenPolygonBatch& batch) override { batches.push_back(batch); }
  void end_frame() override {}
  void play(ScreenPolygonSink& sink) const {
    sink.begin_frame(frame);
    for (const ScreenPolygonBatch& batch : batches) sink.polygons(batch);
    sink.end_frame();
  }

  ScreenFrame frame;
  std::vector<ScreenPolygonBatch> batches;
};

class Nothing : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch&) override {}
  void end_frame() override {}
};

struct Frame {
  Scene scene;
  GeometrySetup setup;

  explicit Frame(Scene read, int size = 512) : scene(std::move(read)) {
    tessellate_scene(scene, {3, std::nullopt});
    Viewport viewport;
    viewport.resolution = {size, size, std::int64_t{1} << 24, 256};
    viewport.pixel_fit = PixelFit::edges;
    viewport.subpixel_bits = 8;
    viewport.half_pixel_border = true;
    DiagnosticList messages;
    setup = prepare_geometry(scene, complete_camera(scene.view, messages), viewport, GeometryOptions{});
  }
  void run(ScreenPolygonSink& sink) const {
    GeometryClocks clocks;
    run_geometry(scene, setup, GeometryOptions{}, sink, clocks);
  }
};

/// Long polygons and quadrilaterals with plane normals, several lights with highlights; a fractal of small
/// triangles; vertices with normals that polygons share.
void count_geometry() {
  const Frame gears(parse(text_of("gears", 4))), mount(parse(text_of("mount", 6))),
      balls(parse(text_of("balls", 2)));
  counted([&] {
    Nothing nothing;
    for (const Frame* frame : {&gears, &mount, &balls}) frame->run(nothing);
  });
}

void count_raster() {
  const Frame frame(parse(text_of("gears", 4)));
  Tape tape;
  frame.run(tape);
  InternalRasterizerOptions options;
  options.tuning.threads = 1;
  InternalRasterizer rasterizer(options);
  counted([&] {
    tape.play(rasterizer);
    rasterizer.take();
  });
}

void count_parse() {
  const std::string text = text_of("gears", 4);
  counted([&] { parse(text); });
}

}  // namespace
}  // namespace farop

int main(int argc, char** argv) {
  hwy::DisableTargets(HWY_SSE4 - 1);  // better ones have lower bits
  const std::string_view stage = argc == 2 ? argv[1] : "";
  if (stage == "parse") {
    farop::count_parse();
  } else if (stage == "geometry") {
    farop::count_geometry();
  } else if (stage == "raster") {
    farop::count_raster();
  } else {
    std::fputs("counted_work parse|geometry|raster\n", stderr);
    return 2;
  }
  return 0;
}
