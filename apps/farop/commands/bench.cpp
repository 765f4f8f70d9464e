// SPDX-License-Identifier: GPL-3.0-or-later
// Stage timings of scenes, and rasterizers side by side.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command_line.h"
#include "core/output_file.h"
#include "core/sample_statistics.h"
#include "drawer.h"
#include "session.h"
#include "spd/spd.h"
#include "version.h"

namespace farop::app {
namespace {

using Json = nlohmann::ordered_json;

struct BenchOptions {
  std::vector<std::string> scenes;
  std::vector<int> sizes;
  std::vector<std::string> rasterizers;
  std::vector<std::string> against;
  RasterizerOptions how;  ///< its name is set for each rasterizer
  std::string resolution = "1024x1024";
  bool triangles = false;
  bool two_sided = false;
  int runs = 11;
  std::string json_file;
};

/// A scene to be measured: a file, or text that was computed and lies in memory under a file's name.
struct Subject {
  std::string title;
  std::string file;
  std::string format;
  int descriptor = -1;
  std::optional<int> size;
};

/// Keeps memory files open as long as they are read by name.
class Subjects {
 public:
  Subjects() = default;
  Subjects(const Subjects&) = delete;
  Subjects& operator=(const Subjects&) = delete;
  ~Subjects() {
    for (const Subject& subject : all_) {
      if (subject.descriptor >= 0) ::close(subject.descriptor);
    }
  }
  void add_file(const std::string& file) { all_.push_back({file, file, {}, -1, std::nullopt}); }
  void add_database(const std::string& name, std::optional<int> size) {
    SpdRequest request;
    request.name = name;
    request.size = size;
    request.tessellate = true;
    const int descriptor = ::memfd_create("farop-bench", MFD_CLOEXEC);
    if (descriptor < 0) {
      throw Error(ExitStatus::surroundings,
                  fmt::format("no memory file for a scene: {}", std::strerror(errno)));
    }
    all_.push_back({size ? fmt::format("{} {}", name, *size) : name,
                    fmt::format("/proc/self/fd/{}", descriptor), "nff", descriptor, size});
    write_spd(request, [&](std::string_view text) {
      while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
          throw Error(ExitStatus::surroundings,
                      fmt::format("no memory for the scene '{}': {}", name, std::strerror(errno)));
        }
        text.remove_prefix(static_cast<std::size_t>(written));
      }
    });
  }
  const std::vector<Subject>& all() const { return all_; }

 private:
  std::vector<Subject> all_;
};

/// Keeps the polygons of a frame as one rasterizer wants them, to draw them again and again.
class Tape : public ScreenPolygonSink {
 public:
  explicit Tape(const PolygonWants& wants) : wants_(wants) {}
  PolygonWants wants() const override { return wants_; }
  void begin_frame(const ScreenFrame& frame) override { frame_ = frame; }
  void polygons(const ScreenPolygonBatch& batch) override { batches_.push_back(batch); }
  void end_frame() override {}
  void play(ScreenPolygonSink& sink) const {
    sink.begin_frame(frame_);
    for (const ScreenPolygonBatch& batch : batches_) sink.polygons(batch);
    sink.end_frame();
  }

 private:
  PolygonWants wants_;
  ScreenFrame frame_;
  std::vector<ScreenPolygonBatch> batches_;
};

/// Repeated measurements of one stage, by round.
struct Series {
  std::string stage;
  std::vector<double> elapsed, user, system;
  std::vector<double> cycles, instructions;  ///< empty where the machine does not count them
  double amount = 0;                         ///< of `unit`, in one round
  const char* unit = "";

  void add(const StageTime& t) {
    // A clock that stands still would divide by zero; nothing takes less than a nanosecond.
    elapsed.push_back(std::max(t.elapsed, 1e-9));
    user.push_back(t.user), system.push_back(t.system);
    if (t.cycles) cycles.push_back(static_cast<double>(*t.cycles));
    if (t.instructions) instructions.push_back(static_cast<double>(*t.instructions));
  }
};

