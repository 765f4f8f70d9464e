// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "command_rasterizer.h"
#include "core/error.h"
#include "isolate/isolated_rasterizer.h"
#include "plugin/plugin_rasterizer.h"

namespace farop::app {
namespace {

/// Geometry alone, for timing.
class NullDrawer : public Drawer, ScreenPolygonSink {
 public:
  ScreenPolygonSink& sink() override { return *this; }
  std::string name() const override { return "null"; }
  std::optional<Framebuffer> take() override { return std::nullopt; }

 private:
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch&) override {}
  void end_frame() override {}
};

class InternalDrawer : public Drawer {
 public:
  explicit InternalDrawer(InternalRasterizerOptions options) : rasterizer_(std::move(options)) {}
  ScreenPolygonSink& sink() override { return rasterizer_; }
  std::string name() const override { return "internal"; }
  std::optional<Framebuffer> take() override { return rasterizer_.take(); }

 private:
  InternalRasterizer rasterizer_;
};

class CommandDrawer : public Drawer {
 public:
  CommandDrawer(const std::string& command, int samples) : command_(command), rasterizer_(command, samples) {}
  ScreenPolygonSink& sink() override { return rasterizer_; }
  std::string name() const override { return command_; }
  std::optional<Framebuffer> take() override { return rasterizer_.take(); }

 private:
  std::string command_;
  CommandRasterizer rasterizer_;
};

Error load_error(const std::string& file, const PluginLibrary& library) {
  return {ExitStatus::plugin, fmt::format("{}: {}", printable(file, 4096), library.message), library.hint};
}

/// Where lines go that a rasterizer logs. An error is quoted by the failure that follows it, or shown with
/// the picture.
PluginLog log_to(Console& console) {
  return [&console](farop_log_level level, const std::string& line) {
    if (level == FAROP_LOG_WARNING) {
      console.notice(line);
    } else {
      console.log("{}", line);
    }
  };
}

void tell(Console& console, const std::string& name, const std::vector<PluginFinding>& findings) {
  for (const PluginFinding& finding : findings) {
    console.notice(fmt::format("rasterizer '{}': {} ({})", name, finding.message, finding.verdict));
  }
}

/// A user's library, called in this process.
class LibraryDrawer : public Drawer {
 public:
  LibraryDrawer(Session& session, const std::string& file, const LoadableRasterizer& what,
                const PluginDrawing& drawing)
      : console_(session.console),
        services_(HostServices::for_the_life_of_the_process(what.options, log_to(session.console))),
        library_(open(session, file, what.library, services_)),
        rasterizer_(library_, services_, drawing) {}
  ScreenPolygonSink& sink() override { return rasterizer_; }
  std::string name() const override { return library_.name; }
  std::optional<Framebuffer> take() override {
    const std::string error = services_.last_error();
    if (!error.empty()) console_.notice(fmt::format("rasterizer '{}': {}", library_.name, error));
    if (!rasterizer_.draws_here()) return std::nullopt;
    return rasterizer_.take();
  }
  void report(RunReport::Raster& report) override {
    report.calls = rasterizer_.times();
    for (const ContractFinding& found : rasterizer_.findings()) {
      PluginFinding finding;
      finding.warning = true;
      finding.of_host = found.of_host;
      finding.verdict = found.verdict, finding.message = found.message, finding.polygon = found.polygon;
      report.findings.push_back(std::move(finding));
    }
    tell(console_, library_.name, report.findings);
  }

 private:
  static PluginLibrary open(Session& session, const std::string& file, const std::string& path,
                            HostServices& services) {
    PluginLibrary library = open_plugin(path, services);
    if (library.failure != LoadFailure::none) throw load_error(file, library);
    if (!library.warning.empty()) {
      session.console.notice(fmt::format("rasterizer '{}': {}", library.name, library.warning));
    }
    return library;
  }

  Console& console_;
  HostServices& services_;
  PluginLibrary library_;
  PluginRasterizer rasterizer_;
};

/// A user's library in a process of its own.
class IsolatedDrawer : public Drawer {
 public:
  IsolatedDrawer(Session& session, const std::string& file, const LoadableRasterizer& what,
                 IsolationOptions isolation, const PluginDrawing& drawing)
      : console_(session.console), file_(file) {
    isolation.plugin_options = what.options;
    isolation.log = [log = log_to(console_), this](farop_log_level level, const std::string& line) {
      if (level >= FAROP_LOG_ERROR) error_ = line;
      log(level, line);
    };
    try {
      rasterizer_ = std::make_unique<IsolatedRasterizer>(what.library, isolation, drawing);
      const std::string missing = missing_walls(rasterizer_->report().layers);
      if (isolation.isolation != Isolation::off && !missing.empty()) console_.notice(missing);
    } catch (const PluginFailure& failure) {
      throw PluginFailure(printable(file, 4096), failure.finding());  // the script's name, not its adapter's
    }
  }
  ScreenPolygonSink& sink() override { return *rasterizer_; }
  std::string name() const override { return rasterizer_->description().name; }
  std::optional<Framebuffer> take() override {
    if (!error_.empty()) console_.notice(fmt::format("rasterizer '{}': {}", name(), error_));
    if (!rasterizer_->draws_here()) return std::nullopt;
    return rasterizer_->take();
  }
  void report(RunReport::Raster& report) override {
    const RunnerReport run = rasterizer_->report();
    report.calls = run.runner;
    for (const IsolationLayer& layer : run.layers) {
      if (layer.holds) report.walls.push_back(layer.id);
    }
    report.findings = rasterizer_->findings();
    tell(console_, name(), report.findings);
    show_output("standard output", run.out);
    show_output("standard error", run.err);
  }

