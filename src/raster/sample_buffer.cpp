// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/sample_buffer.h"

#include "shading/shader.h"

namespace farop {

bool SurfaceLook::is_opaque() const {
  if (material == nullptr) return true;
  return shader != nullptr ? shader->opaque() : material->opaque();
}

bool SurfaceLook::is_invisible() const {
  if (material == nullptr) return false;
  return shader != nullptr ? shader->invisible() : material->opacity() == Rgb{0, 0, 0};
}

std::uint32_t MaterialTable::number(const SurfaceLook& look) {
  if (look.material == last_) return last_number_;
  const auto [entry, is_new] = numbers_.try_emplace(look.material, static_cast<std::uint32_t>(looks_.size()));
  if (is_new) looks_.push_back(look);
  last_ = look.material, last_number_ = entry->second;
  return last_number_;
}

}  // namespace farop
