// SPDX-License-Identifier: GPL-3.0-or-later
// Pixmaps and bitmaps in memory.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "library_internal.h"
#include "sipp_bitmap.h"
#include "sipp_pixmap.h"

namespace {

bool usable(int width, int height) {
  if (width > 0 && height > 0) return true;
  farop::sipp_api::message(fmt::format("an image of {} x {} pixels", width, height));
  return false;
}

/// Cuts a line to the surroundings of an image, unless it lies in them; false: nothing is left.
bool cut_to(const Sipp_bitmap& bitmap, int& x1, int& y1, int& x2, int& y2) {
  constexpr int margin = 32768;
  const double low = -margin, high_x = bitmap.width + margin, high_y = bitmap.height + margin;
  const auto near_by = [&](int x, int y) { return x >= low && x <= high_x && y >= low && y <= high_y; };
  if (near_by(x1, y1) && near_by(x2, y2)) return true;
  const double dx = static_cast<double>(x2) - x1, dy = static_cast<double>(y2) - y1;
  double enter = 0, leave = 1;
  const auto side = [&](double direction, double distance) {  // inside where direction * t <= distance
    if (direction == 0) return distance >= 0;
    (direction < 0 ? enter : leave) =
        direction < 0 ? std::max(enter, distance / direction) : std::min(leave, distance / direction);
    return enter <= leave;
  };
  const double ox = x1, oy = y1;
  if (!side(-dx, ox - low) || !side(dx, high_x - ox) || !side(-dy, oy - low) || !side(dy, high_y - oy)) {
    return false;
  }
  x1 = static_cast<int>(std::lround(ox + enter * dx)), y1 = static_cast<int>(std::lround(oy + enter * dy));
  x2 = static_cast<int>(std::lround(ox + leave * dx)), y2 = static_cast<int>(std::lround(oy + leave * dy));
  return true;
}

void blacken(Sipp_bitmap& bitmap, int x, int y) {
  if (x < 0 || y < 0 || x >= bitmap.width || y >= bitmap.height) return;
  u_char* const row =
      bitmap.buffer + static_cast<std::size_t>(y) * static_cast<std::size_t>(bitmap.width_bytes);
  row[x / 8] = static_cast<u_char>(row[x / 8] | (0x80 >> (x % 8)));
}

}  // namespace

using namespace farop::sipp_api;

Sipp_pixmap* sipp_pixmap_create(int width, int height) {
  if (!usable(width, height)) return nullptr;
  auto* const pixmap = static_cast<Sipp_pixmap*>(smalloc(sizeof(Sipp_pixmap)));
  pixmap->width = width;
  pixmap->height = height;
  pixmap->buffer =
      static_cast<u_char*>(scalloc(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 3));
  return pixmap;
}
void sipp_pixmap_destruct(Sipp_pixmap* pixmap) {
  if (pixmap == nullptr) return;
  sfree(pixmap->buffer);
  sfree(pixmap);
}
void sipp_pixmap_set_pixel(Sipp_pixmap* pixmap, int x, int y, int red, int grn, int blu) {
  if (pixmap == nullptr) return;
  if (x < 0 || y < 0 || x >= pixmap->width || y >= pixmap->height) {
    message(
        fmt::format("pixel ({}, {}) is outside of a pixmap of {} x {}", x, y, pixmap->width, pixmap->height));
    return;
  }
  u_char* const p =
      pixmap->buffer + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(pixmap->width) +
                            static_cast<std::size_t>(x));
  p[0] = static_cast<u_char>(red);
  p[1] = static_cast<u_char>(grn);
  p[2] = static_cast<u_char>(blu);
}
void sipp_pixmap_write(FILE* file, Sipp_pixmap* pixmap) {
  if (file == nullptr || pixmap == nullptr) return;
  std::fprintf(file, "P6\n# FAROP, SIPP %s\n%d\n%d\n255\n", SIPP_VERSION, pixmap->width, pixmap->height);
  std::fwrite(pixmap->buffer, 3,
              static_cast<std::size_t>(pixmap->width) * static_cast<std::size_t>(pixmap->height), file);
  if (std::fflush(file) != 0 || std::ferror(file) != 0) message("the pixmap cannot be written");
}

Sipp_bitmap* sipp_bitmap_create(int width, int height) {
  if (!usable(width, height)) return nullptr;
  auto* const bitmap = static_cast<Sipp_bitmap*>(smalloc(sizeof(Sipp_bitmap)));
  bitmap->width = width;
  bitmap->height = height;
  bitmap->width_bytes = width / 8 + (width % 8 != 0 ? 1 : 0);
  bitmap->buffer = static_cast<u_char*>(
      scalloc(static_cast<std::size_t>(height), static_cast<std::size_t>(bitmap->width_bytes)));
  return bitmap;
}
void sipp_bitmap_destruct(Sipp_bitmap* bitmap) {
  if (bitmap == nullptr) return;
  sfree(bitmap->buffer);
  sfree(bitmap);
}
// What lies far outside is cut off first, or its way would be long: Y. Liang, B. Barsky, "A New Concept and
// Method for Line Clipping", ACM TOG 3(1), 1984. J. Bresenham, "Algorithm for Computer Control of a Digital
// Plotter", IBM Systems Journal 4(1), 1965.
void sipp_bitmap_line(Sipp_bitmap* bitmap, int x1, int y1, int x2, int y2) {
  if (bitmap == nullptr || !cut_to(*bitmap, x1, y1, x2, y2)) return;
  const std::int64_t dx = std::abs(std::int64_t{x2} - x1), dy = std::abs(std::int64_t{y2} - y1);
  const int step_x = x1 < x2 ? 1 : -1, step_y = y1 < y2 ? 1 : -1;
  std::int64_t error = dx - dy;
  while (true) {
    blacken(*bitmap, x1, y1);
    if (x1 == x2 && y1 == y2) return;
    const std::int64_t twice = 2 * error;
    if (twice > -dy) error -= dy, x1 += step_x;
    if (twice < dx) error += dx, y1 += step_y;
  }
}
void sipp_bitmap_write(FILE* file, Sipp_bitmap* bitmap) {
  if (file == nullptr || bitmap == nullptr) return;
  std::fprintf(file, "P4\n# FAROP, SIPP %s\n%d\n%d\n", SIPP_VERSION, bitmap->width, bitmap->height);
  std::fwrite(bitmap->buffer, static_cast<std::size_t>(bitmap->width_bytes),
              static_cast<std::size_t>(bitmap->height), file);
  if (std::fflush(file) != 0 || std::ferror(file) != 0) message("the bitmap cannot be written");
}
