// SPDX-License-Identifier: GPL-3.0-or-later
// Does: draws right pictures with 8 threads, an arena of 100 MiB, thread-local storage and exceptions;
//       prints a line.
// Why:  innocents must pass too: a cage that is too tight is of no use.
// needs: 8 threads allowed (it draws without them too, alone)
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "../hostile.h"

namespace {

constexpr std::size_t k_arena_bytes = std::size_t{100} << 20;
constexpr int k_threads = 8;

struct Degenerate : std::runtime_error {
  Degenerate() : std::runtime_error("no area") {}
};

// Polygons are collected during the frame and drawn in end_frame(), each thread its own band of rows.
class Innocent {
 public:
  Innocent() : arena_(new unsigned char[k_arena_bytes]) {
    for (std::size_t i = 0; i < k_arena_bytes; i += 4096) arena_[i] = 0;  // really used
    std::puts("innocent: 8 threads, 100 MiB");
    std::fflush(stdout);
  }

  farop_status begin(const farop_frame& frame) {
    if (frame.subpixel_bits != 0) return FAROP_E_UNSUPPORTED;
    frame_ = frame;
    used_ = 0;
    polygons_.clear();
    depth_.assign(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height),
                  frame.z_far + 1);
    return FAROP_OK;
  }

  farop_status add(const farop_polygon& polygon) {
    const std::size_t bytes = polygon.vertex_count * sizeof(farop_vertex);
    if (used_ + bytes > k_arena_bytes) flush();
    if (bytes > k_arena_bytes) return FAROP_E_MEMORY;
    farop_polygon copy = polygon;
    copy.vertices = reinterpret_cast<farop_vertex*>(arena_.get() + used_);
    std::memcpy(arena_.get() + used_, polygon.vertices, bytes);
    used_ += bytes;
    polygons_.push_back(copy);
    return FAROP_OK;
  }

  void flush() {
    std::vector<std::thread> threads;
    int band = 0;
    try {
      for (; band < k_threads - 1; ++band) threads.emplace_back([this, band] { draw_band(band); });
    } catch (const std::system_error&) {
      // No more threads to be had: the rest of the bands is drawn here.
    }
    for (; band < k_threads; ++band) draw_band(band);
    for (std::thread& thread : threads) thread.join();
    used_ = 0;
    polygons_.clear();
  }

 private:
  void draw_band(int band) {
    const int32_t low = static_cast<int32_t>(static_cast<int64_t>(frame_.height) * band / k_threads);
    const int32_t high = static_cast<int32_t>(static_cast<int64_t>(frame_.height) * (band + 1) / k_threads);
    for (const farop_polygon& polygon : polygons_) {
      try {
        draw(polygon, low, high);
      } catch (const Degenerate&) {
        // Nothing to draw.
      }
    }
  }

  void draw(const farop_polygon& p, int32_t low, int32_t high) {
    static thread_local std::vector<uint8_t> crossings;
    const farop_vertex* v = p.vertices;
    const farop_vertex* corner[3] = {v, v, v};
    int64_t largest = 0;
    for (uint32_t i = 1; i + 1 < p.vertex_count; ++i) {
      int64_t area = static_cast<int64_t>(v[i].x - v[0].x) * (v[i + 1].y - v[0].y) -
                     static_cast<int64_t>(v[i + 1].x - v[0].x) * (v[i].y - v[0].y);
      if (area < 0) area = -area;
      if (area <= largest) continue;
      largest = area;
      corner[1] = &v[i];
      corner[2] = &v[i + 1];
    }
    if (largest == 0) throw Degenerate();
    hostile_plane plane[4];
    for (int i = 0; i < 4; ++i) plane[i] = hostile_plane_of(&p, corner, i);
    for (int32_t y = low; y < high; ++y) {
      crossings.assign(static_cast<std::size_t>(frame_.width) + 1, 0);
      bool any = false;
      for (uint32_t i = 0; i < p.vertex_count; ++i) {
        const farop_vertex* from = &v[i];
        const farop_vertex* to = &v[i + 1 == p.vertex_count ? 0 : i + 1];
        if (from->y > to->y) std::swap(from, to);
        if (y < from->y || y >= to->y) continue;
        const int64_t rise = to->y - from->y;
        const int64_t first =
            from->x - hostile_floor_div(-(static_cast<int64_t>(y - from->y) * (to->x - from->x)), rise);
        crossings[static_cast<std::size_t>(hostile_clamp(first, 0, frame_.width))] ^= 1;
        any = true;
      }
      if (any) draw_row(plane, *corner[0], y, crossings);
    }
  }

  void draw_row(const hostile_plane* plane, const farop_vertex& origin, int32_t y,
                const std::vector<uint8_t>& crossings) {
    int inside = 0;
    for (int32_t x = 0; x < frame_.width; ++x) {
      inside ^= crossings[static_cast<std::size_t>(x)];
      if (!inside) continue;
      int32_t& depth = depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) +
                              static_cast<std::size_t>(x)];
      const int64_t dx = x - origin.x, dy = y - origin.y;
      const int32_t z = static_cast<int32_t>(hostile_value(&plane[0], dx, dy));
      if (z >= depth) continue;
      depth = z;
      uint8_t* at = frame_.pixels + y * frame_.row_bytes + 3 * static_cast<int64_t>(x);
      for (int i = 0; i < 3; ++i) at[i] = static_cast<uint8_t>(hostile_value(&plane[i + 1], dx, dy));
    }
  }

  std::unique_ptr<unsigned char[]> arena_;
  std::size_t used_ = 0;
  std::vector<farop_polygon> polygons_;
  std::vector<int32_t> depth_;
  farop_frame frame_{};
};

// Exceptions are used inside and never leave.
template <class Work>
farop_status guarded(Work work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  } catch (...) {
    return FAROP_E_INTERNAL;
  }
}

farop_status create(const farop_host*, void** self) {
  return guarded([&] {
    *self = new Innocent;
    return FAROP_OK;
  });
}
void destroy(void* self) {
  delete static_cast<Innocent*>(self);
}
farop_status begin_frame(void* self, const farop_frame* frame) {
  return guarded([&] { return static_cast<Innocent*>(self)->begin(*frame); });
}
farop_status polygon(void* self, const farop_polygon* polygon) {
  return guarded([&] { return static_cast<Innocent*>(self)->add(*polygon); });
}
farop_status end_frame(void* self) {
  return guarded([&] {
    static_cast<Innocent*>(self)->flush();
    return FAROP_OK;
  });
}

}  // namespace

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host*) {
  static const farop_rasterizer table = {sizeof(farop_rasterizer),
                                         FAROP_ABI_VERSION,
                                         "innocent",
                                         "a z-buffer in bands, one thread each",
                                         0,
                                         0,
                                         create,
                                         destroy,
                                         begin_frame,
                                         polygon,
                                         end_frame};
  return &table;
}
