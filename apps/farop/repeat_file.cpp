// SPDX-License-Identifier: GPL-3.0-or-later
#include "repeat_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/output_file.h"
#include "export/flat_writer.h"
#include "session.h"

namespace farop::app {
namespace {

/// Hands on the first polygons of a frame.
class FirstPolygons : public ScreenPolygonSink {
 public:
  FirstPolygons(ScreenPolygonSink& next, std::uint64_t count) : next_(next), left_(count) {}

  bool y_down() const { return y_down_; }

 private:
  void begin_frame(const ScreenFrame& frame) override {
    y_down_ = frame.y_down;
    next_.begin_frame(frame);
  }
  void polygons(const ScreenPolygonBatch& batch) override {
    if (left_ == 0) return;
    if (batch.polygons.size() <= left_) {
      left_ -= batch.polygons.size();
      return next_.polygons(batch);
    }
    ScreenPolygonBatch first = batch;
    first.polygons.resize(left_);
    left_ = 0;
    next_.polygons(first);
  }
  void end_frame() override { next_.end_frame(); }

  ScreenPolygonSink& next_;
  std::uint64_t left_;
  bool y_down_ = false;
};

}  // namespace

void explain_failure(Session& session, const PluginFailure& failure, const ChosenRasterizer& rasterizer,
                     const Replay& replay) {
  const PluginFinding& finding = failure.finding();
  Console& console = session.console;
  console.end_progress();
  std::string trace;
  for (const std::string& line : finding.trace) trace += (trace.empty() ? "" : " < ") + line;
  console.notice(finding.verdict + (trace.empty() ? "" : ", in " + trace));
  if (!finding.polygon) return;
  const std::string file = std::filesystem::path(rasterizer.file).stem().string() + ".crash.scr";
  try {
    OutputFile output(file);
    FlatWriter writer(output);
    FirstPolygons first(writer, std::uint64_t{*finding.polygon} + 1);
    replay(first);
    output.commit();
    session.report.outputs.push_back(file);
    console.notice(
        fmt::format("{}: the polygons up to this one; to repeat: farop raster {} --rasterizer {}{}", file,
                    file, rasterizer.file, first.y_down() ? " --y-down" : ""));
  } catch (const Error& error) {
    console.notice(fmt::format("{} could not be written: {}", file, error.what()));
  }
}

}  // namespace farop::app
