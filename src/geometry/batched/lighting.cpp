// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/batched/lighting.h"

#include <algorithm>

namespace farop::batched {
namespace {

LightRow::Kind kind_of(const LightSource& light) {
  if (light.kind == LightKind::directional) return LightRow::Kind::directional;
  const bool plain = light.kind == LightKind::point && !light.shadow;
  return plain ? LightRow::Kind::point : LightRow::Kind::prepared;
}

}  // namespace

Lighting::Lighting(const ShadingFrame& frame, const DeviceMapping& mapping)
    : frame_(frame), mapping_(mapping) {
  reflection_.color_max = mapping.terms().color_max;
  for (const LightSource& light : frame.lights) {
    LightRow row;
    row.kind = kind_of(light);
    row.position = light.position;
    row.color = light.color;
    rows_.push_back(row);
  }
  prepared_.resize(std::ranges::count(rows_, LightRow::Kind::prepared, &LightRow::kind));
  auto next = prepared_.begin();
  for (LightRow& row : rows_) {
    if (row.kind != LightRow::Kind::prepared) continue;
    row.prepared = {next->to_x, next->to_y, next->to_z, next->fraction};
    ++next;
  }
  reflection_.lights = rows_;
}

void Lighting::take(const Material& material) {
  if (material_ == &material) return;
  material_ = &material;
  reflection_.ambient = material.color * material.ka;
  reflection_.color = material.color;
  reflection_.kd = material.kd;
  reflection_.ks = material.ks;
  reflection_.shine = material.shine;
  for (LightRow& row : rows_) row.tint = row.color * material.color;
}

void Lighting::prepare(std::size_t n, const PointArrays& points) {
  auto block = prepared_.begin();
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != LightRow::Kind::prepared) continue;
    for (std::size_t i = 0; i < n; ++i) {
      const Illumination here = illuminate(frame_.lights[k], V3d(points.x[i], points.y[i], points.z[i]));
      block->to_x[i] = here.to_light.x;
      block->to_y[i] = here.to_light.y;
      block->to_z[i] = here.to_light.z;
      block->fraction[i] = here.fraction;
    }
    ++block;
  }
}

void Lighting::by_material(const Material& material, std::size_t n, const LitArrays& arrays) {
  take(material);
  if (prepared_.empty()) {
    light(reflection_, n, arrays.points, arrays.normals, arrays.red_green, arrays.blue);
    return;
  }
  for (std::size_t i = 0; i < n; i += k_block) {
    const std::size_t count = std::min(k_block, n - i);
    const auto from = [i](const PointArrays& p) { return PointArrays{p.x + i, p.y + i, p.z + i}; };
    prepare(count, from(arrays.points));
    light(reflection_, count, from(arrays.points), from(arrays.normals), arrays.red_green + i,
          arrays.blue + i);
  }
}

}  // namespace farop::batched