/// What is measured of one scene.
struct SceneResult {
  const Subject* subject = nullptr;
  PolygonCounts counts;
  std::uint64_t bytes = 0, fragments = 0, covered = 0;
  Resolution resolution;
  std::vector<Series> stages;                                 ///< parse, load, geometry
  std::vector<Series> rasterizers;                            ///< in the order of the command line
  std::vector<std::pair<std::string, Estimate>> comparisons;  ///< each with the first
};

/// Loads a scene as `render` does, into a session of its own, so that every round starts from nothing.
struct LoadedScene {
  Session session;
  GeometryOptions geometry;
};

std::unique_ptr<LoadedScene> load(const Subject& subject, const BenchOptions& options, bool aloud) {
  auto loaded = std::make_unique<LoadedScene>();
  ReportOptions report;
  report.quiet = !aloud;
  report.no_progress = true;
  loaded->session.console.configure(report);
  InputOptions input;
  input.files = {subject.file};
  input.format = subject.format;
  load_inputs(loaded->session, input);
  ViewOptions view;
  view.resolution = options.resolution;
  SceneOptions scene;
  scene.triangles = options.triangles;
  if (options.two_sided) scene.two_sided = true;
  const LoadedView camera = *finish_loading(loaded->session, view, scene, Viewport{}, 1, true);
  loaded->geometry = geometry_options(loaded->session, scene, false);
  prepare_drawing(loaded->session, camera, loaded->geometry, 1);
  return loaded;
}

/// A rasterizer with the polygons it draws.
struct Contestant {
  std::unique_ptr<Drawer> drawer;
  std::unique_ptr<Tape> tape;
};

/// Fragments and covered pixels, by the internal rasterizer, of the frame that everybody draws.
void count_pixels(LoadedScene& loaded, SceneResult& result) {
  InternalRasterizerOptions options;
  options.keep_depth = true;
  options.tuning.path = RasterPath::plain;  // it counts
  InternalRasterizer rasterizer(options);
  GeometryClocks clocks;
  run_geometry(loaded.session.scene, *loaded.session.report.setup, loaded.geometry, rasterizer, clocks);
  result.fragments = rasterizer.counts().fragments;
  const auto beyond = static_cast<float>(result.resolution.z);
  const Framebuffer picture = rasterizer.take();
  result.covered = static_cast<std::uint64_t>(
      std::count_if(picture.depth.begin(), picture.depth.end(), [&](float z) { return z < beyond; }));
}

