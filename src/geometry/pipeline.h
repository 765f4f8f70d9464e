// SPDX-License-Identifier: GPL-3.0-or-later
// The geometry stage: scene -> screen polygons. plain_stage.h has its steps on one page, batched/ the same
// for many polygons at once.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "core/screen_polygon.h"
#include "core/statistics.h"
#include "geometry/clip.h"
#include "geometry/viewport.h"
#include "scene/scene.h"
#include "shading/light.h"

namespace farop {

/// batched: many polygons at once, with vectors and threads. plain: polygon by polygon, the readable
/// definition of the same result.
enum class GeometryPath : std::uint8_t { batched, plain };

/// What the command line can ask of the stage.
struct GeometryOptions {
  bool two_sided = false;      ///< keep polygons that face away, lit with all normals negated
  bool triangles = false;      ///< hand over triangles only
  bool flat = false;           ///< the colour of a polygon's first stored vertex for all of it
  double light_intensity = 1;  ///< of a light without a colour
  bool light_at_eye = true;    ///< a white light at the eye for a scene without lights
  bool unlit = false;          ///< black instead of lighting: where depths alone count
  GeometryPath path = GeometryPath::batched;
  /// That work on the batched path, the caller's included; 0: as many as the machine gives this process. The
  /// result is the same for any number. The sink is
  /// called by the caller's thread alone, as are shaders that are not pure.
  int threads = 1;
};

/// The fixed part of a frame: where the eye is and what the frustum is mapped to.
struct GeometrySetup {
  Camera camera;
  Viewport viewport;
  ViewTangents tangents;
  double hither = 0;  ///< of clipping and depth mapping, > 0
  double yon = 0;     ///< > hither, may be +infinity
  double nearest_depth = 0,
         farthest_depth = 0;  ///< of integer depths: hither and yon unless the camera fits them
  ShadingFrame shading;

  DeviceMapping device_mapping() const { return {viewport, tangents, nearest_depth, farthest_depth}; }
  Frustum frustum() const { return {tangents.x, tangents.y, hither, yon}; }
};

/// Of all vertices of a scene, along the view direction; infinities of a scene without any.
struct DepthRange {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -std::numeric_limits<double>::infinity();
};
DepthRange vertex_depths(const Scene& scene, const Camera& camera);
/// What yon `auto` is where the farthest vertex is at `farthest`.
double auto_yon(double farthest, double hither);

/// Completes a frame: near plane, yon (`auto`: farthest vertex times 1.000001, twice hither where that is not
/// beyond it), lights in eye space. Reads every vertex when yon is `auto`. Throws Error(ExitStatus::input)
/// when yon is not beyond hither.
GeometrySetup prepare_geometry(const Scene& scene, const Camera& camera, const Viewport& viewport,
                               const GeometryOptions& options);

/// Clocks of the two stages that alternate; sliced by batches, never by polygon.
struct GeometryClocks {
  StageTimer geometry;
  StageTimer sink;
};

struct GeometryReport {
  PolygonCounts counts;
  /// Degenerate polygons per child of the root (= per input), those at the tips of tessellated cones left
  /// out.
  std::vector<std::uint64_t> degenerate_of_input;
};

/// Runs the stage over the whole tree, top-down, in order, and hands batches to `sink` (begin_frame ..
/// end_frame). Memory: one batch, some hundred kilobytes, for every thread, or the largest polygon.
GeometryReport run_geometry(const Scene& scene, const GeometrySetup& setup, const GeometryOptions& options,
                            ScreenPolygonSink& sink, GeometryClocks& clocks,
                            const ProgressFunction& progress = {});

}  // namespace farop
