// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a command: its messages, clocks and counts, and the steps that commands share.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "console.h"
#include "core/statistics.h"
#include "geometry/pipeline.h"
#include "isolate/isolation.h"
#include "options.h"
#include "parse_nff/parse_nff.h"
#include "plugin/plugin_rasterizer.h"
#include "scene/bounds.h"
#include "scene/scene.h"
#include "scene/tessellate.h"
#include "scene/traverse.h"

namespace farop::app {

/// Clocks of a run; a stage that did not run is left out of every report.
struct RunClocks {
  StageTimer parse, load, write, total;
  GeometryClocks
      drawing;  ///< geometry, and what takes its polygons (rasterize; for `export` that is writing)

  /// Every slice of every stage goes to `log` as well.
  void trace_to(TraceLog& log);
};

/// What is known of a scene that went by in parts (streaming.h).
struct StreamedScene {
  SceneTotals totals;  ///< vertices: of all parts, which may share some; memory_bytes: of the largest part
  std::optional<Bounds> bounds;
  std::uint64_t spheres_skipped = 0, cones_skipped = 0;
  int readings = 0;  ///< times that the inputs were read
};

/// What a run has found out, for --stats and the summaries. Parts that do not apply stay empty.
struct RunReport {
  std::string command;
  std::vector<InputSummary> inputs;
  bool has_scene = false;
  std::optional<StreamedScene> streamed;  ///< the scene's surfaces are not in memory
  std::optional<GeometrySetup> setup;
  Resolution picture;  ///< of the frame without super-sampling
  std::optional<GeometryReport> geometry;
  std::optional<std::uint64_t> polygons_loaded;  ///< without a geometry stage
  struct Raster {
    std::string rasterizer, mode;
    int samples = 1;
    std::optional<PluginTimes> calls;  ///< of a user's library
    std::vector<std::string> walls;    ///< layers of isolation that stood
    /// What a user's library did that it should not have done, and yet drew on.
    std::vector<PluginFinding> findings;
  };
  std::optional<Raster> raster;
  bool sink_writes = false;  ///< the polygons went to a file, not to a rasterizer
  std::vector<std::string> outputs;
};

/// Everything that a command needs to run.
class Session {
 public:
  Console console;
  Scene scene;
  RunClocks clocks;
  RunReport report;
  ReportOptions options;
  TraceLog trace;  ///< filled under --trace

  /// Ends the run: `--stats` is written whatever the status.
  void finish(ExitStatus status);
  /// Throws when --strict turned a warning into an error.
  void stop_if_strict_found_errors() const;
};

/// Whether the file is a scene by script: by its suffix, else by --format.
bool is_script(const std::string& file, const InputOptions& options);

/// Parses and merges the inputs into session.scene; those in NFF with these options, progress aside. Throws
/// Error(input) after the diagnostic has been reported.
void load_inputs(Session& session, const InputOptions& options, NffOptions nff = {});

/// A camera and the picture it fills.
struct LoadedView {
  Camera camera;
  Viewport viewport;
};

/// What `next` gives takes the place of what `view` has; the options the same, with --yon auto.
void override_view(ViewParameters& view, const ViewParameters& next);
void apply_options(ViewParameters& view, const ViewOptions& options);
/// Camera and picture of a view that the options are part of already; `defaults` has what they do not say.
LoadedView complete_view(const ViewParameters& view, const ViewOptions& options, const Viewport& defaults,
                         DiagnosticSink& sink);
/// Where `--detail auto` looks round from.
DetailView detail_view(const LoadedView& view, int samples);

/// The end of loading: options override the view, curved primitives become polygons, vertex normals are
/// averaged. `defaults` has what neither scene nor options say. With a camera, `--detail auto` looks round in
/// a picture of `samples` times as many rows. Without one: nothing, or Error(input) when `needs_camera`.
std::optional<LoadedView> finish_loading(Session& session, const ViewOptions& view,
                                         const SceneOptions& options, const Viewport& defaults, int samples,
                                         bool needs_camera);

/// What the options ask of the geometry stage; says so when the scene has no light.
GeometryOptions geometry_options(Session& session, const SceneOptions& options, bool flat);

/// Completes the frame, super-sampled `samples` times in both directions, into session.report.setup.
void prepare_drawing(Session& session, const LoadedView& view, const GeometryOptions& options, int samples);

/// What is logged before and after the geometry stage, and its warnings; `sums` of the whole scene.
void begin_drawing(Session& session, const GeometryOptions& options, const ScreenPolygonSink& sink,
                   const SceneTotals& sums);
void end_drawing(Session& session);

/// Geometry stage into a sink, with its log and its warnings; after prepare_drawing().
void draw(Session& session, const GeometryOptions& options, ScreenPolygonSink& sink);

/// OUT, or the first input's name with another suffix in the current folder; `-` for standard input cannot be
/// renamed. Refuses an output that is one of the inputs. Throws Error(usage).
std::string output_path(const std::string& output, const std::vector<std::string>& inputs,
                        const std::string& suffix);

/// The lines about counts and times that end a drawing command.
void summarize_drawing(Session& session, const std::string& output);

}  // namespace farop::app