SceneResult measure(Session& session, const Subject& subject, const BenchOptions& options) {
  SceneResult result;
  result.subject = &subject;
  std::unique_ptr<LoadedScene> first = load(subject, options, true);
  result.bytes = first->session.report.inputs.front().bytes;
  result.resolution = first->session.report.picture;

  std::vector<Contestant> contestants;
  for (const std::string& name : options.rasterizers) {
    RasterizerOptions how = options.how;
    how.name = name;
    DrawerOptions drawing;
    drawing.background = first->session.scene.view.background.value_or(Rgb{});
    Contestant c;
    c.drawer = make_drawer(session, choose_rasterizer(how), how, drawing);
    c.tape = std::make_unique<Tape>(c.drawer->sink().wants());
    GeometryClocks clocks;
    result.counts =
        run_geometry(first->session.scene, *first->session.report.setup, first->geometry, *c.tape, clocks)
            .counts;
    contestants.push_back(std::move(c));
    result.rasterizers.push_back({name, {}, {}, {}, {}, {}, 0, ""});
  }
  count_pixels(*first, result);
  for (Series& series : result.rasterizers) {
    series.amount = static_cast<double>(result.fragments), series.unit = "pixels";
  }
  result.stages = {{"parse", {}, {}, {}, {}, {}, static_cast<double>(result.bytes), "bytes"},
                   {"load", {}, {}, {}, {}, {}, static_cast<double>(result.counts.loaded), "polygons"},
                   {"geometry", {}, {}, {}, {}, {}, static_cast<double>(result.counts.vertices), "vertices"}};

  const auto rounds = static_cast<std::uint64_t>(options.runs);
  const ProgressFunction progress = session.console.progress("measuring " + subject.title);
  for (std::uint64_t round = 0; round <= rounds; ++round) {
    const bool counts = round > 0;  // caches and buffers are filled first
    const std::unique_ptr<LoadedScene> loaded = load(subject, options, false);
    StageTimer geometry;
    {
      class Null : public ScreenPolygonSink {
        void begin_frame(const ScreenFrame&) override {}
        void polygons(const ScreenPolygonBatch&) override {}
        void end_frame() override {}
      } null;
      GeometryClocks clocks;
      const TimedSlice slice(geometry);
      run_geometry(loaded->session.scene, *loaded->session.report.setup, loaded->geometry, null, clocks);
    }
    if (counts) {
      result.stages[0].add(loaded->session.clocks.parse.total());
      result.stages[1].add(loaded->session.clocks.load.total());
      result.stages[2].add(geometry.total());
    }
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      StageTimer timer;
      {
        const TimedSlice slice(timer);
        contestants[i].tape->play(contestants[i].drawer->sink());
      }
      if (options.rasterizers[i] != "null") contestants[i].drawer->take();
      if (counts) result.rasterizers[i].add(timer.total());
    }
    if (progress) progress(round, rounds);
  }
  session.console.end_progress();
  for (std::size_t i = 1; i < contestants.size(); ++i) {
    result.comparisons.emplace_back(
        options.rasterizers[i], paired_ratio(result.rasterizers[0].elapsed, result.rasterizers[i].elapsed));
  }
  return result;
}

// ------------------------------------------------------------------------------------------------ the report

std::string rate_text(const Series& s) {
  const double per_second = s.amount / median(s.elapsed);
  const double scaled = per_second * 1e-6;
  return fmt::format("{:>9.{}f} M{}/s", scaled, scaled < 10 ? 2 : scaled < 100 ? 1 : 0, s.unit);
}

std::string count_column(const std::vector<double>& values) {
  return values.empty() ? fmt::format("{:>10}", "-") : fmt::format("{:>10.2f}", median(values) * 1e-6);
}

std::string line_of(const Series& s) {
  return fmt::format("  {:<22} {:>9.3f} {:>9.3f} {:>9.3f} {} {} {}\n", s.stage, 1e3 * median(s.elapsed),
                     1e3 * median(s.user), 1e3 * median(s.system), count_column(s.cycles),
                     count_column(s.instructions), rate_text(s));
}

std::string comparison_text(const std::string& base, const std::string& name, const Estimate& ratio) {
  const std::string numbers = fmt::format("{:.3f} ({:.3f} to {:.3f})", ratio.value, ratio.low, ratio.high);
  if (ratio.contains(1)) {
    return fmt::format("  {} / {}: {}: no significant difference\n", name, base, numbers);
  }
  const bool slower = ratio.value > 1;
  return fmt::format("  {} / {}: {}: {} is {:.2f} times as {}\n", name, base, numbers, name,
                     slower ? ratio.value : 1 / ratio.value, slower ? "slow" : "fast");
}

std::string text_of(const SceneResult& r, const std::string& base) {
  const double complexity =
      r.covered == 0 ? 0 : static_cast<double>(r.fragments) / static_cast<double>(r.covered);
  std::string text = fmt::format(
      "{}: {} polygons, {} drawn, {} corners; {} x {} pixels, {} covered {:.2f} times on average\n"
      "  {:<22} {:>9} {:>9} {:>9} {:>10} {:>10} {:>12}\n",
      printable(r.subject->title, 200), r.counts.loaded, r.counts.rendered, r.counts.vertices, r.resolution.x,
      r.resolution.y, r.covered, complexity, "", "wall ms", "user ms", "system ms", "Mcycles", "Minstr.",
      "per second");
  for (const Series& s : r.stages) text += line_of(s);
  for (const Series& s : r.rasterizers) text += line_of(s);
  for (const auto& [name, ratio] : r.comparisons) text += comparison_text(base, name, ratio);
  return text + "\n";
}

