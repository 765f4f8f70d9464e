// SPDX-License-Identifier: GPL-3.0-or-later
#include "primitives.h"

#include <algorithm>
#include <cstdio>

#include "library_internal.h"
#include "parse_sipp/bezier_file.h"
#include "parse_sipp/sipp_shapes.h"

namespace farop::sipp_api {
namespace {

/// The C object around a shape, with the look bound to each of its surfaces; parts become sub-objects.
::Object* wrapped(const farop::Object& shape, void* description, ::Shader* shader) {
  ::Object* const object = new_object();
  for (const auto& geometry : shape.surfaces) {
    ::Surface* const surface = new_surface(geometry, description, shader);
    surface->ref_count = 0;  // the object's alone, also where the program counts its own references
    append_surface(*object, *surface);
  }
  for (const auto& part : shape.children) {
    ::Object* const sub_object = wrapped(*part, description, shader);
    sub_object->ref_count = 0;
    append_sub_object(*object, *sub_object);
  }
  return object;
}

/// `make` gives the shape for a look. `call` and `expected` are for the message when it gives none: the call
/// as the program made it, what its arguments must be.
template <class Make>
::Object* primitive(void* description, ::Shader* shader, int texture, const std::string& call,
                    const char* expected, const Make& make) {
  return guarded<::Object*>(nullptr, [&]() -> ::Object* {
    if (texture < WORLD || texture > NATURAL) {
      throw Error(ExitStatus::input, fmt::format("{}: unknown texture mapping {}", call, texture),
                  "WORLD, CYLINDRICAL, SPHERICAL or NATURAL");
    }
    const std::shared_ptr<farop::Object> shape =
        make(sipp::ShapeLook{nullptr, static_cast<sipp::TextureMapping>(texture)});
    if (!shape) {
      throw Error(ExitStatus::input, fmt::format("{}: nothing is made", call),
                  fmt::format("expected {}", expected));
    }
    return wrapped(*shape, description, shader);
  });
}

std::vector<V3d> points_of(int count, const Vector* points) {
  std::vector<V3d> out;
  out.reserve(static_cast<std::size_t>(std::max(count, 0)));
  for (int i = 0; i < count; ++i) out.push_back(to_vector(points[i]));
  return out;
}

std::span<const int> indices_of(int groups, int size, const int* indices) {
  if (groups < 1 || indices == nullptr) return {};
  return {indices, static_cast<std::size_t>(groups) * static_cast<std::size_t>(size)};
}

std::string rest_of(std::FILE* file) {
  std::string text;
  char block[4096];
  while (const std::size_t n = std::fread(block, 1, sizeof block, file)) text.append(block, n);
  return text;
}

}  // namespace
}  // namespace farop::sipp_api

using namespace farop::sipp_api;
namespace sipp = farop::sipp;
using sipp::ShapeLook;

