// SPDX-License-Identifier: GPL-3.0-or-later
#include "check_subjects.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "command_rasterizer.h"
#include "conformance/corpus.h"
#include "conformance/random.h"
#include "core/output_file.h"
#include "drawing_recorder.h"
#include "export/ppm_reader.h"
#include "geometry/screen_triangles.h"
#include "isolate/isolated_rasterizer.h"
#include "plugin/plugin_rasterizer.h"
#include "raster/internal_rasterizer.h"

namespace farop::app {
namespace {

using namespace conformance;

Rgb background_rgb(const Color& c) {
  return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0};
}

void play(const Drawing& drawing, ScreenPolygonSink& sink) {
  sink.begin_frame(to_frame(drawing));
  if (!drawing.polygons.empty()) sink.polygons(to_batch(drawing));
  sink.end_frame();
}

Drawing as_triangles(const Drawing& drawing) {
  DrawingRecorder recorder;
  ScreenTriangles triangles(recorder);
  play(drawing, triangles);
  return recorder.drawing;
}

SubjectFailure failure_of(const PluginFinding& f) {
  return {f.verdict, f.message, f.hint, f.polygon, f.trace, f.warning};
}

/// Of calls longer than 2 ms what the processor worked, so that other programs do not count; of short ones,
/// and where that clock only ticks now and then, the finer one.
double seconds_between(const StageTime& before, const StageTime& after) {
  const double elapsed = after.elapsed - before.elapsed;
  const double worked = after.user + after.system - before.user - before.system;
  return elapsed > 0.002 && worked > 0.00025 ? std::min(elapsed, worked) : elapsed;
}

/// What a frame took between two readings.
double frame_seconds(const PluginTimes& before, const PluginTimes& after) {
  return seconds_between(before.begin_frame, after.begin_frame) +
         seconds_between(before.polygon, after.polygon) + seconds_between(before.end_frame, after.end_frame);
}

// ---- a library in a process of its own --------------------------------------------------------------------

class IsolatedSubject : public Subject {
 public:
  IsolatedSubject(LoadableRasterizer what, IsolationOptions options, const Color& background)
      : what_(std::move(what)), options_(std::move(options)), background_(background) {}

  Delivered draw(const Drawing& drawing) override {
    Delivered d;
    try {
      if (!rasterizer_) {
        seen_ = 0;
        rasterizer_ = std::make_unique<IsolatedRasterizer>(what_.library, options_,
                                                           PluginDrawing{1, background_rgb(background_)});
      }
      if (!rasterizer_->draws_here()) {
        d.failure = SubjectFailure{
            "unsupported", "it draws elsewhere: there is no picture to judge", "", {}, {}, true};
        return d;
      }
      const PluginTimes before = rasterizer_->report().runner;
      play(drawing, *rasterizer_);
      d.seconds = frame_seconds(before, rasterizer_->report().runner);
      d.picture = rasterizer_->take();
    } catch (const PluginFailure& failure) {
      d.failure = failure_of(failure.finding());
    }
    if (rasterizer_) {
      const auto& findings = rasterizer_->findings();
      for (; seen_ < findings.size(); ++seen_) d.remarks.push_back(failure_of(findings[seen_]));
    }
    return d;
  }

 private:
  LoadableRasterizer what_;
  IsolationOptions options_;
  Color background_;
  std::unique_ptr<IsolatedRasterizer> rasterizer_;
  std::size_t seen_ = 0;
};

class LibraryMaker : public SubjectMaker {
 public:
  LibraryMaker(LoadableRasterizer what, IsolationOptions options, bool triangles)
      : what_(std::move(what)), options_(std::move(options)), triangles_(triangles) {}
  std::unique_ptr<Subject> make(std::uint8_t memory) const override {
    IsolationOptions options = options_;
    options.fresh_memory = memory;
    return std::make_unique<IsolatedSubject>(what_, options, background());
  }
  std::unique_ptr<Subject> make_guarded() const override {
    IsolationOptions options = options_;
    options.guard_every_polygon = true;
    return std::make_unique<IsolatedSubject>(what_, options, background());
  }
  bool can_guard() const override { return true; }
  Drawing as_given(const Drawing& drawing) const override {
    return triangles_ ? as_triangles(drawing) : drawing;
  }
  Color background() const override { return k_background; }
  bool eight_bit_colors() const override { return true; }
  bool timed() const override { return true; }

