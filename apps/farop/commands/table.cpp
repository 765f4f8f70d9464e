// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of papers, measured again on this machine.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <memory>
#include <string_view>

#include "command_line.h"
#include "core/output_file.h"
#include "geometry/pipeline.h"
#include "parse_nff/parse_nff.h"
#include "plugin/plugin_rasterizer.h"
#include "program_files.h"
#include "scene/merge.h"
#include "scene/tessellate.h"
#include "session.h"
#include "solids/check_solid.h"
#include "spd/spd.h"

namespace farop::app {
namespace {

constexpr int k_variants = 3;

/// A row of the table: of the paper, or a scene of the user's.
struct Figure {
  std::string name;
  /// Seconds on a SPARCstation II (M. Lenz Cesar and M. C. Ferreira de Oliveira, 1995); 0: not in the paper.
  std::array<double, k_variants> paper{};
};
const std::array<Figure, 3> k_paper_figures = {{{"hollow-cube", {0.800, 0.605, 0.290}},
                                                {"solid-torus", {1.295, 0.945, 0.500}},
                                                {"solid-cylinder", {2.729, 1.713, 0.759}}}};

struct TableOptions {
  std::string which;
  std::vector<std::string> inputs;
  int runs = 31;
};

/// Keeps the polygons of a frame, to draw them again and again.
class Tape : public ScreenPolygonSink {
 public:
  PolygonWants wants() const override {
    PolygonWants wants;
    wants.vertex_ids = wants.max_vertices = true;
    return wants;
  }
  void begin_frame(const ScreenFrame& frame) override { frame_ = frame; }
  void polygons(const ScreenPolygonBatch& batch) override {
    batches_.push_back(batch);
    count_ += batch.polygons.size();
  }
  void end_frame() override {}

  void play(ScreenPolygonSink& sink) const {
    sink.begin_frame(frame_);
    for (const ScreenPolygonBatch& batch : batches_) sink.polygons(batch);
    sink.end_frame();
  }
  std::uint64_t count() const { return count_; }
  const ScreenFrame& frame() const { return frame_; }

 private:
  ScreenFrame frame_;
  std::vector<ScreenPolygonBatch> batches_;
  std::uint64_t count_ = 0;
};

/// A shipped rasterizer with its options, in this process: its time alone is wanted.
class Contestant {
 public:
  Contestant(const std::string& name, std::map<std::string, std::string> options)
      : services_(HostServices::for_the_life_of_the_process(
            std::move(options), [this](farop_log_level, const std::string& line) { last_line_ = line; })),
        library_(open_plugin(library_file("plugins") / (name + ".so"), services_)) {
    if (library_.failure != LoadFailure::none) {
      throw Error(ExitStatus::internal, fmt::format("the rasterizer '{}' {}", name, library_.message),
                  "reinstall farop");
    }
    rasterizer_ = std::make_unique<PluginRasterizer>(library_, services_, PluginDrawing{});
  }
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;

  /// Seconds inside the rasterizer for one frame.
  double draw(const Tape& tape) {
    const double before = spent();
    tape.play(*rasterizer_);
    return spent() - before;
  }
  const std::string& last_line() const { return last_line_; }

 private:
  double spent() const {
    const PluginTimes t = rasterizer_->times();
    return t.begin_frame.elapsed + t.polygon.elapsed + t.end_frame.elapsed;
  }

