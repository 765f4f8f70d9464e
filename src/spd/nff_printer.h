// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "scene/surface.h"
#include "scene/tessellate.h"
#include "spd/spd.h"

namespace farop {

/// How a scene is to be printed.
struct SceneForm {
  int size = 1;
  bool tessellate = false;  ///< spheres and cones as `pp` triangles
  int resolution = k_spd_default_resolution;
};

/// The `v` block. Angle in degrees.
struct PrintedView {
  V3d from, at, up;
  double angle = 45;
  double hither = 1;
  int columns = 512, rows = 512;
};

/// The line "x y z" of a corner, kept where several polygons share it: making digits is what printing costs.
class CornerLine {
 public:
  explicit CornerLine(const V3d& position);
  std::string_view text() const { return {chars_.data(), size_}; }

 private:
  std::array<char, 48> chars_;  ///< three numbers of at most 13 characters, separators, line end
  std::size_t size_ = 0;
};

/// Prints NFF entities in the layout of the SPD programs: numbers as C's %g (six significant digits), one
/// entity a line but for polygons, LF line ends. Collects text and hands it over in blocks of whole entities.
class NffPrinter {
 public:
  /// `total_objects` is what progress is measured against. The functions must outlive the printer.
  NffPrinter(const SceneForm& form, std::uint64_t total_objects, const TextFunction& out,
             const ProgressFunction& progress);

  void background(const Rgb& color);
  void view(const PrintedView& view);
  void light(const V3d& position);
  void fill(const Material& material);
  /// As `s`, or as triangles in the tessellated form.
  void sphere(const Sphere& sphere);
  /// As `c`, or as triangles in the tessellated form.
  void cone(const Cone& cone);
  /// Corners closer than 1e-6 to their successor are left out; fewer than three left: nothing is printed.
  void polygon(std::span<const V3d> corners);
  void patch(const TessellationCorner (&triangle)[3]);

  /// A polygon of ready lines, no corner checked: begin_polygon(n), n times corner(), end_polygon().
  void begin_polygon(std::size_t corners);
  void corner(const CornerLine& line) { text_.append(line.text()); }
  void end_polygon() { end_object(); }
  void triangle(const CornerLine& a, const CornerLine& b, const CornerLine& c);

  /// Hands over what is left.
  void finish();

 private:
  /// "keyword number number ...", or the numbers alone without a keyword.
  void line(std::string_view keyword, std::initializer_list<double> values);
  void end_object();

  const SceneForm form_;
  const std::uint64_t total_objects_;
  const TextFunction& out_;
  const ProgressFunction& progress_;
  std::uint64_t objects_ = 0;
  std::string text_;
};

}  // namespace farop
