// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's shaders as functions that programs call, in world space.
#include "shader_parameters_internal.h"
#include "shading/procedural_shaders.h"
#include "user_shader_internal.h"

using namespace farop::sipp_api;
using farop::Rgb;
using farop::V3d;

namespace {

farop::ShadingPoint point_of(const Vector* position, const Vector* normal, const Vector* texture,
                             const Vector* view_vec) {
  return {to_vector(*position), to_vector(*normal), to_vector(*texture), to_vector(*view_vec)};
}

void finish(const farop::BasicParameters& parameters, const farop::ShadingPoint& point,
            const Lightsource* lights, Color* color, Color* opacity) {
  *color = from_rgb(farop::basic_color(parameters, point, world_lights(lights)));
  *opacity = from_rgb(parameters.opacity);
}

template <class Description>
void pattern(const Vector* position, const Vector* normal, const Vector* texture, const Vector* view_vec,
             const Lightsource* lights, const Description* description, Color* color, Color* opacity) {
  guarded([&] {
    const Rgb base = pattern_of(*description).color(to_vector(*texture), *noise_table());
    finish(finish_of(*description).with(base), point_of(position, normal, texture, view_vec), lights, color,
           opacity);
  });
}

}  // namespace

void basic_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                  Surf_desc* description, Color* color, Color* opacity) {
  guarded([&] {
    finish(parameters_of(*description), point_of(position, normal, texture, view_vec), lights, color,
           opacity);
  });
}

void phong_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                  Phong_desc* description, Color* color, Color* opacity) {
  guarded([&] {
    *color = from_rgb(farop::phong_color(
        parameters_of(*description), point_of(position, normal, texture, view_vec), world_lights(lights)));
    *opacity = description->opacity;
  });
}

void strauss_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                    Strauss_desc* description, Color* color, Color* opacity) {
  guarded([&] {
    *color = from_rgb(farop::strauss_color(
        parameters_of(*description), point_of(position, normal, texture, view_vec), world_lights(lights)));
    *opacity = description->opacity;
  });
}

void marble_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                   Marble_desc* description, Color* color, Color* opacity) {
  pattern(position, normal, texture, view_vec, lights, description, color, opacity);
}
void granite_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                    Granite_desc* description, Color* color, Color* opacity) {
  pattern(position, normal, texture, view_vec, lights, description, color, opacity);
}
void bozo_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                 Bozo_desc* description, Color* color, Color* opacity) {
  pattern(position, normal, texture, view_vec, lights, description, color, opacity);
}
void wood_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                 Wood_desc* description, Color* color, Color* opacity) {
  pattern(position, normal, texture, view_vec, lights, description, color, opacity);
}
void planet_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                   Surf_desc* description, Color* color, Color* opacity) {
  pattern(position, normal, texture, view_vec, lights, description, color, opacity);
}

void mask_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                 Mask_desc* description, Color* color, Color* opacity) {
  const bool set = ask_masker(*description, texture);
  call_shader(set ? description->t_shader : description->f_shader, position, normal, texture, view_vec,
              lights, set ? description->t_surface : description->f_surface, color, opacity);
}

void bumpy_shader(Vector* position, Vector* normal, Vector* texture, Vector* view_vec, Lightsource* lights,
                  Bumpy_desc* description, Color* color, Color* opacity) {
  const farop::BumpParameters bumps = bumps_of(*description);
  Vector bent =
      from_vector(farop::bumpy_normal(bumps, to_vector(*normal), to_vector(*texture), *noise_table()));
  call_shader(description->shader, position, &bent, texture, view_vec, lights, description->surface, color,
              opacity);
}
