// SPDX-License-Identifier: GPL-3.0-or-later
// The fast way through what large files consist of: polygons and fills, one after the other, without comments
// and without anything to remark. Everything else is left to the parser, which goes on where such a run ends.
// What a run gives depends on its text alone, not on what stands before it, so it can be read ahead of time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "scene/surface_builder.h"
#include "shading/material.h"

namespace farop::nff {

/// Where reading must stop. Words of a run end at `end` or before; bytes up to `readable` may be looked at,
/// to see that a word ends there and what follows.
struct PlainText {
  const char* end = nullptr;
  const char* readable = nullptr;
};

/// Entities one after the other.
struct PlainRun {
  const char* behind = nullptr;  ///< of the last word; nullptr: there is no run
  bool begins_with_fill = false;
  bool ends_with_fill = false;
  std::uint64_t polygons = 0, patches = 0;
  /// The last polygon: its keyword, its corners.
  const char* last_keyword = nullptr;
  std::int64_t last_corners = 0;
  bool last_is_patch = false;
};

class PlainRunReader {
 public:
  using FillFunction = std::function<void(const Material&)>;

  /// Reads entities from the keyword at `at` on, for as long as they are plain: `p` and `pp` of at most some
  /// hundred corners, none of them bent, with decimal numbers, and `f` with its eight numbers in range. The
  /// corners go to `builder`; `on_fill` is called for every `f`, when the surface before it is complete.
  PlainRun read(const char* at, const PlainText& text, SurfaceBuilder& builder, const FillFunction& on_fill);

 private:
  static constexpr std::size_t k_most_numbers = 1536;

  const char* read_polygon(const char* at, const PlainText& text, SurfaceBuilder& builder);
  const char* read_fill(const char* at, const PlainText& text);
  const char* read_numbers(const char* at, const PlainText& text, std::size_t wanted);
  bool last_is_flat(std::size_t corners, std::size_t stride) const;
  Material material() const;
  void hand_over(SurfaceBuilder& builder);

  /// Polygons that wait to be handed over together, all `p` or all `pp`; behind them what is being read.
  std::array<double, k_most_numbers> numbers_;
  std::size_t used_ = 0;
  std::vector<std::uint32_t> corner_counts_;
  bool patches_ = false;
};

}  // namespace farop::nff