 private:
  LoadableRasterizer what_;
  IsolationOptions options_;
  bool triangles_;
};

// ---- a library in this process ----------------------------------------------------------------------------

class InProcessSubject : public Subject {
 public:
  InProcessSubject(const PluginLibrary& library, HostServices& services, const Color& background)
      : rasterizer_(library, services, PluginDrawing{1, background_rgb(background)}) {}
  Delivered draw(const Drawing& drawing) override {
    Delivered d;
    try {
      const PluginTimes before = rasterizer_.times();
      play(drawing, rasterizer_);
      d.seconds = frame_seconds(before, rasterizer_.times());
      d.picture = rasterizer_.take();
    } catch (const Error& error) {
      if (error.status() != ExitStatus::plugin) throw;
      d.failure = SubjectFailure{"abi.status", error.what(), error.hint(), {}, {}, false};
    }
    return d;
  }

 private:
  PluginRasterizer rasterizer_;
};

class InProcessMaker : public SubjectMaker {
 public:
  explicit InProcessMaker(const LoadableRasterizer& what)
      : services_(HostServices::for_the_life_of_the_process(what.options, {})),
        library_(open_plugin(what.library, services_)) {
    if (library_.failure != LoadFailure::none)
      throw Error(ExitStatus::plugin, library_.message, library_.hint);
  }
  std::unique_ptr<Subject> make(std::uint8_t) const override {
    return std::make_unique<InProcessSubject>(library_, services_, background());
  }
  Drawing as_given(const Drawing& drawing) const override {
    return polygon_wants(*library_.table).triangles ? as_triangles(drawing) : drawing;
  }
  Color background() const override { return k_background; }
  bool parallel() const override { return false; }
  bool eight_bit_colors() const override { return true; }
  bool timed() const override { return true; }

 private:
  HostServices& services_;
  PluginLibrary library_;
};

// ---- the internal rasterizer, and programs ----------------------------------------------------------------

class InternalSubject : public Subject {
 public:
  explicit InternalSubject(const Color& background) : rasterizer_(options(background)) {}
  Delivered draw(const Drawing& drawing) override {
    const auto begun = std::chrono::steady_clock::now();
    play(drawing, rasterizer_);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    return {rasterizer_.take(), {}, {}, taken.count()};
  }

 private:
  static InternalRasterizerOptions options(const Color& background) {
    InternalRasterizerOptions o;
    o.mode = DrawMode::gouraud;
    o.samples = 1;
    o.background = background_rgb(background);
    return o;
  }
  InternalRasterizer rasterizer_;
};

class InternalMaker : public SubjectMaker {
 public:
  std::unique_ptr<Subject> make(std::uint8_t) const override {
    return std::make_unique<InternalSubject>(background());
  }
  Color background() const override { return k_background; }
  bool timed() const override { return true; }
};

class CommandSubject : public Subject {
 public:
  explicit CommandSubject(const std::string& command) : rasterizer_(command, 1) {}
  Delivered draw(const Drawing& drawing) override {
    Delivered d;
    try {
      play(drawing, rasterizer_);
      d.picture = rasterizer_.take();
    } catch (const Error& error) {
      if (error.status() != ExitStatus::plugin) throw;
      d.failure = SubjectFailure{"crash.exit", error.what(), error.hint(), {}, {}, false};
    }
    return d;
  }

