// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawer.h"

#include <fmt/format.h>

#include <utility>

#include "command_rasterizer.h"
#include "core/error.h"
#include "plugin/plugin_rasterizer.h"
#include "session.h"

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

/// Libraries and what they keep pointers to stay until the process ends.
HostServices& services_of(Session& session, const std::map<std::string, std::string>& options) {
  return *new HostServices(options,
                           [&console = session.console](farop_log_level level, const std::string& line) {
                             // An error is quoted by the failure that follows it, or shown with the picture.
                             if (level == FAROP_LOG_WARNING) {
                               console.notice(line);
                             } else {
                               console.log("{}", line);
                             }
                           });
}

/// A user's library, called in this process.
class LibraryDrawer : public Drawer {
 public:
  LibraryDrawer(Session& session, const std::string& file, const LoadableRasterizer& what,
                const PluginDrawing& drawing)
      : console_(session.console),
        services_(services_of(session, what.options)),
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

/// Hands on what it gets with the colour of a polygon's first corner in all of its corners.
class FlatShading : public Drawer, ScreenPolygonSink {
 public:
  explicit FlatShading(std::unique_ptr<Drawer> inner) : inner_(std::move(inner)) {}
  ScreenPolygonSink& sink() override { return *this; }
  std::string name() const override { return inner_->name(); }
  std::optional<Framebuffer> take() override { return inner_->take(); }

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

void check_drawing(const ChosenRasterizer& rasterizer, const DrawerOptions& options) {
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
      internal.lights_eye = options.lights_eye;
      return std::make_unique<InternalDrawer>(std::move(internal));
    }
    case RasterizerKind::null:
      return std::make_unique<NullDrawer>();
    case RasterizerKind::command:
      drawer = std::make_unique<CommandDrawer>(rasterizer.command, options.samples);
      break;
    case RasterizerKind::library:
      drawer = std::make_unique<LibraryDrawer>(session, rasterizer.file,
                                               loadable(rasterizer.file, plugin_options(how)),
                                               PluginDrawing{options.samples, options.background});
      break;
  }
  if (options.mode == DrawMode::flat) drawer = std::make_unique<FlatShading>(std::move(drawer));
  return drawer;
}

}  // namespace farop::app