  std::string last_line_;
  HostServices& services_;
  PluginLibrary library_;
  std::unique_ptr<PluginRasterizer> rasterizer_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// "statistics edge_table=12 spans=7 ..." as a table.
std::map<std::string, double, std::less<>> statistics_of(std::string_view line) {
  std::map<std::string, double, std::less<>> values;
  while (!line.empty()) {
    const std::size_t blank = std::min(line.find(' '), line.size());
    const std::string_view word = line.substr(0, blank);
    const std::size_t equals = word.find('=');
    if (equals != std::string_view::npos) {
      double value = 0;
      std::from_chars(word.data() + equals + 1, word.data() + word.size(), value);
      values[std::string(word.substr(0, equals))] = value;
    }
    line.remove_prefix(std::min(blank + 1, line.size()));
  }
  return values;
}

/// The scene, proved to be made of solids. Throws Error(input) naming what it lacks.
Scene load_solids(Session& session, const std::string& name, bool from_file) {
  std::string text;
  if (!from_file) {
    SpdRequest request;
    request.name = name;
    write_spd(request, [&](std::string_view block) { text += block; });
  }
  std::optional<Scene> scene;
  if (from_file) {
    WordReader reader(name);
    scene = parse_nff(reader, session.console);
  } else {
    WordReader reader(text, name);
    scene = parse_nff(reader, session.console);
  }
  if (!scene) throw Error(ExitStatus::input, "");
  tessellate_scene(*scene, {3, std::nullopt});
  for (const auto& object : scene->root.children) {
    const SolidReport report = check_solid(*object);
    if (report.ok()) continue;
    throw Error(
        ExitStatus::input,
        fmt::format("{}: no solid: {}", printable(name, 4096),
                    report.flaw ? describe(*report.flaw) : std::string("there are no polygons")),
        "the algorithm needs closed polyhedra, front sides outwards, that do not cut through themselves");
  }
  return std::move(*scene);
}

Tape record(Session& session, const Scene& scene) {
  GeometryOptions options;
  options.two_sided = true;  // the variants differ by what they do with back faces
  options.flat = true;
  options.light_intensity = light_intensity(SceneOptions{}, scene.lights.size());
  Viewport viewport;
  const ViewParameters::Size size = complete_resolution(scene.view, session.console);
  viewport.resolution.x = size.x, viewport.resolution.y = size.y;
  const GeometrySetup setup =
      prepare_geometry(scene, complete_camera(scene.view, session.console), viewport, options);
  Tape tape;
  GeometryClocks clocks;
  run_geometry(scene, setup, options, tape, clocks);
  return tape;
}

/// Seconds of clearing the frame, which the host does.
double clearing_time(const ScreenFrame& frame, int runs) {
  farop_frame f = plugin_frame(frame, {});
  std::vector<std::uint8_t> pixels(3 * static_cast<std::size_t>(f.width) *
                                   static_cast<std::size_t>(f.height));
  f.pixels = pixels.data();
  f.row_bytes = 3 * std::int64_t{f.width};
  std::vector<double> seconds;
  for (int i = 0; i < runs; ++i) {
    StageTimer timer;
    timer.start();
    clear_frame(f);
    timer.stop();
    seconds.push_back(timer.total().elapsed);
  }
  return median(seconds);
}

/// What one figure gives.
struct Row {
  std::string times, counts;
};

Row measure(Session& session, const Figure& figure, bool from_file, int runs) {
  const Scene scene = load_solids(session, figure.name, from_file);
  const Tape tape = record(session, scene);
  std::vector<std::unique_ptr<Contestant>> contestants;
  for (int v = 1; v <= k_variants; ++v) {
    contestants.push_back(std::make_unique<Contestant>(
        "solids", std::map<std::string, std::string>{{"variant", std::to_string(v)}}));
  }
  contestants.push_back(std::make_unique<Contestant>("trapezoid", std::map<std::string, std::string>{}));
  std::vector<std::vector<double>> seconds(contestants.size());
  const ProgressFunction progress = session.console.progress("measuring " + figure.name);
  for (int run = 0; run < runs; ++run) {  // interleaved: a slow moment of the machine hits all alike
    for (std::size_t i = 0; i < contestants.size(); ++i) seconds[i].push_back(contestants[i]->draw(tape));
    if (progress) progress(static_cast<std::uint64_t>(run), static_cast<std::uint64_t>(runs));
  }
  session.console.end_progress();
  std::array<double, k_variants + 1> ms{};
  for (std::size_t i = 0; i < ms.size(); ++i) ms[i] = 1e3 * median(seconds[i]);

  Row row;
  const auto& p = figure.paper;
  const std::string paper = p[0] == 0 ? fmt::format("{:>7}{:>7}", "-", "-")
                                      : fmt::format("{:7.3f}{:7.3f}", p[1] / p[0], p[2] / p[0]);
  row.times = fmt::format("{:<15} {:>6} {:8.3f} {:8.3f} {:8.3f} {:8.3f} {:7.3f}{:7.3f} {} {:8.3f}\n",
                          figure.name, tape.count(), ms[0], ms[1], ms[2], ms[3], ms[1] / ms[0], ms[2] / ms[0],
                          paper, 1e3 * clearing_time(tape.frame(), runs));
  for (int v = 1; v <= k_variants; ++v) {
    Contestant counting("solids", {{"variant", std::to_string(v)}, {"statistics", "1"}});
    std::vector<double> writing;
    for (int run = 0; run < std::min(runs, 11); ++run) {
      counting.draw(tape);
      writing.push_back(statistics_of(counting.last_line())["pixel_seconds"]);
    }
    auto s = statistics_of(counting.last_line());
    row.counts += fmt::format("{:<15} {:>6} {:>10} {:>9} {:>10} {:>9} {:>12} {:>9} {:9.3f}\n",
                              v == 1 ? figure.name : "", fmt::format("Alg. {}", v), s["edge_table"],
                              s["active_edges_max"], s["active_edges_sum"], s["spans"],
                              s["depth_comparisons"], s["pixels"], 1e3 * median(writing));
  }
  return row;
}

void run(Session& session, const TableOptions& options) {
  std::string times, counts;
  const auto add = [&](const Figure& figure, bool from_file) {
    const Row row = measure(session, figure, from_file, options.runs);
    times += row.times;
    counts += row.counts;
  };
  if (options.inputs.empty()) {
    for (const Figure& figure : k_paper_figures) add(figure, false);
  }
  for (const std::string& input : options.inputs) add({input, {}}, true);

  std::string text = fmt::format(
      "Scan-line algorithms for solids (Lenz Cesar, Ferreira de Oliveira, 1995), flat shading, two-sided.\n"
      "Milliseconds inside the rasterizer, median of {} interleaved runs; clearing the frame is the host's "
      "and apart.\n\n"
      "{:<15} {:>6} {:>8} {:>8} {:>8} {:>8} {:>7}{:>7} {:>7}{:>7} {:>8}\n",
      options.runs, "figure", "faces", "Alg. 1", "Alg. 2", "Alg. 3", "z-buffer", "2/1", "3/1", "2/1*", "3/1*",
      "clearing");
  text += times + "* in the paper\n\n";
  text += fmt::format("{:<15} {:>6} {:>10} {:>9} {:>10} {:>9} {:>12} {:>9} {:>9}\n", "figure", "",
                      "edge table", "active,", "active,", "spans", "depth", "pixels", "writing");
  text += fmt::format("{:<15} {:>6} {:>10} {:>9} {:>10} {:>9} {:>12} {:>9} {:>9}\n", "", "", "entries",
                      "most", "all lines", "", "comparisons", "written", "them, ms");
  text += counts;
  OutputFile file("-");
  file.write(text);
  file.commit();
}

}  // namespace

void add_table(CommandLine& line) {
  const auto options = std::make_shared<TableOptions>();
  CLI::App& command = line.add_command(
      "table", "the 1995 comparison of scan-line algorithms for solids",
      {{"farop table solids --runs 5", "the three solids of the paper, ours beside its ratios"},
       {"farop table solids cube.nff --runs 5",
        "a scene of your own, after a proof that it is one of solids"}},
      [options](Session& session) { run(session, *options); });
  command.add_option("table", options->which, "which table: solids")
      ->required()
      ->check(CLI::IsMember({"solids"}))
      ->type_name("solids")
      ->group("Input");
  command.add_option("input", options->inputs, "scenes instead of the paper's three")
      ->type_name("IN")
      ->group("Input");
  command.add_option("--runs", options->runs, "runs that medians are taken of [31]")
      ->check(CLI::Range(1, 10000))
      ->type_name("N")
      ->group("Input");
  line.add_report_options(command);
}

}  // namespace farop::app