 private:
  void show_output(const char* where, const std::string& text) {
    if (!text.empty()) console_.log("printed to {}:\n{}", where, text);
  }

  Console& console_;
  std::string file_;
  std::string error_;  ///< last line that it logged as one
  std::unique_ptr<IsolatedRasterizer> rasterizer_;
};

/// Hands on what it gets with the colour of a polygon's first corner in all of its corners.
class FlatShading : public Drawer, ScreenPolygonSink {
 public:
  explicit FlatShading(std::unique_ptr<Drawer> inner) : inner_(std::move(inner)) {}
  ScreenPolygonSink& sink() override { return *this; }
  std::string name() const override { return inner_->name(); }
  std::optional<Framebuffer> take() override { return inner_->take(); }
  void report(RunReport::Raster& report) override { inner_->report(report); }

 private:
  PolygonWants wants() const override { return inner_->sink().wants(); }
  void begin_frame(const ScreenFrame& frame) override { inner_->sink().begin_frame(frame); }
  void polygons(const ScreenPolygonBatch& batch) override {
    batch_ = batch;
    for (const ScreenPolygonRecord& record : batch_.polygons) {
      const ScreenVertex first = batch_.vertices[record.first_vertex];
      for (std::uint32_t i = 0; i < record.vertex_count; ++i) {
        ScreenVertex& v = batch_.vertices[record.first_vertex + i];
        v.r = first.r, v.g = first.g, v.b = first.b;
      }
    }
    inner_->sink().polygons(batch_);
  }
  void end_frame() override { inner_->sink().end_frame(); }

  std::unique_ptr<Drawer> inner_;
  ScreenPolygonBatch batch_;
};

}  // namespace

void check_drawing(const ChosenRasterizer& rasterizer, const RasterizerOptions& how,
                   const DrawerOptions& options) {
  if (how.check && rasterizer.kind != RasterizerKind::library) {
    throw Error(ExitStatus::usage, "--check looks at the calls of a library, and none is to draw",
                "give --rasterizer NAME or FILE.so");
  }
  if (rasterizer.kind == RasterizerKind::internal) return;
  if (options.mode == DrawMode::line || options.mode == DrawMode::phong) {
    throw Error(ExitStatus::usage, "modes line and phong exist in the internal rasterizer only",
                "give --mode flat or gouraud, or leave out --rasterizer");
  }
  if (options.keep_depth) {
    throw Error(ExitStatus::usage,
                "--depth is the internal rasterizer's: others keep their depths to themselves",
                "leave out --depth");
  }
  if (rasterizer.kind != RasterizerKind::library) return;
  const PluginLibrary library = inspect_plugin_file(loadable(rasterizer.file, {}).library);
  if (library.failure != LoadFailure::none) throw load_error(rasterizer.file, library);
}

void end_of_check(const RunReport::Raster& report, const RasterizerOptions& how) {
  if (!how.check || report.findings.empty()) return;
  const bool ours = std::ranges::any_of(report.findings, &PluginFinding::of_host);
  const std::size_t count = report.findings.size();
  throw Error(ours ? ExitStatus::internal : ExitStatus::input,
              fmt::format("--check found {} {} of the contract with rasterizer '{}'", count,
                          count == 1 ? "breach" : "breaches", report.rasterizer),
              ours ? "please report it"
                   : "the notes above say which; the contract is farop/rasterizer.h (`farop plugins --abi`)");
}

std::unique_ptr<Drawer> make_drawer(Session& session, const ChosenRasterizer& rasterizer,
                                    const RasterizerOptions& how, const DrawerOptions& options) {
  std::unique_ptr<Drawer> drawer;
  switch (rasterizer.kind) {
    case RasterizerKind::internal: {
      InternalRasterizerOptions internal;
      internal.mode = options.mode;
      internal.samples = options.samples;
      internal.background = options.background;
      internal.keep_depth = options.keep_depth;
      internal.additive_transparency = options.additive_transparency;
      internal.shading = options.shading;
      internal.tuning.threads = how.threads;
      return std::make_unique<InternalDrawer>(std::move(internal));
    }
    case RasterizerKind::null:
      return std::make_unique<NullDrawer>();
    case RasterizerKind::command:
      drawer = std::make_unique<CommandDrawer>(rasterizer.command, options.samples);
      break;
    case RasterizerKind::library: {
      const LoadableRasterizer what = loadable(rasterizer.file, plugin_options(how));
      TraceLog* const trace = session.options.trace_file.empty() ? nullptr : &session.trace;
      const PluginDrawing drawing{options.samples, options.background, trace, how.check};
      if (how.in_process) {
        drawer = std::make_unique<LibraryDrawer>(session, rasterizer.file, what, drawing);
      } else {
        drawer = std::make_unique<IsolatedDrawer>(session, rasterizer.file, what, isolation_options(how, {}),
                                                  drawing);
      }
      break;
    }
  }
  if (options.mode == DrawMode::flat) drawer = std::make_unique<FlatShading>(std::move(drawer));
  return drawer;
}

}  // namespace farop::app
