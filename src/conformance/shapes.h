// SPDX-License-Identifier: GPL-3.0-or-later
// Lattice polygons and tilings that the corpus is made of, built with exact integer predicates.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "conformance/drawing.h"
#include "conformance/random.h"

namespace farop::conformance {

struct Point {
  int x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};
using Points = std::vector<Point>;

/// Corners at depth 0, black.
TestPolygon polygon_of(const Points& points);
TestPolygon rectangle(int x0, int y0, int x1, int y1);
TestPolygon moved(TestPolygon polygon, int dx, int dy);
/// Cyclic shift: corner `first` comes first.
TestPolygon starting_at(TestPolygon polygon, std::size_t first);
TestPolygon reversed(TestPolygon polygon);
/// Counter-clockwise.
TestPolygon turned_left(TestPolygon polygon);

/// (b - a) x (c - a): > 0 when a, b, c turn left.
std::int64_t turn(const Point& a, const Point& b, const Point& c);
/// True when the closed segments have a point in common.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d);
/// True for a ring whose edges meet at common corners only, with no corner repeated or straight back.
bool is_simple(const Points& ring);

/// Teeth of one column with gaps of one column, `teeth` downwards and as many upwards, 5 rows in all: 8
/// corners and 4 edges across a row for 2 columns, and not much else to do.
Points double_comb(int teeth);

/// A simple polygon with up to `corners` corners, 0 <= x < width, 0 <= y < height: random points, then
/// crossing edges are exchanged until none is left. May be concave or convex; counter-clockwise.
Points random_simple_polygon(Random& random, int corners, int width, int height);

/// Triangles (three indices each) of a simple, counter-clockwise polygon, by cutting ears.
std::vector<std::array<int, 3>> triangulated(const Points& ring);

/// Triangles that tile the rectangle (0,0)-(width-1,height-1), over `points` random inner lattice points and
/// some on the border. None is without area.
std::vector<TestPolygon> random_mesh(Random& random, int points, int width, int height);

}  // namespace farop::conformance
