// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the flat-file reader; seeds: tests/corpus/flat/good and tests/corpus/flat/bad.
//
// Any input ends in a frame or in exactly one error. What was accepted keeps within the ranges that the file
// names: the sink aborts otherwise.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/diagnostics.h"
#include "core/screen_polygon.h"
#include "core/word_reader.h"
#include "export/flat_reader.h"

namespace {

using farop::ScreenVertex;

void require(bool condition) {
  if (!condition) std::abort();
}

class RangeChecker : public farop::ScreenPolygonSink {
 public:
  void begin_frame(const farop::ScreenFrame& frame) override {
    require(!begun_);
    begun_ = true;
    frame_ = frame;
  }

  void polygons(const farop::ScreenPolygonBatch& batch) override {
    require(begun_ && !ended_ && !batch.polygons.empty());
    std::uint64_t next_vertex = 0;
    for (const auto& polygon : batch.polygons) {
      require(polygon.first_vertex == next_vertex && polygon.vertex_count >= 3);
      next_vertex += polygon.vertex_count;
    }
    require(next_vertex == batch.vertices.size());
    const farop::Resolution& r = frame_.resolution;
    for (const ScreenVertex& v : batch.vertices) {
      require(v.x >= 0 && v.x <= (r.x - 1) << frame_.subpixel_bits);
      require(v.y >= 0 && v.y <= (r.y - 1) << frame_.subpixel_bits);
      require(v.z >= 0 && v.z < r.z);
      require(v.r < r.color && v.g < r.color && v.b < r.color);
    }
  }

  void end_frame() override { ended_ = true; }
  bool ended() const { return ended_; }

 private:
  farop::ScreenFrame frame_;
  bool begun_ = false, ended_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const bool y_down : {false, true}) {
    farop::WordReader words(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.scr");
    farop::DiagnosticList diagnostics;
    RangeChecker sink;
    farop::FlatReadOptions options;
    options.y_down = y_down;
    const bool ok = farop::read_flat(words, diagnostics, sink, options);
    require(ok == sink.ended());
    require(diagnostics.items.size() == (ok ? 0u : 1u));
    for (const auto& diagnostic : diagnostics.items) require(!farop::to_text(diagnostic).empty());
  }
  return 0;
}
