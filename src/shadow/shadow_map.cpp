// SPDX-License-Identifier: GPL-3.0-or-later
#include "shadow/shadow_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/limits.h"
#include "raster/internal_rasterizer.h"

namespace farop {
namespace {

/// As SIPP does for every camera: from 1/100 of the distance to the target to 100 times as far.
constexpr double k_depth_range = 100;

/// Hands polygons on as opaque ones without a surface of their own.
class Silhouettes : public ScreenPolygonSink {
 public:
  explicit Silhouettes(ScreenPolygonSink& inner) : inner_(inner) {}
  void begin_frame(const ScreenFrame& frame) override { inner_.begin_frame(frame); }
  void polygons(const ScreenPolygonBatch& batch) override {
    batch_.clear();
    batch_.vertices = batch.vertices;
    for (const ScreenPolygonRecord& record : batch.polygons) {
      batch_.polygons.push_back(record);
      batch_.polygons.back().material = nullptr;
      batch_.polygons.back().shader = nullptr;
    }
    inner_.polygons(batch_);
  }
  void end_frame() override { inner_.end_frame(); }

 private:
  ScreenPolygonSink& inner_;
  ScreenPolygonBatch batch_;
};

/// A direction that is not the light's own: its components one place on, crossed with it.
V3d up_of(const V3d& position, const V3d& target) {
  const V3d back = (position - target).normalized();
  V3d moved(back.y, back.z, back.x);
  constexpr double alike = 1e-5;
  if (std::abs(back.x - back.y) < alike && std::abs(back.y - back.z) < alike) moved.x = -moved.x;
  return moved.cross(position - target);
}

Camera camera_of(const Light& light) {
  const double distance = (light.target - light.position).length();
  Camera camera;
  camera.from = light.position, camera.at = light.target, camera.up = up_of(light.position, light.target);
  constexpr double narrowest = 0.001;  // also of what is no number
  camera.angle_degrees =
      light.opening_degrees > narrowest ? std::min(light.opening_degrees, 179.0) : narrowest;
  camera.hither = distance / k_depth_range;
  camera.yon = distance * k_depth_range;
  camera.fit_depth = true;
  return camera;
}

/// Spreads the bits of two numbers over 64 others (S. Vigna's splitmix64, finisher by D. Stafford).
std::uint64_t mixed(double a, double b) {
  std::uint64_t x = std::bit_cast<std::uint64_t>(a) + 0x9E3779B97F4A7C15u * std::bit_cast<std::uint64_t>(b);
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

int limited_size(const Light& light) {
  return std::clamp(light.shadow_size, 1, k_max_shadow_size);
}

void check_size_of_all(const Scene& scene) {
  std::int64_t texels = 0;
  std::int64_t maps = 0;
  for (const Light& light : scene.lights) {
    if (!casts_shadows(light)) continue;
    const std::int64_t size = limited_size(light);
    texels += size * size;
    ++maps;
  }
  if (texels <= k_max_shadow_texels) return;
  throw Error(ExitStatus::input,
              fmt::format("{} shadow maps have {} texels in all, expected {} at most", maps, texels,
                          k_max_shadow_texels),
              "make the maps smaller, or let fewer lights cast shadows");
}

}  // namespace

ShadowJitter::ShadowJitter(const std::function<double()>& uniform) {
  for (double& offset : offsets) offset = uniform();
}

ShadowMap::ShadowMap(const Scene& scene, const Light& light, std::shared_ptr<const ShadowJitter> jitter)
    : jitter_(std::move(jitter)) {
  const double distance = (light.target - light.position).length();
  if (!(distance > 0) || !std::isfinite(distance)) return;
  size_ = limited_size(light);
  bias_ = 0.005 * distance;

  Viewport viewport;
  viewport.resolution = {size_, size_, std::int64_t{1} << 24, 2};  // depths come back as float
  viewport.subpixel_bits = 8;
  GeometryOptions options;
  options.two_sided = true;
  options.unlit = true;
  options.light_at_eye = false;
  const Camera camera = camera_of(light);
  const GeometrySetup setup = prepare_geometry(scene, camera, viewport, options);
  world_to_light_ = world_to_eye(camera);
  center_ = (size_ - 1) / 2.0;
  scale_ = center_ / setup.tangents.x;

  InternalRasterizerOptions drawing;
  drawing.mode = DrawMode::gouraud;
  drawing.keep_depth = true;
  InternalRasterizer rasterizer(drawing);
  Silhouettes sink(rasterizer);
  GeometryClocks clocks;
  run_geometry(scene, setup, options, sink, clocks);
  depths_ = rasterizer.take().depth;
  // z_s = f (1 - d/z) / (f - d) the other way round.
  const double d = setup.nearest_depth, f = setup.farthest_depth;
  const double steps = static_cast<double>(viewport.resolution.z - 1);
  for (float& depth : depths_) {
    const double z = depth / steps;
    depth = z > 1 ? std::numeric_limits<float>::infinity() : static_cast<float>(d / (1 - z * (f - d) / f));
  }
}

bool ShadowMap::hidden(double column, double row, double depth) const {
  const double x = std::floor(column + 0.5), y = std::floor(row + 0.5);
  if (!(x >= 0 && x < size_ && y >= 0 && y < size_)) return false;
  const auto texel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
  return depths_[texel] < depth - bias_;
}

double ShadowMap::unshadowed(const V3d& point) const {
  if (size_ == 0) return 1;
  const V3d p = point * world_to_light_;
  if (!(p.z > 0)) return 1;
  const double column = center_ + scale_ * (p.x / p.z), row = center_ + scale_ * (p.y / p.z);
  if (!(column >= 0 && column <= size_ - 1 && row >= 0 && row <= size_ - 1)) return 1;
  const double half = 0.002 * size_;
  const int n = std::max(1, static_cast<int>(round_half_up(2 * half)));
  const double step = 2 * half / n;
  std::uint64_t place = mixed(column, row);
  const auto jittered = [&](int part) {
    return -half + (part + jitter_->offsets[place++ % jitter_->offsets.size()]) * step;
  };
  int lit = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double dx = jittered(i), dy = jittered(j);
      lit += hidden(column + dx, row + dy, p.z) ? 0 : 1;
    }
  }
  return static_cast<double>(lit) / (n * n);
}

bool casts_shadows(const Light& light) {
  const bool spot = light.kind == LightKind::spot_sharp || light.kind == LightKind::spot_soft;
  return spot && light.active && light.casts_shadows;
}

int cast_shadows(const Scene& scene, GeometrySetup& setup, const std::function<double()>& uniform) {
  check_size_of_all(scene);
  std::shared_ptr<const ShadowJitter> jitter;
  int maps = 0;
  std::size_t source = 0;
  for (const Light& light : scene.lights) {
    if (!light.active) continue;
    LightSource& seen = setup.shading.lights[source++];
    if (!casts_shadows(light)) continue;
    if (!jitter) jitter = std::make_shared<const ShadowJitter>(uniform);
    seen.shadow = std::make_shared<const MovedShadow>(std::make_shared<const ShadowMap>(scene, light, jitter),
                                                      setup.shading.eye_to_world);
    ++maps;
  }
  return maps;
}

}  // namespace farop
