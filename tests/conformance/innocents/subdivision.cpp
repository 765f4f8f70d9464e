// SPDX-License-Identifier: GPL-3.0-or-later
// Recursive subdivision, after J. E. Warnock, "A Hidden Surface Algorithm for Computer Generated Half-tone
// Pictures", University of Utah 1969, for one triangle at a time: a square of the picture is outside, inside,
// or quartered. Depth and colour from the plane, rounded to nearest; of equal depths the last drawn stays.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "farop/rasterizer.h"

namespace {

__extension__ using Int128 = __int128;

struct Corner {
  std::int64_t x, y;
  int value[4];
};

class Subdivision {
 public:
  void begin(const farop_frame& frame) {
    frame_ = &frame;
    depth_.assign(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height), INT32_MAX);
  }

  void draw(Corner a, Corner b, Corner c) {
    corner_[0] = a, corner_[1] = b, corner_[2] = c;
    area_ = side(a, b, c.x, c.y);
    if (area_ == 0) return;
    if (area_ < 0) std::swap(corner_[1], corner_[2]), area_ = -area_;
    int size = 1;
    while (size < std::max(frame_->width, frame_->height)) size *= 2;
    divide(0, 0, size);
  }

 private:
  /// Twice the area of a, b, (x, y).
  static std::int64_t side(const Corner& a, const Corner& b, std::int64_t x, std::int64_t y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  }

  enum class Place { outside, across, inside };

  /// Of the samples x .. x + size - 1, y .. y + size - 1.
  Place place_of(int x, int y, int size) const {
    const int bits = frame_->subpixel_bits;
    const std::int64_t x0 = std::int64_t{x} << bits, x1 = std::int64_t{x + size - 1} << bits;
    const std::int64_t y0 = std::int64_t{y} << bits, y1 = std::int64_t{y + size - 1} << bits;
    Place place = Place::inside;
    for (int i = 0; i < 3; ++i) {
      const Corner &a = corner_[i], &b = corner_[(i + 1) % 3];
      // Samples on the edge belong to a triangle on its right or above it.
      const bool owned = b.y < a.y || (b.y == a.y && b.x > a.x);
      int in = 0;
      for (const std::int64_t w :
           {side(a, b, x0, y0), side(a, b, x1, y0), side(a, b, x0, y1), side(a, b, x1, y1)}) {
        in += w > 0 || (w == 0 && owned) ? 1 : 0;
      }
      if (in == 0) return Place::outside;
      if (in < 4) place = Place::across;
    }
    return place;
  }

  void divide(int x, int y, int size) {
    if (x >= frame_->width || y >= frame_->height) return;
    const Place place = place_of(x, y, size);
    if (place == Place::outside) return;
    if (place == Place::inside) {
      for (int j = y; j < std::min(y + size, frame_->height); ++j) {
        for (int i = x; i < std::min(x + size, frame_->width); ++i) put(i, j);
      }
      return;
    }
    const int half = size / 2;  // a single sample is never across
    divide(x, y, half);
    divide(x + half, y, half);
    divide(x, y + half, half);
    divide(x + half, y + half, half);
  }

  void put(int x, int y) {
    const std::int64_t sx = std::int64_t{x} << frame_->subpixel_bits,
                       sy = std::int64_t{y} << frame_->subpixel_bits;
    std::int64_t weight[3];
    for (int i = 0; i < 3; ++i) weight[i] = side(corner_[(i + 1) % 3], corner_[(i + 2) % 3], sx, sy);
    const auto mix = [&](int attribute) {
      Int128 sum = 0;
      for (int i = 0; i < 3; ++i) sum += Int128{weight[i]} * corner_[i].value[attribute];
      return static_cast<int>((2 * sum + area_) / (2 * Int128{area_}));  // never negative
    };
    std::int32_t& nearest = depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_->width) +
                                   static_cast<std::size_t>(x)];
    const int z = mix(0);
    if (z > nearest) return;
    nearest = z;
    std::uint8_t* const pixel = frame_->pixels + y * frame_->row_bytes + 3 * x;
    for (int i = 0; i < 3; ++i) pixel[i] = static_cast<std::uint8_t>(mix(i + 1));
  }

  const farop_frame* frame_ = nullptr;
  std::vector<std::int32_t> depth_;
  Corner corner_[3] = {};
  std::int64_t area_ = 0;
};

farop_status create(const farop_host*, void** self) {
  *self = new (std::nothrow) Subdivision;
  return *self != nullptr ? FAROP_OK : FAROP_E_MEMORY;
}
void destroy(void* self) {
  delete static_cast<Subdivision*>(self);
}

const farop_frame* current;

farop_status begin_frame(void* self, const farop_frame* frame) {
  try {
    static_cast<Subdivision*>(self)->begin(*frame);
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  }
  current = frame;
  return FAROP_OK;
}

farop_status polygon(void* self, const farop_polygon* p) {
  Corner corners[3];
  for (int i = 0; i < 3; ++i) {
    const farop_vertex& v = p->vertices[i];
    const int bits = current->subpixel_bits;
    if (v.x < 0 || v.x > (current->width - 1) << bits || v.y < 0 || v.y > (current->height - 1) << bits) {
      return FAROP_E_INVALID;
    }
    corners[i] = {v.x, v.y, {v.z, v.r, v.g, v.b}};
  }
  static_cast<Subdivision*>(self)->draw(corners[0], corners[1], corners[2]);
  return FAROP_OK;
}

farop_status end_frame(void*) {
  return FAROP_OK;
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host*) {
  static const farop_rasterizer table = {sizeof table,
                                         FAROP_ABI_VERSION,
                                         "subdivision",
                                         "recursive subdivision",
                                         FAROP_WANT_TRIANGLES,
                                         0,
                                         create,
                                         destroy,
                                         begin_frame,
                                         polygon,
                                         end_frame};
  return &table;
}
