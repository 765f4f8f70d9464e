// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_internal.h"

namespace farop::sipp_api {
namespace {

void refer(Surf_desc_hdr* header) {
  if (header != nullptr) ++header->ref_count;
}

void push(const V3d& position, const V3d& texture, const std::optional<V3d>& normal) {
  guarded([&] { state().builder.push_vertex({position, texture, normal}); });
}

/// A description as the program gives it: with headers on it is the address of one.
void bind(::Surface& surface, void* description, ::Shader* shader) {
  Surf_desc_hdr* header = nullptr;
  if (state().surface_headers && description != nullptr) {
    header = static_cast<Surf_desc_hdr*>(description);
    description = header + 1;
  }
  refer(header);  // first: it may be the one that goes
  surface_desc_unref(surface.header);
  surface.header = header;
  surface.description = description;
  surface.own_description.reset();
  surface.shader = shader;
}

void bind_basic(::Surface& surface, double ambient, double specular, double c3, const Color& color,
                const Color& opacity) {
  const auto description = std::make_shared<Surf_desc>(Surf_desc{ambient, specular, c3, color, opacity});
  surface_desc_unref(surface.header);
  surface.header = nullptr;
  surface.own_description = description;
  surface.description = description.get();
  surface.shader = reinterpret_cast<::Shader*>(&basic_shader);
}

}  // namespace

::Surface* new_surface(std::shared_ptr<farop::Surface> geometry, void* description, ::Shader* shader) {
  auto surface = std::make_unique<SippSurface>();
  surface->geometry = std::move(geometry);
  surface->ref_count = state().user_refcount ? 1 : 0;
  bind(*surface, description, shader);
  return surface.release();
}

}  // namespace farop::sipp_api

using namespace farop::sipp_api;
using farop::V3d;

void vertex_push(double x, double y, double z) {
  push({x, y, z}, {0, 0, 0}, std::nullopt);
}
void vertex_tx_push(double x, double y, double z, double u, double v, double w) {
  push({x, y, z}, {u, v, w}, std::nullopt);
}
void vertex_n_push(double x, double y, double z, double nx, double ny, double nz) {
  push({x, y, z}, {0, 0, 0}, V3d(nx, ny, nz));
}
void vertex_tx_n_push(double x, double y, double z, double u, double v, double w, double nx, double ny,
                      double nz) {
  push({x, y, z}, {u, v, w}, V3d(nx, ny, nz));
}

void polygon_push() {
  guarded([] { state().builder.push_polygon(); });
}

::Surface* surface_create(void* description, Shader* shader) {
  return guarded<::Surface*>(nullptr, [&]() -> ::Surface* {
    farop::sipp::SurfaceBuilder& builder = state().builder;
    if (builder.empty()) return nullptr;
    std::vector<bool> own_normals = builder.own_normals();
    ::Surface* const surface = new_surface(builder.create(nullptr), description, shader);
    surface->own_normals = std::move(own_normals);
    return surface;
  });
}

::Surface* surface_basic_create(double ambient, double red, double grn, double blu, double specular,
                                double c3, double opacity_red, double opacity_grn, double opacity_blu) {
  ::Surface* const surface = surface_create(nullptr, nullptr);
  surface_basic_shader(surface, ambient, red, grn, blu, specular, c3, opacity_red, opacity_grn, opacity_blu);
  return surface;
}

void surface_set_shader(::Surface* surface, void* description, Shader* shader) {
  if (surface == nullptr) return;
  guarded([&] { bind(*surface, description, shader); });
}

void surface_basic_shader(::Surface* surface, double ambient, double red, double grn, double blu,
                          double specular, double c3, double opacity_red, double opacity_grn,
                          double opacity_blu) {
  if (surface == nullptr) return;
  guarded([&] {
    bind_basic(*surface, ambient, specular, c3, {red, grn, blu}, {opacity_red, opacity_grn, opacity_blu});
  });
}

void surface_set_ffd(::Surface* surface, FFD_func* func, void* data) {
  if (surface == nullptr) return;
  Surf_desc_hdr* header = nullptr;
  if (state().ffd_headers && data != nullptr && func != nullptr) {
    header = static_cast<Surf_desc_hdr*>(data);
    data = header + 1;
  }
  refer(header);
  surface_desc_unref(surface->ffd_header);
  surface->ffd_header = header;
  surface->ffd = func;
  surface->ffd_data = data;
}

void surface_unref(::Surface* surface) {
  if (surface == nullptr || --surface->ref_count > 0) return;
  surface_desc_unref(surface->header);
  surface_desc_unref(surface->ffd_header);
  delete surface;
}

void surface_desc_unref(Surf_desc_hdr* header) {
  if (header == nullptr || --header->ref_count > 0 || header->free_func == nullptr) return;
  reinterpret_cast<void (*)(Surf_desc_hdr*)>(header->free_func)(header);
}
