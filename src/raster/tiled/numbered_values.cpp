// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/tiled/numbered_values.h"

#include "raster/corner_color.h"
#include "shading/material.h"

namespace farop::tiled {

V3f NumberedValues::color(std::uint32_t number, int x, int y) {
  if (number != number_) set(number);
  return span_ != nullptr ? V3f(span_->color.at(span_->distance(x))) : planes_->color(x, y);
}

V3f NumberedValues::opacity(std::uint32_t number, int x, int y) {
  if (number != number_) set(number);
  if (span_ != nullptr) return V3f(opacities_->at(span_->distance(x)));
  if (one_opacity_) return V3f(corner_opacities_[0]);
  return V3f(Barycentric(triangle_, subpixel_bits_, x, y)
                 .mix(corner_opacities_[0], corner_opacities_[1], corner_opacities_[2]));
}

void NumberedValues::set(std::uint32_t number) {
  number_ = number;
  span_ = nullptr;
  if ((number & k_piece_bit) == 0) {
    set_triangle(*entries_[number]);
    return;
  }
  constexpr std::uint32_t k_places = (1u << k_portion_shift) - 1;
  const KeptSpans& kept = portions_[(number & ~k_piece_bit) >> k_portion_shift]->spans();
  span_ = &kept.spans[kept.pieces[number & k_places].span];
  opacities_ = kept.opacities.empty() ? nullptr : &kept.opacities[span_->opacity];
}

void NumberedValues::set_triangle(const TriangleEntry& e) {
  ScreenVertex* const corners[3] = {&triangle_.a, &triangle_.b, &triangle_.c};
  for (std::size_t k = 0; k < 3; ++k) {
    ScreenVertex& v = *corners[k];
    v.x = e.x[k], v.y = e.y[k], v.z = e.z[k];
    v.r = static_cast<std::uint8_t>(e.color[k]), v.g = static_cast<std::uint8_t>(e.color[k] >> 8);
    v.b = static_cast<std::uint8_t>(e.color[k] >> 16);
  }
  planes_.emplace(triangle_, subpixel_bits_);
  if (e.transparent == 0) return;
  const FillPolygon polygon = portions_[e.portion]->kept()[e.source];
  for (std::size_t k = 0; k < 3; ++k) {
    corner_opacities_[k] =
        polygon.opacities.empty() ? to_vector(polygon.look.material->opacity()) : V3d(polygon.opacities[k]);
  }
  one_opacity_ = corner_opacities_[0] == corner_opacities_[1] && corner_opacities_[0] == corner_opacities_[2];
}

}  // namespace farop::tiled
