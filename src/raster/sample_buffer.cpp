// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/sample_buffer.h"

namespace farop {

std::uint32_t MaterialTable::number(const Material* material, const Shader* shader) {
  if (material == last_) return last_number_;
  const auto [entry, is_new] = numbers_.try_emplace(material, static_cast<std::uint32_t>(looks_.size()));
  if (is_new) looks_.push_back({material, shader});
  last_ = material, last_number_ = entry->second;
  return last_number_;
}

}  // namespace farop
