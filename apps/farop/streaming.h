// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing scenes that need not fit in memory: the inputs are read twice or three times, and every time the
// surfaces go by in parts. What is drawn is the same to the last bit as with the scene in memory.
#pragma once

#include <optional>
#include <string>

#include "parse_nff/parse_nff.h"
#include "session.h"

namespace farop::app {

/// Inputs that together are larger are streamed where that is possible.
constexpr std::uint64_t k_stream_from_bytes = std::uint64_t{64} << 20;

/// Why these inputs cannot be streamed; empty where they can. All must be NFF in regular files (they are read
/// again), and no vertex normal may depend on a whole surface.
std::string obstacle_to_streaming(const InputOptions& input, const SceneOptions& scene);

/// `mode`: "auto", "on" or "off". Throws Error(usage) where it is "on" and cannot be.
bool should_stream(const std::string& mode, const InputOptions& input, const SceneOptions& scene);

/// A scene of which only view, lights and counts are in memory.
///
/// Memory: one part of the scene, 8 MB or sixteen spheres or cones before they become triangles, and the
/// largest polygon; some 40 MB in all.
class StreamedDrawing {
 public:
  /// First time through the inputs: their messages, view and lights, into session.scene. Where the view
  /// stands before the polygons, as NFF asks for, the scene is measured at the same time. The options must
  /// outlive this; `defaults` as of finish_loading().
  StreamedDrawing(Session& session, const InputOptions& input, const ViewOptions& view,
                  const SceneOptions& scene, const Viewport& defaults);

  /// The end of loading; as finish_loading(), with yon filled in. Reads the inputs a second time where the
  /// scene could not be measured the first time.
  LoadedView finish_loading();
  /// The last time through the inputs; after prepare_drawing(). As draw().
  void draw(const GeometryOptions& options, ScreenPolygonSink& sink);

 private:
  std::optional<LoadedView> guess_view(const ViewParameters& so_far) const;
  void measure(Scene part, const LoadedView& view);
  void measure_again(const LoadedView& view);
  void read_again(const NffPartFunction& on_part, const std::string& what);
  NffOptions nff_options(const NffPartFunction& on_part) const;
  Detail detail_for(const LoadedView& view) const;

  Session& session_;
  const InputOptions& input_;
  const ViewOptions& view_options_;
  const SceneOptions& scene_options_;
  Viewport defaults_;
  std::optional<LoadedView> measured_with_;
  bool measured_ = true;     ///< as long as all parts were seen with the same view
  std::size_t reading_ = 0;  ///< number of the input that is read again
  double farthest_ = 0;      ///< depth of the farthest vertex, once measured
};

}  // namespace farop::app
