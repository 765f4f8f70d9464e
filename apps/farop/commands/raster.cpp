// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

#include "command_line.h"
#include "core/word_reader.h"
#include "drawer.h"
#include "export/flat_reader.h"
#include "geometry/screen_triangles.h"
#include "picture_library.h"
#include "repeat_file.h"
#include "session.h"

namespace farop::app {
namespace {

struct RasterOptions {
  InputOptions input;
  std::string output, depth_file;
  std::vector<double> background;
  bool y_down = false;
  std::string mode = "gouraud";
  RasterizerOptions rasterizer;
};

/// Counts what passes on its way to a rasterizer.
class PolygonCounter : public ScreenPolygonSink {
 public:
  explicit PolygonCounter(ScreenPolygonSink& next) : next_(next) {}
  PolygonWants wants() const override { return next_.wants(); }
  void begin_frame(const ScreenFrame& frame) override {
    frame_ = frame;
    next_.begin_frame(frame);
  }
  void polygons(const ScreenPolygonBatch& batch) override {
    count_ += batch.polygons.size();
    next_.polygons(batch);
  }
  void end_frame() override { next_.end_frame(); }
  std::uint64_t count() const { return count_; }
  const ScreenFrame& frame() const { return frame_; }

 private:
  ScreenPolygonSink& next_;
  ScreenFrame frame_;
  std::uint64_t count_ = 0;
};

/// Largest polygon of a file, found out in a pass of its own.
class LargestPolygon : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& batch) override {
    for (const ScreenPolygonRecord& record : batch.polygons)
      vertices = std::max(vertices, record.vertex_count);
  }
  void end_frame() override {}

  std::uint32_t vertices = 3;
};

std::string standard_input() {
  std::string text;
  std::array<char, 65536> block;
  for (std::size_t got = 0; (got = std::fread(block.data(), 1, block.size(), stdin)) > 0;)
    text.append(block.data(), got);
  return text;
}

/// The flat file, which can be read several times: from memory when it is standard input. A user's rasterizer
/// is told the largest polygon first and never sees a part of a bad file, so for it the file is read twice.
class FlatInput {
 public:
  FlatInput(Session& session, const RasterOptions& options, RasterizerKind kind)
      : session_(session), path_(options.input.files.front()) {
    reading_.y_down = options.y_down;
    if (kind != RasterizerKind::library) return;
    reading_.keep_rows = true;
    if (path_ == "-") text_ = standard_input();
    LargestPolygon largest;
    read("checking", largest);
    reading_.max_vertices = largest.vertices;
  }

  /// Throws Error(input) when the file is at fault, after that has been reported.
  void read_into(ScreenPolygonSink& sink) const { read("drawing", sink); }

 private:
  void read(const char* what, ScreenPolygonSink& sink) const {
    if (text_) {
      WordReader reader(*text_, "<stdin>");
      read_from(reader, what, sink);
    } else {
      WordReader reader(path_);
      read_from(reader, what, sink);
    }
  }
  void read_from(WordReader& reader, const char* what, ScreenPolygonSink& sink) const {
    FlatReadOptions reading = reading_;
    reading.progress = session_.console.progress(what);
    const TimedSlice slice(session_.clocks.drawing.sink);  // reading and drawing alternate polygon by polygon
    const bool whole = read_flat(reader, session_.console, sink, reading);
    session_.console.end_progress();
    if (!whole) throw Error(ExitStatus::input, "");
  }

  Session& session_;
  const std::string& path_;
  std::optional<std::string> text_;
  FlatReadOptions reading_;
};

void run(Session& session, const RasterOptions& options) {
  if (options.input.files.size() != 1) {
    throw Error(ExitStatus::usage,
                fmt::format("{} inputs given, expected one flat file", options.input.files.size()));
  }
  const ChosenRasterizer chosen = choose_rasterizer(options.rasterizer);
  DrawerOptions drawing;
  drawing.mode = draw_mode(options.mode);
  drawing.keep_depth = !options.depth_file.empty();
  if (!options.background.empty())
    drawing.background = {options.background[0], options.background[1], options.background[2]};
  check_drawing(chosen, options.rasterizer, drawing);
  const bool null = chosen.kind == RasterizerKind::null;
  const std::string output = null ? "" : output_path(options.output, options.input.files, ".ppm");
  if (!null) check_picture_path(output);
  if (drawing.keep_depth) picture_library().check_depth_path(options.depth_file);

  const std::unique_ptr<Drawer> drawer = make_drawer(session, chosen, options.rasterizer, drawing);
  session.report.raster = {drawer->name(), options.mode, 1, {}, {}, {}};
  const FlatInput input(session, options, chosen.kind);
  const auto play = [&](ScreenPolygonSink& sink) {
    ScreenTriangles triangles(sink);
    const bool split = drawer->sink().wants().triangles;
    PolygonCounter counter(split ? static_cast<ScreenPolygonSink&>(triangles) : sink);
    input.read_into(counter);
    return counter;
  };
  std::optional<Framebuffer> picture;
  try {
    const PolygonCounter played = play(drawer->sink());
    session.report.polygons_loaded = played.count();
    session.report.picture = played.frame().resolution;
    picture = drawer->take();
  } catch (const PluginFailure& failure) {
    drawer->report(*session.report.raster);
    explain_failure(session, failure, chosen, play);
    throw;
  }
  drawer->report(*session.report.raster);
  if (picture) {
    const TimedSlice slice(session.clocks.write);
    write_picture_file(output, *picture);
    session.report.outputs.push_back(output);
    if (drawing.keep_depth) {
      picture_library().write_depth(options.depth_file, *picture);
      session.report.outputs.push_back(options.depth_file);
    }
  }
  const Resolution& r = session.report.picture;
  session.console.summary("{}: {} polygons, {} x {} ({:.3f} s)",
                          !picture        ? "no picture"
                          : output == "-" ? "standard output"
                                          : output,
                          *session.report.polygons_loaded, r.x, r.y,
                          session.clocks.drawing.sink.total().elapsed);
  end_of_check(*session.report.raster, options.rasterizer);
}

}  // namespace

void add_raster(CommandLine& line) {
  const auto options = std::make_shared<RasterOptions>();
  CLI::App& command = line.add_command(
      "raster", "flat file -> picture",
      {{"farop raster gears.scr -o gears.png", "look at a flat file"},
       {"farop raster gears.scr -o trapezoid.ppm --rasterizer trapezoid", "drawn by another rasterizer"}},
      [options](Session& session) { run(session, *options); });
  command.add_option("input", options->input.files, "flat file; - is standard input")
      ->required()
      ->type_name("IN.scr")
      ->group("Input");
  command.add_flag("--y-down", options->y_down, "the file counts rows from the top")->group("Input");
  add_output_option(command, options->output,
                    "picture: ppm, png, exr, tif ...; - is standard output [IN.ppm]");
  command.add_option("--depth", options->depth_file, "write depths too, .exr or .tif")
      ->type_name("FILE")
      ->group("Output");
  add_background_option(command, options->background, "Drawing");
  command.add_option("--mode", options->mode, "shading [gouraud]")
      ->check(CLI::IsMember({"line", "flat", "gouraud"}))
      ->type_name("line|flat|gouraud")
      ->group("Drawing");
  add_rasterizer_options(command, options->rasterizer);
  line.add_report_options(command);
}

}  // namespace farop::app
