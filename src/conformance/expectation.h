// SPDX-License-Identifier: GPL-3.0-or-later
// What a drawing has to look like: at every sample who may be seen, and with which values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "conformance/attribute.h"
#include "conformance/coverage.h"
#include "conformance/drawing.h"
#include "conformance/fill_rules.h"

namespace farop::conformance {

/// One polygon, with all that is exact about it.
struct ExactPolygon {
  std::span<const ScreenVertex> corners;
  Bitmap masks;                                ///< of coverage_masks(), over the bounding box
  std::array<std::optional<Plane>, 4> planes;  ///< by Attribute; nothing where the corners are on no plane
  std::array<Tolerance, 4> tolerances;
  std::array<std::pair<std::int64_t, std::int64_t>, 4> ranges;  ///< of the corners' values

  const std::optional<Plane>& plane(Attribute a) const { return planes[static_cast<std::size_t>(a)]; }
  const Tolerance& tolerance(Attribute a) const { return tolerances[static_cast<std::size_t>(a)]; }
  const std::pair<std::int64_t, std::int64_t>& range(Attribute a) const {
    return ranges[static_cast<std::size_t>(a)];
  }
};

/// Coverage under one consistent rule, visibility from exact depths. The drawing must outlive it.
class Expectation {
 public:
  Expectation(const Drawing& drawing, ConsistentRule rule);

  const Drawing& drawing() const { return *drawing_; }
  const std::vector<ExactPolygon>& polygons() const { return polygons_; }
  /// Numbers of the polygons that cover a sample, in drawing order.
  std::span<const std::uint32_t> covering(int x, int y) const;
  /// Those that may be seen: none of the others is forced in front of them.
  std::vector<std::uint32_t> admissible(int x, int y) const;
  /// True where some polygon's edge passes exactly through the sample: other rules may see others there.
  bool on_boundary(int x, int y) const { return boundary_.get(x, y) != 0; }
  /// Polygon that is exactly nearest (of equals the first drawn), -1 for none.
  int nearest(int x, int y) const;
  /// Counts samples as boundary, too, where `rule` covers other samples of some polygon than lb does.
  void add_boundary_of(FillRule rule);

 private:
  const Drawing* drawing_;
  std::vector<ExactPolygon> polygons_;
  std::vector<std::uint32_t> first_, members_;  ///< members of sample i: first_[i] .. first_[i + 1]
  Bitmap boundary_;
};

}  // namespace farop::conformance