 private:
  CommandRasterizer rasterizer_;
};

class CommandMaker : public SubjectMaker {
 public:
  explicit CommandMaker(std::string command) : command_(std::move(command)) {}
  std::unique_ptr<Subject> make(std::uint8_t) const override {
    return std::make_unique<CommandSubject>(command_);
  }

 private:
  std::string command_;
};

// ---- pictures made elsewhere ------------------------------------------------------------------------------

/// The name of a drawing's files: by content, so that both runs agree whatever they draw in between.
std::filesystem::path file_of(const std::string& folder, const Drawing& drawing, const char* suffix) {
  return std::filesystem::path(folder) / (fmt::format("{:016x}", fnv1a(flat_text(drawing))) + suffix);
}

/// Writes each drawing as a flat file, and draws it right, so that the run goes on as for a right rasterizer.
class EmittingSubject : public Subject {
 public:
  explicit EmittingSubject(std::string folder) : folder_(std::move(folder)), inner_(Color{}) {}
  Delivered draw(const Drawing& drawing) override {
    const std::string path = file_of(folder_, drawing, ".scr");
    const std::string text = flat_text(drawing);
    if (!text.empty() && !std::filesystem::exists(path)) {
      OutputFile file(path);
      file.write(text);
      file.commit();
    }
    return inner_.draw(drawing);
  }

 private:
  std::string folder_;
  InternalSubject inner_;
};

class EmittingMaker : public SubjectMaker {
 public:
  explicit EmittingMaker(std::string folder) : folder_(std::move(folder)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error)
      throw Error(ExitStatus::surroundings, fmt::format("{}: {}", printable(folder_, 4096), error.message()));
  }
  std::unique_ptr<Subject> make(std::uint8_t) const override {
    return std::make_unique<EmittingSubject>(folder_);
  }
  bool parallel() const override { return false; }
  bool may_deliver_depth() const override { return true; }

 private:
  std::string folder_;
};

class PictureSubject : public Subject {
 public:
  explicit PictureSubject(std::string folder) : folder_(std::move(folder)) {}
  Delivered draw(const Drawing& drawing) override {
    Delivered d;
    const std::string path = file_of(folder_, drawing, ".ppm");
    if (!std::filesystem::exists(path)) {
      d.failure = SubjectFailure{"skip.no-picture",
                                 fmt::format("there is no {}", printable(path, 4096)),
                                 "draw every .scr of --emit",
                                 {},
                                 {},
                                 false};
      return d;
    }
    try {
      d.picture = read_ppm(path);
      read_depths(drawing, *d.picture);
    } catch (const Error& error) {
      d.picture.reset();
      d.failure = SubjectFailure{"abi.picture", error.what(), error.hint(), {}, {}, false};
    }
    return d;
  }

 private:
  /// From the PGM beside the picture, where there is one.
  void read_depths(const Drawing& drawing, Framebuffer& picture) const {
    const std::string path = file_of(folder_, drawing, ".pgm");
    if (!std::filesystem::exists(path)) return;
    const DepthPicture depths = read_depth_pgm(path);
    if (depths.width != picture.width || depths.height != picture.height ||
        depths.maximum != drawing.frame.z - 1) {
      throw Error(ExitStatus::input,
                  fmt::format("{}: has {} x {} pixels and the maximum {}, expected {} x {} and {}",
                              printable(path, 4096), depths.width, depths.height, depths.maximum,
                              picture.width, picture.height, drawing.frame.z - 1),
                  "the maximum is ZRES - 1; without this file depth is measured from pictures");
    }
    picture.depth.assign(depths.z.begin(), depths.z.end());
  }

  std::string folder_;
};

class PictureMaker : public SubjectMaker {
 public:
  explicit PictureMaker(std::string folder) : folder_(std::move(folder)) {
    if (!std::filesystem::is_directory(folder_)) {
      throw Error(ExitStatus::input, fmt::format("{}: is no folder", printable(folder_, 4096)),
                  "--images takes the folder that --emit has filled");
    }
  }
  std::unique_ptr<Subject> make(std::uint8_t) const override {
    return std::make_unique<PictureSubject>(folder_);
  }
  bool may_deliver_depth() const override { return true; }