::Object* sipp_torus(double big_radius, double small_radius, int res_big, int res_small, void* description,
                     Shader* shader, int texture) {
  return primitive(description, shader, texture,
                   fmt::format("sipp_torus({}, {}, {}, {})", big_radius, small_radius, res_big, res_small),
                   "finite radii, resolutions of 1 or more", [&](const ShapeLook& look) {
                     return sipp::torus(big_radius, small_radius, res_big, res_small, look);
                   });
}
::Object* sipp_cone(double bottom_radius, double top_radius, double length, int res, void* description,
                    Shader* shader, int texture) {
  return primitive(
      description, shader, texture,
      fmt::format("sipp_cone({}, {}, {}, {})", bottom_radius, top_radius, length, res),
      "finite sizes, radii of 0 or more and not both 0, a resolution of 1 or more",
      [&](const ShapeLook& look) { return sipp::cone(bottom_radius, top_radius, length, res, look); });
}
::Object* sipp_cylinder(double radius, double length, int res, void* description, Shader* shader,
                        int texture) {
  return primitive(description, shader, texture,
                   fmt::format("sipp_cylinder({}, {}, {})", radius, length, res),
                   "finite sizes, a radius above 0, a resolution of 1 or more",
                   [&](const ShapeLook& look) { return sipp::cylinder(radius, length, res, look); });
}
::Object* sipp_ellipsoid(double x_radius, double y_radius, double z_radius, int res, void* description,
                         Shader* shader, int texture) {
  return primitive(description, shader, texture,
                   fmt::format("sipp_ellipsoid({}, {}, {}, {})", x_radius, y_radius, z_radius, res),
                   "finite radii, a resolution of 1 or more", [&](const ShapeLook& look) {
                     return sipp::ellipsoid({x_radius, y_radius, z_radius}, res, look);
                   });
}
::Object* sipp_sphere(double radius, int res, void* description, Shader* shader, int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_sphere({}, {})", radius, res),
                   "a finite radius, a resolution of 1 or more",
                   [&](const ShapeLook& look) { return sipp::sphere(radius, res, look); });
}
::Object* sipp_prism(int count, Vector* points, double length, void* description, Shader* shader,
                     int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_prism({}, points, {})", count, length),
                   "three finite points or more, a finite length", [&](const ShapeLook& look) {
                     std::vector<farop::V2d> outline;
                     outline.reserve(static_cast<std::size_t>(std::max(count, 0)));
                     for (int i = 0; i < count; ++i) outline.emplace_back(points[i].x, points[i].y);
                     return sipp::prism(outline, length, look);
                   });
}
::Object* sipp_block(double x_size, double y_size, double z_size, void* description, Shader* shader,
                     int texture) {
  return primitive(description, shader, texture,
                   fmt::format("sipp_block({}, {}, {})", x_size, y_size, z_size), "finite sizes",
                   [&](const ShapeLook& look) {
                     return sipp::block({x_size, y_size, z_size}, look);
                   });
}
::Object* sipp_cube(double size, void* description, Shader* shader, int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_cube({})", size), "a finite size",
                   [&](const ShapeLook& look) { return sipp::cube(size, look); });
}
::Object* sipp_bezier_file(FILE* file, int res, void* description, Shader* shader, int texture) {
  if (file == nullptr) {
    message("sipp_bezier_file: no file (is its fopen answered with NULL?)");
    return nullptr;
  }
  return primitive(description, shader, texture, fmt::format("sipp_bezier_file(file, {})", res),
                   "a whole description, a resolution of 1 or more",
                   [&](const ShapeLook& look) -> std::shared_ptr<farop::Object> {
                     const std::string text = rest_of(file);
                     farop::WordReader reader(text, "Bezier file");
                     PrintingSink sink;
                     const auto curves_or_patches = sipp::read_bezier_file(reader, sink);
                     return curves_or_patches ? sipp::bezier(*curves_or_patches, res, look) : nullptr;
                   });
}
::Object* sipp_bezier_patches(int vertex_count, Vector* vertices, int patch_count, int* indices, int res,
                              void* description, Shader* shader, int texture) {
  return primitive(
      description, shader, texture,
      fmt::format("sipp_bezier_patches({}, vertices, {}, indices, {})", vertex_count, patch_count, res),
      "finite vertices, indices of them from 0, a resolution of 1 or more", [&](const ShapeLook& look) {
        return sipp::bezier_patches(points_of(vertex_count, vertices), indices_of(patch_count, 16, indices),
                                    res, look);
      });
}
::Object* sipp_bezier_rotcurve(int vertex_count, Vector* vertices, int curve_count, int* indices, int res,
                               void* description, Shader* shader, int texture) {
  return primitive(
      description, shader, texture,
      fmt::format("sipp_bezier_rotcurve({}, vertices, {}, indices, {})", vertex_count, curve_count, res),
      "finite vertices, indices of them from 0, a resolution of 1 or more", [&](const ShapeLook& look) {
        return sipp::bezier_rotcurves(points_of(vertex_count, vertices), indices_of(curve_count, 4, indices),
                                      res, look);
      });
}
::Object* sipp_teapot(int res, void* description, Shader* shader, int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_teapot({})", res),
                   "a resolution of 1 or more",
                   [&](const ShapeLook& look) { return sipp::teapot(res, look); });
}
::Object* sipp_teapot_body(int res, void* description, Shader* shader, int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_teapot_body({})", res),
                   "a resolution of 1 or more",
                   [&](const ShapeLook& look) { return sipp::teapot_body(res, look); });
}
::Object* sipp_teapot_lid(int res, void* description, Shader* shader, int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_teapot_lid({})", res),
                   "a resolution of 1 or more",
                   [&](const ShapeLook& look) { return sipp::teapot_lid(res, look); });
}
::Object* sipp_teapot_spout(int res, void* description, Shader* shader, int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_teapot_spout({})", res),
                   "a resolution of 1 or more",
                   [&](const ShapeLook& look) { return sipp::teapot_spout(res, look); });
}
::Object* sipp_teapot_handle(int res, void* description, Shader* shader, int texture) {
  return primitive(description, shader, texture, fmt::format("sipp_teapot_handle({})", res),
                   "a resolution of 1 or more",
                   [&](const ShapeLook& look) { return sipp::teapot_handle(res, look); });
}