/// How times grow with the number of polygons, where one scene was measured in several sizes.
struct Growth {
  std::string scene, stage;
  Estimate exponent;
};

std::vector<Growth> growths(const std::vector<SceneResult>& results, const BenchOptions& options) {
  std::vector<Growth> found;
  if (options.sizes.size() < 3) return found;
  for (std::size_t first = 0; first < results.size(); first += options.sizes.size()) {
    std::vector<double> polygons;
    for (std::size_t i = 0; i < options.sizes.size(); ++i)
      polygons.push_back(static_cast<double>(results[first + i].counts.loaded));
    if (*std::min_element(polygons.begin(), polygons.end()) <= 0 || polygons.front() == polygons.back())
      continue;
    const SceneResult& one = results[first];
    const std::size_t stages = one.stages.size();
    for (std::size_t s = 0; s < stages + one.rasterizers.size(); ++s) {
      std::vector<std::vector<double>> samples;
      for (std::size_t i = 0; i < options.sizes.size(); ++i) {
        const SceneResult& r = results[first + i];
        samples.push_back(s < stages ? r.stages[s].elapsed : r.rasterizers[s - stages].elapsed);
      }
      const Series& series = s < stages ? one.stages[s] : one.rasterizers[s - stages];
      found.push_back(
          {options.scenes[first / options.sizes.size()], series.stage, growth_exponent(polygons, samples)});
    }
  }
  return found;
}

Json to_json(const Estimate& e) {
  return {{"value", e.value}, {"low", e.low}, {"high", e.high}};
}

Json to_json(const Series& s) {
  Json json = {{"stage", printable(s.stage, 4096)},
               {"wall", median(s.elapsed)},
               {"user", median(s.user)},
               {"system", median(s.system)}};
  if (!s.cycles.empty()) json["cycles"] = median(s.cycles);
  if (!s.instructions.empty()) json["instructions"] = median(s.instructions);
  json["amount"] = s.amount, json["unit"] = s.unit;
  json["wall_all"] = s.elapsed;
  return json;
}

Json to_json(const std::vector<SceneResult>& results, const std::vector<Growth>& growth,
             const BenchOptions& options) {
  Json json = {{"schema", "farop.bench/1"}, {"version", k_version}, {"runs", options.runs}};
  for (const SceneResult& r : results) {
    Json scene = {{"scene", printable(r.subject->title, 4096)},
                  {"bytes", r.bytes},
                  {"polygons", r.counts.loaded},
                  {"rendered", r.counts.rendered},
                  {"vertices", r.counts.vertices},
                  {"resolution", {r.resolution.x, r.resolution.y, r.resolution.z, r.resolution.color}},
                  {"fragments", r.fragments},
                  {"covered_pixels", r.covered}};
    for (const Series& s : r.stages) scene["stages"].push_back(to_json(s));
    for (const Series& s : r.rasterizers) scene["rasterizers"].push_back(to_json(s));
    for (const auto& [name, ratio] : r.comparisons) {
      scene["ratios"].push_back(
          {{"rasterizer", name}, {"to", options.rasterizers[0]}, {"ratio", to_json(ratio)}});
    }
    json["scenes"].push_back(scene);
  }
  for (const Growth& g : growth) {
    json["growth"].push_back({{"scene", g.scene}, {"stage", g.stage}, {"exponent", to_json(g.exponent)}});
  }
  return json;
}

bool is_database(const std::string& name) {
  const auto scenes = spd_scenes();
  return std::any_of(scenes.begin(), scenes.end(), [&](const SpdSceneInfo& s) { return s.name == name; });
}