 private:
  std::string folder_;
};

}  // namespace

std::unique_ptr<SubjectMaker> make_emitter(const std::string& folder) {
  return std::make_unique<EmittingMaker>(folder);
}

std::unique_ptr<SubjectMaker> make_picture_reader(const std::string& folder) {
  return std::make_unique<PictureMaker>(folder);
}

std::unique_ptr<SubjectMaker> make_subjects(Session& session, const ChosenRasterizer& chosen,
                                            const RasterizerOptions& how, std::uint64_t seed,
                                            PrintedLines& printed) {
  switch (chosen.kind) {
    case RasterizerKind::internal:
      return std::make_unique<InternalMaker>();
    case RasterizerKind::command:
      return std::make_unique<CommandMaker>(chosen.command);
    case RasterizerKind::null:
      throw Error(ExitStatus::usage, "null draws nothing: there is nothing to check");
    case RasterizerKind::library:
      break;
  }
  const LoadableRasterizer what = loadable(chosen.file, plugin_options(how));
  if (how.in_process) return std::make_unique<InProcessMaker>(what);
  IsolationOptions options =
      isolation_options(how, [&session, &printed](farop_log_level, const std::string& line) {
        printed.add(line);
        session.console.log("{}", line);
      });
  options.plugin_options = what.options;
  options.seed = seed;
  bool triangles = false;
  try {
    triangles =
        (IsolatedRasterizer(what.library, options, {}).description().wants & FAROP_WANT_TRIANGLES) != 0;
  } catch (const PluginFailure&) {  // the first drawing will say so
  }
  return std::make_unique<LibraryMaker>(what, std::move(options), triangles);
}

std::unique_ptr<SubjectMaker> make_reference(Session& session, const RasterizerOptions& how,
                                             PrintedLines& printed) {
  RasterizerOptions shipped;
  shipped.name = "trapezoid", shipped.folders = how.folders, shipped.isolation = how.isolation;
  try {
    return make_subjects(session, choose_rasterizer(shipped), shipped, 1, printed);
  } catch (const Error&) {
    return nullptr;
  }
}

PluginFacts describe_subject(const ChosenRasterizer& chosen, const RasterizerOptions& how,
                             std::vector<std::string>& walls) {
  PluginFacts facts;
  switch (chosen.kind) {
    case RasterizerKind::internal:
      facts.kind = facts.argument = facts.name = "internal";
      return facts;
    case RasterizerKind::null:
      facts.kind = "null";
      return facts;
    case RasterizerKind::command:
      facts.kind = "command", facts.argument = facts.name = printable(chosen.command, 4096);
      return facts;
    case RasterizerKind::library:
      break;
  }
  facts.kind = chosen.file.ends_with(".py") ? "python" : "library";
  facts.argument = facts.name = printable(chosen.file, 4096);
  facts.sha256 = sha256_of_file(chosen.file);
  if (how.in_process) return facts;
  const LoadableRasterizer what = loadable(chosen.file, plugin_options(how));
  IsolationOptions options = isolation_options(how, {});
  options.plugin_options = what.options;
  try {
    const IsolatedRasterizer rasterizer(what.library, options, {});
    const PluginDescription& d = rasterizer.description();
    facts.name = d.name, facts.summary = d.summary;
    facts.abi = fmt::format("{}.{}", d.abi_version >> 16, d.abi_version & 0xFFFFu);
    if ((d.wants & FAROP_WANT_TRIANGLES) != 0) facts.wants.emplace_back("triangles");
    for (const IsolationLayer& layer : rasterizer.report().layers) {
      if (layer.holds) walls.push_back(layer.id);
    }
  } catch (const PluginFailure&) {  // a finding of the run
  }
  return facts;
}

}  // namespace farop::app
