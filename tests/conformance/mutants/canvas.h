// SPDX-License-Identifier: GPL-3.0-or-later
// Picture and depth buffer of the faulty rasterizers. MUTANT is the number of the fault (manifest.tsv); 0 has
// none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <memory>

#include "farop/rasterizer.h"

#ifndef MUTANT
#define MUTANT 0
#endif

constexpr int k_mutant = MUTANT;

struct Rgb {
  std::uint8_t r, g, b;
};

class Canvas {
 public:
  void begin(const farop_frame& frame) {
    frame_ = &frame;
    const int width = frame.width;
    depth_.reset(new std::uint32_t[static_cast<std::size_t>(width) * static_cast<std::size_t>(frame.height)]);
    std::uint32_t farthest = UINT32_MAX;  // beyond every legal depth: a polygon on the far plane has to show
    // 42: takes larger z for nearer, consistently.
    // 44: calloc() in place of a depth: nothing is nearer than 0.
    if (k_mutant == 42 || k_mutant == 44) farthest = 0;
    // 43: starts on the far plane, where the strict test loses what lies on it.
    if (k_mutant == 43) farthest = static_cast<std::uint32_t>(frame.z_far);
    // 64: the loop that clears the depths starts at 1, and column 0 keeps what was on the heap.
    const int first = k_mutant == 64 ? 1 : 0;
    for (int y = 0; y < frame.height; ++y) {
      for (int x = first; x < width; ++x) depth_at(x, y) = farthest;
    }
    if constexpr (k_mutant == 40) {
      // 40: clears the picture once more, with <= in the loop over the rows.
      for (int y = 0; y <= frame.height; ++y) clear_row(y, frame.background);
    }
  }

  /// Before every polygon.
  void begin_polygon() {
    if constexpr (k_mutant == 39) {
      // 39: clears the picture for each polygon, and not even to its background.
      const std::uint8_t white[] = {255, 255, 255};
      for (int y = 0; y < height(); ++y) clear_row(y, white);
    }
  }

  int width() const { return frame_->width; }
  int height() const { return frame_->height; }

  /// Whether depth z shows at (x, y): strictly nearer than what is there.
  bool shows(int x, int y, int z) const {
    const std::uint32_t here = depth_at(x, y), depth = static_cast<std::uint32_t>(z);
    switch (k_mutant) {
      case 41:  // 41: no depth test
      case 53:  // 53: trusts the order of the painter's sort
        return true;
      case 42:
        return depth >= here;
      case 45:  // 45: `<=` in one of two copies of the loop, which take the rows in turn
        return y % 2 == 1 ? depth <= here : depth < here;
      default:
        return depth < here;
    }
  }

  /// Depth test, then colour and depth. Returns whether it showed.
  bool put(int x, int y, int z, Rgb color) {
    const bool visible = shows(x, y, z);
    if (visible) set_color(x, y, color);
    // 51: the braces end too early, and depth is written whether or not the test was passed.
    if (visible || k_mutant == 51) depth_at(x, y) = static_cast<std::uint32_t>(z);
    return visible;
  }

  /// No test, no depth.
  void set_color(int x, int y, Rgb color) {
    store(x, y, color);
    if constexpr (k_mutant == 68) {
      // 68: a cosmic ray, or a race with another thread: now and then some pixel changes that is not meant.
      if (random() % 100000 == 0) {
        store(static_cast<int>(random() % static_cast<std::uint64_t>(width())),
              static_cast<int>(random() % static_cast<std::uint64_t>(height())), color);
      }
    }
  }

 private:
  void store(int x, int y, Rgb color) {
    std::uint8_t* const p = pixel(x, y);
    p[0] = color.r, p[1] = color.g, p[2] = color.b;
    if constexpr (k_mutant == 38) p[0] = color.b, p[2] = color.r;  // 38: the order of a Windows bitmap
  }

  std::uint8_t* pixel(int x, int y) const {
    switch (k_mutant) {
      case 35:  // 35: image[x][y]
        return frame_->pixels + x * frame_->row_bytes + 3 * y;
      case 36:  // 36: rows stand one right behind the other
        return frame_->pixels + 3 * (std::ptrdiff_t{y} * width() + x);
      case 37:  // 37: row 0 is the top one
        return frame_->pixels + (height() - 1 - y) * frame_->row_bytes + 3 * x;
      default:
        return frame_->pixels + y * frame_->row_bytes + 3 * x;
    }
  }

  void clear_row(int y, const std::uint8_t* rgb) {
    std::uint8_t* const row = frame_->pixels + y * frame_->row_bytes;
    for (int x = 0; x < width(); ++x) std::memcpy(row + 3 * x, rgb, 3);
  }

  std::uint32_t& depth_at(int x, int y) const {
    return depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
                  static_cast<std::size_t>(x)];
  }

  /// Xorshift (G. Marsaglia, "Xorshift RNGs", Journal of Statistical Software 8(14), 2003); another course in
  /// every run.
  static std::uint64_t random() {
    static std::uint64_t state = [] {
      std::timespec now{};
      std::timespec_get(&now, TIME_UTC);
      return static_cast<std::uint64_t>(now.tv_nsec) * 0x9E3779B97F4A7C15u | 1;
    }();
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return state;
  }

  const farop_frame* frame_ = nullptr;
  std::unique_ptr<std::uint32_t[]> depth_;
};
