// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster/line.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "raster/wide_integer.h"

namespace farop {

void draw_line(Framebuffer& picture, PixelPosition a, PixelPosition b,
               const std::array<std::uint8_t, 3>& color) {
  if (std::pair(b.y, b.x) < std::pair(a.y, a.x)) std::swap(a, b);
  const std::int64_t width = picture.width, height = picture.height;
  const std::int64_t dx = std::abs(b.x - a.x), dy = b.y - a.y;
  const std::int64_t x_sign = b.x < a.x ? -1 : 1;
  const bool steep = dy > dx;
  const std::int64_t length = steep ? dy : dx, rise = steep ? dx : dy;

  // Steps 0 .. length along the longer axis, cut to those inside the picture.
  std::int64_t first = 0, last = length;
  if (steep) {
    first = std::max(first, -a.y), last = std::min(last, height - 1 - a.y);
  } else if (x_sign > 0) {
    first = std::max(first, -a.x), last = std::min(last, width - 1 - a.x);
  } else {
    first = std::max(first, a.x - (width - 1)), last = std::min(last, a.x);
  }
  if (first > last) return;

  // After k steps the other axis has moved floor((2 k rise + length) / (2 length)); `rest` is the remainder.
  const std::int64_t whole = std::max<std::int64_t>(2 * length, 1);
  const Int128 moved_at_first = Int128{2} * first * rise + length;
  std::int64_t moved = static_cast<std::int64_t>(moved_at_first / whole);
  std::int64_t rest = static_cast<std::int64_t>(moved_at_first % whole);
  for (std::int64_t k = first; k <= last; ++k) {
    const std::int64_t x = a.x + x_sign * (steep ? moved : k);
    const std::int64_t y = a.y + (steep ? k : moved);
    if (x >= 0 && x < width && y >= 0 && y < height) {
      const std::size_t pixel = picture.pixel(static_cast<int>(x), static_cast<int>(y));
      std::copy(color.begin(), color.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * pixel));
    }
    rest += 2 * rise;
    if (rest >= whole) rest -= whole, ++moved;
  }
}

}  // namespace farop