void collect(const BenchOptions& options, Subjects& subjects) {
  for (const std::string& scene : options.scenes) {
    std::error_code ec;
    const bool database = is_database(scene) && !std::filesystem::exists(scene, ec);
    if (!options.sizes.empty() && !database) {
      throw Error(ExitStatus::usage,
                  fmt::format("--sizes: '{}' is no scene that is computed", printable(scene)),
                  "farop spd --list shows those that are; files have one size");
    }
    if (!database) {
      subjects.add_file(scene);
    } else if (options.sizes.empty()) {
      subjects.add_database(scene, std::nullopt);
    } else {
      for (const int size : options.sizes) subjects.add_database(scene, size);
    }
  }
}

void run(Session& session, BenchOptions options) {
  if (options.rasterizers.empty()) options.rasterizers = {"internal"};
  options.rasterizers.insert(options.rasterizers.end(), options.against.begin(), options.against.end());
  for (const std::string& name : options.rasterizers) {
    RasterizerOptions how = options.how;
    how.name = name;
    check_drawing(choose_rasterizer(how), how, {});
  }
  Subjects subjects;
  collect(options, subjects);
  std::vector<SceneResult> results;
  OutputFile out("-");
  for (const Subject& subject : subjects.all()) {
    results.push_back(measure(session, subject, options));
    out.write(text_of(results.back(), options.rasterizers[0]));
  }
  const std::vector<Growth> growth = growths(results, options);
  for (const Growth& g : growth) {
    out.write(fmt::format("{}: {} grows with polygons^{:.2f} ({:.2f} to {:.2f})\n", g.scene, g.stage,
                          g.exponent.value, g.exponent.low, g.exponent.high));
  }
  out.write(fmt::format(
      "Medians of {} interleaved runs; ratios with 95 % intervals. '-': not counted here.\n", options.runs));
  out.commit();
  if (options.json_file.empty()) return;
  OutputFile file(options.json_file);
  file.write(to_json(results, growth, options).dump(2) + "\n");
  file.commit();
  session.report.outputs.push_back(options.json_file);
}

}  // namespace

void add_bench(CommandLine& line) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App& command =
      line.add_command("bench", "stage timings, rasterizers side by side",
                       {{"farop bench gears.nff --rasterizer trapezoid --vs watkins --runs 3",
                         "every stage, and how the second compares with the first"},
                        {"farop bench gears --sizes 1,2,3 --runs 3", "how times grow with the scene"}},
                       [options](Session& session) { run(session, *options); });
  command.add_option("scene", options->scenes, "scene files, or names of farop spd --list")
      ->required()
      ->type_name("SCENE")
      ->group("Input");
  command.add_option("--sizes", options->sizes, "sizes of computed scenes; from three on growth is fitted")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->type_name("N,N,...")
      ->group("Input");
  command.add_option("--resolution", options->resolution, "pixels WxH, or X Y Z C [1024x1024]")
      ->type_name("WxH")
      ->group("View");
  command.add_flag("--triangles", options->triangles, "split polygons into triangles")->group("Geometry");
  command.add_flag("--two-sided", options->two_sided, "keep polygons that face away")->group("Geometry");
  command.add_option("--rasterizer", options->rasterizers, "what is measured [internal]")
      ->type_name("NAME|FILE.so|FILE.py")
      ->group("Rasterizer");
  command.add_option("--vs", options->against, "what it is compared with; may be repeated")
      ->type_name("NAME|FILE.so|FILE.py")
      ->group("Rasterizer");
  command.add_option("-I", options->how.folders, "look for rasterizers here first")
      ->type_name("DIR")
      ->group("Rasterizer");
  command.add_flag("--in-process", options->how.in_process, "call them in this process, without walls")
      ->group("Rasterizer");
  command.add_option("--runs", options->runs, "interleaved runs that medians are taken of [11]")
      ->check(CLI::Range(1, 10000))
      ->type_name("N")
      ->group("Measuring");
  command.add_option("--json", options->json_file, "all numbers, also of the single runs")
      ->type_name("FILE")
      ->group("Output");
  line.add_report_options(command);
}

}  // namespace farop::app
