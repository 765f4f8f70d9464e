// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for what the judge reads from a rasterizer's process: the messages, the black box and how
// the process ends are the input (Replay in tests/unit/isolate/plugins/lying_runner.cpp says how). Whatever
// it is, the judge ends with pictures or with words that can be printed.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "core/screen_polygon.h"
#include "isolate/isolated_rasterizer.h"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void require_printable(const std::string& line) {
  require(!line.empty());
  for (const char c : line) require(static_cast<unsigned char>(c) >= 0x20);
}

farop::ScreenPolygonBatch triangle() {
  farop::ScreenPolygonBatch batch;
  batch.vertices.resize(3);
  batch.vertices[1].x = batch.vertices[2].y = 7;
  farop::ScreenPolygonRecord record;
  record.vertex_count = 3;
  batch.polygons.push_back(record);
  return batch;
}

void draw(farop::IsolatedRasterizer& rasterizer) {
  farop::ScreenFrame frame;
  frame.resolution = {8, 8, 65536, 256};
  frame.max_vertices = 3;
  const farop::ScreenPolygonBatch batch = triangle();
  rasterizer.begin_frame(frame);
  rasterizer.polygons(batch);
  rasterizer.end_frame();
  if (rasterizer.draws_here()) rasterizer.take();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* digits = "0123456789abcdef";
  std::string script;
  for (std::size_t i = 0; i < size; ++i) script += digits[data[i] >> 4], script += digits[data[i] & 15];
  farop::IsolationOptions options;
  options.runner = FAROP_LYING_RUNNER;
  options.limits.wall_seconds = 0.2;
  options.check = size % 2 == 0;
  options.plugin_options["script"] = script;
  options.log = [](farop_log_level, const std::string& line) {
    for (const char c : line) require(static_cast<unsigned char>(c) >= 0x20);
  };
  try {
    farop::IsolatedRasterizer rasterizer(FAROP_SOME_LIBRARY, options, {});
    draw(rasterizer), draw(rasterizer);
    for (const farop::PluginFinding& finding : rasterizer.findings()) require_printable(finding.message);
  } catch (const farop::PluginFailure& failure) {
    require_printable(failure.what());
    require(!failure.finding().verdict.empty());
  } catch (const farop::Error& error) {
    require_printable(error.what());
  }
  return 0;
}
