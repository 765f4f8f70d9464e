// SPDX-License-Identifier: GPL-3.0-or-later
// Lights and cameras.
#include <cmath>
#include <numbers>

#include "library_internal.h"

namespace farop::sipp_api {
namespace {

LightKind kind_of(const Lightsource& light) {
  switch (light.type) {
    case LIGHT_DIRECTION:
      return LightKind::directional;
    case SPOT_SHARP:
      return LightKind::spot_sharp;
    case SPOT_SOFT:
      return LightKind::spot_soft;
    default:
      return LightKind::point;
  }
}

bool is_spot(const Lightsource* light) {
  return light != nullptr && (light->type == SPOT_SHARP || light->type == SPOT_SOFT);
}

LightSource world_light(const Lightsource& light) {
  const LightInfo& info = info_of(light);
  LightSource source;
  source.kind = kind_of(light);
  source.color = to_rgb(light.color);
  source.position = info.position;
  if (is_spot(&light)) {
    source.axis = (info.target - info.position).normalized();
    source.cos_half_angle = std::cos(info.opening_degrees * (std::numbers::pi / 360));
    source.shadow = info.shadow;
  }
  return source;
}

Lightsource* new_light(const LightInfo& info, const Color& color, int type) {
  State& s = state();
  auto* const light = static_cast<Lightsource*>(scalloc(1, sizeof(Lightsource)));
  light->color = color;
  light->active = TRUE;
  light->type = type;
  light->info = new LightInfo(info);
  light->next = s.lights;
  s.lights = light;
  return light;
}

}  // namespace

LightInfo& info_of(const Lightsource& light) {
  return *static_cast<LightInfo*>(light.info);
}

std::span<const LightSource> world_lights(const Lightsource* list) {
  State& s = state();
  if (s.rendering && list == s.frame_lights) return s.world_lights;
  static thread_local std::vector<LightSource> others;
  others.clear();
  for (; list != nullptr; list = list->next) {
    if (list->active != 0) others.push_back(world_light(*list));
  }
  return others;
}

Light scene_light(const Lightsource& light) {
  const LightInfo& info = info_of(light);
  Light out;
  out.position = info.position;
  out.color = to_rgb(light.color);
  out.kind = kind_of(light);
  out.active = light.active != 0;
  if (is_spot(&light)) {
    out.target = info.target;
    out.opening_degrees = info.opening_degrees;
    out.casts_shadows = info.casts_shadows;
    out.shadow_size = state().shadow_size;
  }
  return out;
}

}  // namespace farop::sipp_api

using namespace farop::sipp_api;
using farop::V3d;

Lightsource* lightsource_create(double x, double y, double z, double red, double grn, double blu, int type) {
  if (type != LIGHT_DIRECTION && type != LIGHT_POINT) {
    message(fmt::format("lightsource_create: type {} (LIGHT_DIRECTION or LIGHT_POINT)", type));
    return nullptr;
  }
  return guarded<Lightsource*>(nullptr, [&] {
    LightInfo info;
    info.position = V3d(x, y, z);
    if (type == LIGHT_DIRECTION) info.position.normalize();
    return new_light(info, {red, grn, blu}, type);
  });
}

Lightsource* spotlight_create(double x, double y, double z, double to_x, double to_y, double to_z,
                              double opening, double red, double grn, double blu, int type,
                              Sipp_bool shadow) {
  if (type != SPOT_SHARP && type != SPOT_SOFT) {
    message(fmt::format("spotlight_create: type {} (SPOT_SHARP or SPOT_SOFT)", type));
    return nullptr;
  }
  return guarded<Lightsource*>(nullptr, [&] {
    return new_light({V3d(x, y, z), V3d(to_x, to_y, to_z), opening, shadow != 0, nullptr}, {red, grn, blu},
                     type);
  });
}

void light_destruct(Lightsource* light) {
  if (light == nullptr) return;
  for (Lightsource** at = &state().lights; *at != nullptr; at = &(*at)->next) {
    if (*at != light) continue;
    *at = light->next;
    delete &info_of(*light);
    sfree(light);
    return;
  }
}

void lightsource_put(Lightsource* light, double x, double y, double z) {
  if (light == nullptr || is_spot(light)) return;
  V3d position(x, y, z);
  if (light->type == LIGHT_DIRECTION) position.normalize();
  info_of(*light).position = position;
}
void spotlight_pos(Lightsource* light, double x, double y, double z) {
  if (is_spot(light)) info_of(*light).position = V3d(x, y, z);
}
void spotlight_at(Lightsource* light, double x, double y, double z) {
  if (is_spot(light)) info_of(*light).target = V3d(x, y, z);
}
void spotlight_opening(Lightsource* light, double opening) {
  if (is_spot(light)) info_of(*light).opening_degrees = opening;
}
void spotlight_shadows(Lightsource* light, Sipp_bool flag) {
  if (is_spot(light)) info_of(*light).casts_shadows = flag != 0;
}
void light_color(Lightsource* light, double red, double grn, double blu) {
  if (light != nullptr) light->color = {red, grn, blu};
}
void light_active(Lightsource* light, Sipp_bool flag) {
  if (light != nullptr) light->active = flag != 0 ? TRUE : FALSE;
}

double light_eval(Lightsource* light, Vector* position, Vector* to_light) {
  if (light == nullptr || light->active == 0) {
    *to_light = {0, 0, 0};
    return 0;
  }
  const farop::Illumination light_there = farop::illuminate(world_light(*light), to_vector(*position));
  *to_light = from_vector(light_there.to_light);
  return light_there.fraction;
}

Camera* camera_create() {
  auto* const camera = static_cast<::Camera*>(smalloc(sizeof(::Camera)));
  *camera = {{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 0.25};
  return camera;
}
void camera_destruct(::Camera* camera) {
  if (camera == nullptr || camera == &state().standard_camera) return;
  if (sipp_camera == camera) sipp_camera = &state().standard_camera;
  sfree(camera);
}
void camera_position(::Camera* camera, double x, double y, double z) {
  if (camera != nullptr) camera->position = {x, y, z};
}
void camera_look_at(::Camera* camera, double x, double y, double z) {
  if (camera != nullptr) camera->lookat = {x, y, z};
}
void camera_up(::Camera* camera, double x, double y, double z) {
  if (camera != nullptr) camera->up = {x, y, z};
}
void camera_focal(::Camera* camera, double ratio) {
  if (camera != nullptr) camera->focal_ratio = ratio;
}
void camera_params(::Camera* camera, double x, double y, double z, double to_x, double to_y, double to_z,
                   double up_x, double up_y, double up_z, double ratio) {
  if (camera != nullptr) *camera = {{x, y, z}, {to_x, to_y, to_z}, {up_x, up_y, up_z}, ratio};
}
void camera_use(::Camera* camera) {
  if (camera != nullptr) sipp_camera = camera;
}
