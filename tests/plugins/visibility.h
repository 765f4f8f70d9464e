// SPDX-License-Identifier: GPL-3.0-or-later
// Who has to be seen at a sample, from exact depths.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "plugins/plugin_cases.h"

namespace farop::test {

/// A polygon with an exact depth (triangle, or planar on the lattice) and a colour of its own.
struct Shown {
  Corners corners;
  reference::AffineFunction depth;
  int number = 0;
};

/// Numbers its polygons by colour. Those without area are left out.
class VisibilityScene {
 public:
  /// Drawn with these ids, flags and so on, but with corners of its own colour. Depths must be planar.
  void add(Corners corners, PluginPolygon polygon) {
    const int number = static_cast<int>(polygons_.size()) + 1;
    paint(corners, number & 255, number >> 8, 0);
    polygon.corners = plugin_polygon(corners).corners;
    polygons_.push_back(std::move(polygon));
    const auto depth = exact_attribute(corners, Attribute::z);
    if (depth) shown_.push_back({std::move(corners), *depth, number});
  }
  void add(const Corners& corners) { add(corners, plugin_polygon(corners)); }

  const std::vector<PluginPolygon>& polygons() const { return polygons_; }

  /// At every sample the polygon that is seen must not be a whole unit behind another one. With `exact`
  /// (depths are whole numbers at all samples) it must be the first drawn of the nearest.
  void expect_seen(const PluginPicture& picture, const PluginFrame& frame, bool exact,
                   const std::string& what) const {
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        const auto rgb = picture.at(x, y);
        const int seen = rgb[0] + 256 * rgb[1];
        const Shown* nearest = nullptr;
        const Shown* drawn = nullptr;
        reference::Rational nearest_depth;
        for (const Shown& s : shown_) {
          if (!reference::covers(s.corners, frame.subpixel_bits, x, y)) continue;
          if (s.number == seen) drawn = &s;
          const reference::Rational here = s.depth.at(frame.subpixel_bits, x, y);
          if (nearest == nullptr ||
              here.numerator * nearest_depth.denominator < nearest_depth.numerator * here.denominator) {
            nearest = &s, nearest_depth = here;
          }
        }
        if (nearest == nullptr || exact) {
          ASSERT_EQ(seen, nearest == nullptr ? 0 : nearest->number) << what << " at " << x << " " << y;
          continue;
        }
        ASSERT_NE(drawn, nullptr) << what << " at " << x << " " << y << ": " << seen << " is not there";
        const reference::Rational depth = drawn->depth.at(frame.subpixel_bits, x, y);
        const Int128 behind =
            depth.numerator * nearest_depth.denominator - nearest_depth.numerator * depth.denominator;
        ASSERT_LT(behind, depth.denominator * nearest_depth.denominator)
            << what << " at " << x << " " << y << ": " << seen << " hides " << nearest->number;
      }
    }
  }

 private:
  std::vector<PluginPolygon> polygons_;
  std::vector<Shown> shown_;
};

}  // namespace farop::test
