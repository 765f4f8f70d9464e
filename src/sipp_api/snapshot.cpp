// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "scene/plane.h"
#include "snapshot_internal.h"
#include "tree_internal.h"
#include "user_shader_internal.h"

namespace farop::sipp_api {
namespace {

/// SIPP's clipping planes: the distance to the point looked at, divided and multiplied by this.
constexpr double k_depth_factor = 100;

void deform(farop::Surface& surface, const ::Surface& source) {
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    Vector position = from_vector(surface.positions[i]), texture = from_vector(V3d(surface.textures[i]));
    Vector new_position = position, new_texture = texture;
    source.ffd(source.ffd_data, &position, &texture, &new_position, &new_texture);
    surface.positions[i] = to_vector(new_position);
    surface.textures[i] = V3f(to_vector(new_texture));
  }
  const std::vector<V3d> before = std::move(surface.averaged_normals);
  average_normals(surface);
  for (std::size_t i = 0; i < source.own_normals.size(); ++i) {
    if (source.own_normals[i]) surface.averaged_normals[i] = before[i];
  }
}

class Snapshot {
 public:
  explicit Snapshot(const SnapshotOptions& options) : options_(options) {}

  std::shared_ptr<farop::Object> object(const ::Object& source) {
    std::shared_ptr<farop::Object>& known = objects_[&source];
    if (known) return known;
    auto out = std::make_shared<farop::Object>();
    known = out;
    out->to_parent = to_matrix(source.transf);
    for (int i = 0; i < source.num_surfaces; ++i) out->surfaces.push_back(surface(*source.surfaces[i]));
    for (int i = 0; i < source.num_sub_objs; ++i) out->children.push_back(object(*source.sub_objs[i]));
    return out;
  }

 private:
  std::shared_ptr<farop::Surface> surface(::Surface& source) {
    std::shared_ptr<farop::Surface>& known = surfaces_[&source];
    if (known) return known;
    if (source.ffd != nullptr) {
      known = std::make_shared<farop::Surface>(*source.geometry);
      deform(*known, source);
    } else {
      known = source.geometry;
    }
    if (options_.shaders) {
      known->shader = bound_shader(source.shader, source.description, options_.interruptible);
      if (!known->shader && !std::exchange(said_, true)) {
        message("a surface without a shader, or whose shader has no description, is drawn white");
      }
      if (options_.materials) known->material = known->shader ? known->shader->approximate() : Material{};
    }
    return known;
  }

  const SnapshotOptions& options_;
  bool said_ = false;  ///< that a surface has no shader
  std::unordered_map<const ::Object*, std::shared_ptr<farop::Object>> objects_;
  std::unordered_map<const ::Surface*, std::shared_ptr<farop::Surface>> surfaces_;
};

void take_view(ViewParameters& view, ::Camera& camera) {
  vecnorm(&camera.up);  // in place, as SIPP does
  const V3d from = to_vector(camera.position), at = to_vector(camera.lookat);
  const double distance = (at - from).length();
  if (!(distance > 0) || !std::isfinite(distance)) {
    throw Error(ExitStatus::input, "the camera looks at the point where it is",
                "give camera_look_at another one");
  }
  if (!(camera.focal_ratio > 0) || !std::isfinite(camera.focal_ratio)) {
    throw Error(ExitStatus::input, fmt::format("a camera with focal ratio {}", camera.focal_ratio),
                "it is the tangent of half the angle of view, 0.25 by default");
  }
  view.from = from;
  view.at = at;
  view.up = to_vector(camera.up);
  view.angle = 2 * std::atan(camera.focal_ratio) * (180 / std::numbers::pi);
  view.fit = Fit::smaller;
  view.hither = distance / k_depth_factor;
  view.yon = distance * k_depth_factor;
  view.fit_depth = true;
}

}  // namespace

Scene snapshot(const SnapshotOptions& options) {
  if (!state().initialized) {
    throw Error(ExitStatus::input, "something is rendered before sipp_init()", "call it first");
  }
  check_tree(*sipp_world);
  Scene scene;
  const std::shared_ptr<farop::Object> world = Snapshot(options).object(*sipp_world);
  world->name = "world";
  scene.root.children.push_back(world);
  for (const Lightsource* light = state().lights; light != nullptr; light = light->next) {
    scene.lights.push_back(scene_light(*light));
  }
  take_view(scene.view, *sipp_camera);
  scene.view.background = state().background;
  scene.drawing.two_sided = state().show_backfaces;
  InputSummary input;
  input.file = "world";
  input.format = "sipp";
  scene.inputs.push_back(std::move(input));
  return scene;
}

farop::Camera camera_of(const ViewParameters& view) {
  farop::Camera camera;
  camera.from = *view.from;
  camera.at = *view.at;
  camera.up = *view.up;
  camera.angle_degrees = *view.angle;
  camera.fit = *view.fit;
  camera.hither = *view.hither;
  camera.yon = view.yon;
  camera.fit_depth = true;
  return camera;
}

}  // namespace farop::sipp_api
