// SPDX-License-Identifier: GPL-3.0-or-later
// Any polygon of finite doubles: what is left of it lies inside the frustum to the last bit, with unit
// normals.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "geometry/clip.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double k_largest = 1e150;  // what EyeVertex promises to take
  std::vector<double> numbers(size / sizeof(double));
  if (!numbers.empty()) std::memcpy(numbers.data(), data, numbers.size() * sizeof(double));
  for (double& v : numbers) {
    if (!(std::abs(v) <= k_largest)) v = 1;
  }
  if (numbers.size() < 3) return 0;

  farop::Frustum frustum{.tan_x = 0.5, .tan_y = 0.25, .hither = std::abs(numbers[0]) + 1e-6, .yon = 0};
  frustum.yon = numbers[1] < 0 ? HUGE_VAL : frustum.hither * 2 + numbers[1];
  std::vector<farop::EyeVertex> polygon;
  for (std::size_t i = 2; i + 2 < numbers.size(); i += 3) {
    const farop::V3d position(numbers[i], numbers[i + 1], numbers[i + 2]);
    const farop::V3d normal = i % 2 == 0 ? farop::V3d(0, 0, -1) : farop::V3d(0.6, 0, 0.8);
    polygon.push_back({position, normal, static_cast<std::uint32_t>(i)});
  }
  farop::ClipScratch scratch;
  if (farop::clip_to_frustum(polygon, frustum, scratch) == farop::ClipResult::outside) return 0;
  for (const farop::EyeVertex& v : polygon) {
    const auto& [x, y, z] = v.position;
    const bool inside = z >= frustum.hither && z <= frustum.yon && std::abs(x) <= z * frustum.tan_x &&
                        std::abs(y) <= z * frustum.tan_y;
    if (!inside || !(std::abs(v.normal.length() - 1) < 1e-12)) std::abort();
  }
  return 0;
}
