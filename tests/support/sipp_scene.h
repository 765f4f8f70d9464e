// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes like those that SIPP scripts make, and their pictures, without a script.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <vector>

#include "core/draw_mode.h"
#include "core/framebuffer.h"
#include "geometry/pipeline.h"
#include "raster/internal_rasterizer.h"
#include "scene/merge.h"
#include "scene/plane.h"
#include "scene/surface_builder.h"
#include "shading/noise.h"
#include "shadow/shadow_map.h"

namespace farop::test {

/// A surface with averaged normals that its object's matrix moves; texture coordinates are positions.
inline std::shared_ptr<Surface> finish(SurfaceBuilder& builder, std::shared_ptr<const Shader> shader) {
  auto surface = std::make_shared<Surface>(builder.take());
  surface->normal_rule = NormalRule::sipp;
  surface->shader = std::move(shader);
  surface->material = surface->shader->approximate();
  average_normals(*surface);
  for (const V3d& p : surface->positions) surface->textures.emplace_back(p);
  return surface;
}

/// Quads over u, v = 0..1; `place(u, v)` with u to the right and v upwards when seen from the front. Closed
/// in u.
inline std::shared_ptr<Surface> patch(int columns, int rows, const std::function<V3d(double, double)>& place,
                                      std::shared_ptr<const Shader> shader) {
  SurfaceBuilder builder;
  const auto corner = [&](int c, int r) {
    return place(static_cast<double>(c % columns) / columns, static_cast<double>(r) / rows);
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      builder.begin_polygon(false);
      std::vector<V3d> ring{corner(c, r), corner(c + 1, r), corner(c + 1, r + 1), corner(c, r + 1)};
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (i == 0 || ring[i] != ring[i - 1]) builder.add_corner(ring[i]);  // poles
      }
      builder.end_polygon();
    }
  }
  return finish(builder, std::move(shader));
}

inline std::shared_ptr<Surface> sphere(double radius, int columns, std::shared_ptr<const Shader> shader) {
  const int rows = columns / 2;
  return patch(
      columns, rows,
      [=](double u, double v) {
        const double around = 2 * std::numbers::pi * u;
        if (v <= 0 || v >= 1) return V3d(0, 0, v <= 0 ? -radius : radius);
        const double up = std::numbers::pi * (v - 0.5);
        return V3d(radius * std::cos(up) * std::cos(around), radius * std::cos(up) * std::sin(around),
                   radius * std::sin(up));
      },
      std::move(shader));
}

/// A rectangle in z = `z` that faces upwards, in n x n parts.
inline std::shared_ptr<Surface> floor(double half, double z, int n, std::shared_ptr<const Shader> shader) {
  SurfaceBuilder builder;
  const auto at = [&](int i) { return half * (2.0 * i / n - 1); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      builder.begin_polygon(false);
      builder.add_corner(V3d(at(x), at(y), z));
      builder.add_corner(V3d(at(x + 1), at(y), z));
      builder.add_corner(V3d(at(x + 1), at(y + 1), z));
      builder.add_corner(V3d(at(x), at(y + 1), z));
      builder.end_polygon();
    }
  }
  return finish(builder, std::move(shader));
}

inline std::shared_ptr<Object> object(std::vector<std::shared_ptr<Surface>> surfaces,
                                      const M44d& matrix = {}) {
  auto o = std::make_shared<Object>();
  o->surfaces = std::move(surfaces);
  o->to_parent = matrix;
  return o;
}

/// A scene that says it comes from SIPP, seen as a SIPP camera sees it.
inline Scene sipp_scene(const V3d& from, const V3d& at, double focal_ratio, int width, int height) {
  Scene scene;
  scene.inputs.push_back({"test.sipp", "sipp"});
  scene.root.children.push_back(std::make_shared<Object>());
  ViewParameters& view = scene.view;
  view.from = from, view.at = at, view.up = V3d(0, 0, 1);
  view.angle = 360 / std::numbers::pi * std::atan(focal_ratio);
  view.fit = Fit::smaller;
  view.hither = (at - from).length() / 100, view.yon = (at - from).length() * 100;
  view.fit_depth = true;
  view.resolution = {width, height};
  return scene;
}

/// The picture that `farop render` makes, shadows included: window edges mapped, 8 sub-pixel bits, 24 bits of
/// depth.
inline Framebuffer draw(const Scene& scene, DrawMode mode, PixelFit fit = PixelFit::edges) {
  DiagnosticList list;
  const bool sipp = !scene.inputs.empty() && scene.inputs.front().format == "sipp";
  const ViewParameters::Size size = complete_resolution(scene.view, list);
  Viewport viewport;
  viewport.resolution = {size.x, size.y, std::int64_t{1} << 24, 256};
  viewport.pixel_fit = fit;
  viewport.subpixel_bits = 8;
  viewport.half_pixel_border = fit == PixelFit::edges;
  GeometryOptions options;
  options.flat = mode == DrawMode::flat;
  options.light_at_eye = !sipp;
  options.two_sided = scene.drawing.two_sided.value_or(false);
  GeometrySetup setup = prepare_geometry(scene, complete_camera(scene.view, list), viewport, options);
  cast_shadows(scene, setup, [random = Rand48()]() mutable { return random.next(); });
  InternalRasterizerOptions drawing;
  drawing.mode = mode;
  drawing.background = scene.view.background.value_or(Rgb{});
  drawing.additive_transparency = sipp;
  drawing.shading = setup.shading;
  InternalRasterizer rasterizer(drawing);
  GeometryClocks clocks;
  run_geometry(scene, setup, options, rasterizer, clocks);
  return rasterizer.take();
}

/// How far two pictures of one size are apart, in levels of 255 per channel.
struct PictureDifference {
  double mean = 0;        ///< over all channels of all pixels
  int largest = 0;        ///< of any channel
  double within_one = 1;  ///< share of pixels all of whose channels differ by at most 1
};
inline PictureDifference compare(const Framebuffer& a, const Framebuffer& b) {
  PictureDifference d;
  if (a.rgb.size() != b.rgb.size() || a.rgb.empty()) return {255, 255, 0};
  std::size_t near = 0;
  for (std::size_t pixel = 0; pixel < a.rgb.size() / 3; ++pixel) {
    int most = 0;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
      const int difference = std::abs(a.rgb[c] - b.rgb[c]);
      d.mean += difference;
      most = std::max(most, difference);
    }
    d.largest = std::max(d.largest, most);
    near += most <= 1 ? 1 : 0;
  }
  d.mean /= static_cast<double>(a.rgb.size());
  d.within_one = static_cast<double>(near) / static_cast<double>(a.rgb.size() / 3);
  return d;
}

}  // namespace farop::test
