// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/merge.h"

#include <fmt/format.h>

#include <iterator>

#include "core/error.h"

namespace farop {
namespace {

template <class T>
void override_with(std::optional<T>& old, const std::optional<T>& next, const char* name,
                   std::vector<std::string>& overridden) {
  if (!next) return;
  if (old && !(*old == *next)) overridden.emplace_back(name);
  old = next;
}

template <class T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

bool same_tree(const Object& a, const Object& b) {
  if (a.name != b.name || a.to_parent != b.to_parent || a.surfaces.size() != b.surfaces.size() ||
      a.children.size() != b.children.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    if (!(*a.surfaces[i] == *b.surfaces[i])) return false;
  }
  for (std::size_t i = 0; i < a.children.size(); ++i) {
    if (!same_tree(*a.children[i], *b.children[i])) return false;
  }
  return true;
}

void warn(DiagnosticSink& sink, std::string message, std::string hint) {
  Diagnostic d;
  d.severity = Severity::warning;
  d.where.file = "farop";
  d.message = std::move(message);
  d.hint = std::move(hint);
  sink.report(std::move(d));
}

}  // namespace

bool same_content(const Scene& a, const Scene& b) {
  return a.lights == b.lights && a.view == b.view && same_tree(a.root, b.root);
}

void merge_into(Scene& scene, Scene next, DiagnosticSink& sink) {
  std::vector<std::string> overridden;
  override_with(scene.view.from, next.view.from, "from", overridden);
  override_with(scene.view.at, next.view.at, "at", overridden);
  override_with(scene.view.up, next.view.up, "up", overridden);
  if (next.view.angle) scene.view.fit = next.view.fit;  // which dimension an angle is of goes with it
  override_with(scene.view.angle, next.view.angle, "angle", overridden);
  if (next.view.hither) scene.view.fit_depth = next.view.fit_depth;
  override_with(scene.view.hither, next.view.hither, "hither", overridden);
  override_with(scene.view.yon, next.view.yon, "yon", overridden);
  override_with(scene.view.resolution, next.view.resolution, "resolution", overridden);
  override_with(scene.view.background, next.view.background, "background", overridden);
  if (!overridden.empty()) {
    Diagnostic d;
    d.severity = Severity::warning;
    d.where.file = next.inputs.empty() ? "farop" : next.inputs.front().file;
    d.message = fmt::format("overrides {} of the inputs before it", fmt::join(overridden, ", "));
    d.hint = "the last input counts; put the one whose view you want last, or give the view as options";
    sink.report(std::move(d));
  }
  const auto take = [](auto& old, const auto& given) {
    if (given) old = given;
  };
  take(scene.drawing.mode, next.drawing.mode);
  take(scene.drawing.samples, next.drawing.samples);
  take(scene.drawing.two_sided, next.drawing.two_sided);
  append(scene.root.children, next.root.children);
  append(scene.lights, next.lights);
  append(scene.inputs, next.inputs);
}

Camera complete_camera(const ViewParameters& view, DiagnosticSink& sink) {
  if (!view.from || !view.at) {
    const bool neither = !view.from && !view.at;
    throw Error(
        ExitStatus::input,
        neither ? "no view entity: the scene has no 'v' with from and at" : "the view lacks 'from' or 'at'",
        "add a 'v' block to the scene, or give --from X Y Z --at X Y Z");
  }
  if (*view.from == *view.at) {
    throw Error(ExitStatus::input, "degenerate view: 'from' and 'at' are the same point", "move one of them");
  }
  Camera camera;
  camera.from = *view.from;
  camera.at = *view.at;
  if (view.up) {
    camera.up = *view.up;
  } else {
    warn(sink, "the view has no 'up': 0 1 0 is used", "give --up X Y Z");
  }
  if (view.angle) {
    camera.angle_degrees = *view.angle;
  } else {
    warn(sink, "the view has no 'angle': 45 degrees are used", "give --angle DEGREES");
  }
  camera.fit = view.fit.value_or(Fit::vertical);
  camera.hither = view.hither.value_or(0);
  camera.yon = view.yon;
  camera.fit_depth = view.fit_depth.value_or(false);
  if (up_is_parallel(camera)) {
    warn(sink, "'up' is zero or parallel to the view direction: the axis least parallel to it is used",
         "give --up X Y Z");
  }
  return camera;
}

ViewParameters::Size complete_resolution(const ViewParameters& view, DiagnosticSink& sink) {
  if (view.resolution) return *view.resolution;
  warn(sink, "the view has no 'resolution': 512 x 512 is used", "give --resolution WxH");
  return {512, 512};
}

}  // namespace farop
