// SPDX-License-Identifier: GPL-3.0-or-later
// A scan-line rasterizer as lectures teach it: edge table, active edge table, Gouraud shading, depth buffer;
// all in whole numbers. Compiled with -DMUTANT=n it has exactly one fault, the n-th of manifest.tsv; without,
// none.
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "entry.h"
#include "fill_rule.h"

namespace {

class Scanline {
 public:
  void begin(const farop_frame& frame) {
    if (frame.width != width_ || frame.height != height_) edges_.clear();
    width_ = frame.width, height_ = frame.height;
    canvas_.begin(frame);
    stored_.clear();
  }
  void polygon(const farop_polygon& polygon);
  void end();

 private:
  using Corners = std::vector<farop_vertex>;

  Corners corners_of(const farop_polygon& polygon) const;
  void draw(const Corners& corners);
  void fill_edge_table(const Corners& corners);
  void add_edge(const Corners& corners, std::size_t from, std::size_t to);
  void sort_edge_table();
  void enter_and_leave(int row);
  void keep_places(int row);
  void sort_active(int row);
  void fill_row(int row);
  void fill_span(int row, const Crossing& left, const Crossing& right);
  void paint(int row, Columns columns, Shade shade);
  std::size_t pixels_of();
  void outline(const Corners& corners);
  void add_minima(const Corners& corners);

  Canvas canvas_;
  int width_ = 0, height_ = 0;
  std::vector<Edge> edges_;          ///< the edge table: by first_row
  std::size_t entered_ = 0;          ///< edges of the table that have become active
  std::vector<const Edge*> active_;  ///< the active edge table: by x on the current row
  farop_vertex first_corner_{};
  std::vector<Corners> stored_;  ///< 53
};

// ---- polygons
// -------------------------------------------------------------------------------------------------------

void Scanline::polygon(const farop_polygon& polygon) {
  canvas_.begin_polygon();
  const Corners corners = corners_of(polygon);
  if constexpr (k_mutant == 53) {
    stored_.push_back(corners);
    return;
  }
  // 65: the table is emptied between two polygons, but not before the first one of a frame.
  if (k_mutant != 65 || polygon.index != 0) edges_.clear();
  draw(corners);
}

void Scanline::end() {
  if constexpr (k_mutant == 53) {
    // 53: painter's algorithm, far to near by the mean depth of a polygon. No order is right for polygons in
    // a ring.
    const auto mean = [](const Corners& corners) {
      double sum = 0;
      for (const farop_vertex& v : corners) sum += v.z;
      return sum / static_cast<double>(corners.size());
    };
    std::stable_sort(stored_.begin(), stored_.end(),
                     [&](const Corners& a, const Corners& b) { return mean(a) > mean(b); });
    for (const Corners& corners : stored_) {
      edges_.clear();
      draw(corners);
    }
  }
}

Scanline::Corners Scanline::corners_of(const farop_polygon& polygon) const {
  const farop_vertex* const v = polygon.vertices;
  if constexpr (k_mutant == 34) {
    // 34: "no polygon has more than 64 corners".
    farop_vertex copy[64];
    for (std::uint32_t i = 0; i < polygon.vertex_count; ++i) copy[i] = v[i];
    return Corners(copy, copy + std::min(polygon.vertex_count, 64u));
  }
  Corners corners(v, v + polygon.vertex_count);
  if constexpr (k_mutant == 29) {
    // 29: takes a corner that is there twice for the end of the list.
    const auto same = [](const farop_vertex& a, const farop_vertex& b) { return a.x == b.x && a.y == b.y; };
    corners.erase(std::adjacent_find(corners.begin(), corners.end(), same), corners.end());
  }
  return corners;
}

void Scanline::draw(const Corners& corners) {
  if (corners.empty()) return;
  first_corner_ = corners[0];
  if constexpr (k_mutant == 12) return outline(corners);
  fill_edge_table(corners);
  // 31: drops what is "too small to be seen".
  if (k_mutant == 31 && pixels_of() < 2) return;

  entered_ = 0;
  active_.clear();
  int row = edges_.empty() ? 0 : edges_[0].first_row;
  for (; entered_ < edges_.size() || !active_.empty(); ++row) {
    enter_and_leave(row);
    fill_row(row);
  }
  if constexpr (k_mutant == 13) add_minima(corners);
}

// ---- edge table
// -----------------------------------------------------------------------------------------------------

void Scanline::fill_edge_table(const Corners& corners) {
  // 28: for (i = 0; i + 1 < n; ++i), and the edge from the last corner to the first is never there.
  const std::size_t end = corners.size() - (k_mutant == 28 ? 1 : 0);
  for (std::size_t i = 0; i < end; ++i) add_edge(corners, i, (i + 1) % corners.size());
  sort_edge_table();
}

// 22: dx / dy in integers, before anybody asks whether dy is 0. (volatile: a compiler may do what it likes
// with a division by zero that it sees coming.)
int slope_in_sixteenths(const farop_vertex& a, const farop_vertex& b) {
  const volatile int dy = b.y - a.y;
  return 16 * (b.x - a.x) / dy;
}

void Scanline::add_edge(const Corners& corners, std::size_t from, std::size_t to) {
  const farop_vertex &a = corners[from], &b = corners[to];
  if (k_mutant == 22 && slope_in_sixteenths(a, b) == INT32_MIN) return;
  if (a.y == b.y) {
    // 21: horizontal edges enter the table, "with slope 0", for the one row that they lie on.
    if (k_mutant == 21) edges_.push_back({a, {a.x, a.y + 1, a.z, a.r, a.g, a.b, 0}, a.y, a.y + 1});
    return;
  }
  const bool goes_up = a.y < b.y;
  Edge edge{goes_up ? a : b, goes_up ? b : a, 0, 0};
  const Rows rows = rows_of(edge.low.y, edge.high.y);
  edge.first_row = rows.first, edge.end_row = rows.end;
  // Where the outline goes on from the edge's upper end: what passes through the row there is counted once,
  // by the edge above, and what only touches the row from below is not counted.
  const std::size_t n = corners.size();
  const farop_vertex& beyond = goes_up ? corners[(to + 1) % n] : corners[(from + n - 1) % n];
  // 23: the edge below is counted as well.
  if (k_mutant == 23 && beyond.y > edge.high.y) edge.end_row = edge.high.y + 1;
  // 24: one of the two edges that end in a local maximum is counted.
  if (k_mutant == 24 && beyond.y < edge.high.y && goes_up) edge.end_row = edge.high.y + 1;
  if (edge.first_row >= edge.end_row) return;
  if constexpr (k_mutant == 30) {
    // 30: an edge that is in the table already (a bridge is walked twice) is not entered again; it should
    // have gone, too.
    const auto same = [](const farop_vertex& p, const farop_vertex& q) { return p.x == q.x && p.y == q.y; };
    for (const Edge& e : edges_) {
      if (same(e.low, edge.low) && same(e.high, edge.high)) return;
    }
  }
  edges_.push_back(edge);
}

void Scanline::sort_edge_table() {
  const auto begins_lower = [](const Edge& a, const Edge& b) { return a.first_row < b.first_row; };
  if constexpr (k_mutant == 67) {
    // 67: each edge looks for its place from the front of the table.
    for (std::size_t i = 1; i < edges_.size(); ++i) {
      std::size_t place = 0;
      while (place < i && !begins_lower(edges_[i], edges_[place])) ++place;
      std::rotate(edges_.begin() + place, edges_.begin() + i, edges_.begin() + i + 1);
    }
    return;
  }
  std::stable_sort(edges_.begin(), edges_.end(), begins_lower);
}

// ---- active edges
// ---------------------------------------------------------------------------------------------------

void Scanline::enter_and_leave(int row) {
  if constexpr (k_mutant == 25) return keep_places(row);
  const auto ended = [&](const Edge* e) { return e->end_row <= row; };
  active_.erase(std::remove_if(active_.begin(), active_.end(), ended), active_.end());
  for (; entered_ < edges_.size() && edges_[entered_].first_row <= row; ++entered_) {
    active_.push_back(&edges_[entered_]);
  }
  sort_active(row);
}

bool is_left_of(const Edge* a, const Edge* b, int row) {
  const Crossing p = cross(*a, row), q = cross(*b, row);
  if (p.x * q.dy != q.x * p.dy) return p.x * q.dy < q.x * p.dy;
  return std::int64_t{a->dx()} * b->dy() < std::int64_t{b->dx()} * a->dy();
}

void Scanline::sort_active(int row) {
  const auto less = [&](const Edge* a, const Edge* b) { return is_left_of(a, b, row); };
  if (!std::is_sorted(active_.begin(), active_.end(), less)) std::sort(active_.begin(), active_.end(), less);
}

// 25: an edge takes the place of the one it goes on from, new pairs go to the end, and nothing is ever
// sorted: enough for what is convex.
void Scanline::keep_places(int row) {
  std::vector<const Edge*> begun;
  for (; entered_ < edges_.size() && edges_[entered_].first_row <= row; ++entered_) {
    begun.push_back(&edges_[entered_]);
  }
  std::stable_sort(begun.begin(), begun.end(),
                   [&](const Edge* a, const Edge* b) { return is_left_of(a, b, row); });
  for (const Edge*& place : active_) {
    if (place->end_row > row) continue;
    const auto follows = [&](const Edge* e) {
      return e->low.x == place->high.x && e->low.y == place->high.y;
    };
    const auto next = std::find_if(begun.begin(), begun.end(), follows);
    place = next == begun.end() ? nullptr : *next;
    if (next != begun.end()) begun.erase(next);
  }
  active_.erase(std::remove(active_.begin(), active_.end(), nullptr), active_.end());
  active_.insert(active_.end(), begun.begin(), begun.end());
}

// ---- spans
// ----------------------------------------------------------------------------------------------------------

/// 32: the crossing of an edge in float, with a slope cut to sixteenths and added row by row.
Crossing accumulated(const Edge& edge, int row) {
  const float step = static_cast<float>(16 * edge.dx() / edge.dy()) / 16;
  float x = static_cast<float>(edge.low.x);
  for (int y = edge.low.y; y < row; ++y) x += step;
  Crossing c = cross(edge, row);
  c.x = static_cast<std::int64_t>(x * 16) * c.dy;
  c.dy *= 16;
  for (std::int64_t& value : c.value) value *= 16;
  return c;
}

void Scanline::fill_row(int row) {
  const auto at = [&](std::size_t k) {
    return k_mutant == 32 ? accumulated(*active_[k], row) : cross(*active_[k], row);
  };
  if constexpr (k_mutant == 26) {
    // 26: from the first crossing to the last.
    if (!active_.empty()) fill_span(row, at(0), at(active_.size() - 1));
    return;
  }
  for (std::size_t k = 0; k + 1 < active_.size(); k += 2) fill_span(row, at(k), at(k + 1));
  if (active_.size() % 2 == 1 && (k_mutant == 23 || k_mutant == 24 || k_mutant == 30)) {
    // Their parity is wrong, and "inside" lasts to the end of the row.
    const Crossing left = at(active_.size() - 1);
    Crossing border = left;
    border.x = std::int64_t{canvas_.width()} * border.dy;
    fill_span(row, left, border);
  }
}

void Scanline::fill_span(int row, const Crossing& left, const Crossing& right) {
  const Columns columns = columns_between(left, right);
  if (columns.first >= columns.end) return;
  paint(row, columns, Shade(left, right, first_corner_, columns.first));
}

void Scanline::paint(int row, Columns columns, Shade shade) {
  if constexpr (k_mutant == 52) {
    // 52: the depth test sees to the depths, but colours are copied for the whole span as soon as one pixel
    // shows.
    Shade again = shade;
    bool any = false;
    for (int x = columns.first; x < columns.end; ++x, again.next())
      any = canvas_.put(x, row, again.z(), again.color()) || any;
    for (int x = columns.first; any && x < columns.end; ++x, shade.next())
      canvas_.set_color(x, row, shade.color());
    return;
  }
  for (int x = columns.first; x < columns.end; ++x) {
    const bool visible = canvas_.put(x, row, shade.z(), shade.color());
    // 63: steps the colours with the pixel it writes.
    if constexpr (k_mutant == 63) {
      visible ? shade.next() : shade.next_z();
      continue;
    }
    shade.next();
  }
}

/// 31
std::size_t Scanline::pixels_of() {
  std::size_t pixels = 0;
  entered_ = 0;
  active_.clear();
  int row = edges_.empty() ? 0 : edges_[0].first_row;
  for (; entered_ < edges_.size() || !active_.empty(); ++row) {
    enter_and_leave(row);
    for (std::size_t k = 0; k + 1 < active_.size(); k += 2) {
      const Columns columns = columns_between(cross(*active_[k], row), cross(*active_[k + 1], row));
      pixels += static_cast<std::size_t>(std::max(0, columns.end - columns.first));
    }
  }
  return pixels;
}

// ---- other fills
// ----------------------------------------------------------------------------------------------------

// 12: draws the edges with Bresenham's algorithm and fills each row from the outermost pixel to the outermost
// pixel.
void Scanline::outline(const Corners& corners) {
  struct Ends {
    Crossing left, right;
  };
  std::vector<Ends> rows(static_cast<std::size_t>(height_), {{INT32_MAX, 1, {}}, {INT32_MIN, 1, {}}});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const farop_vertex &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const int steps = std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1});
    for (int k = 0; k <= steps; ++k) {
      const auto between = [&](Int128 from, Int128 to) {
        return floor_div(2 * (from * steps + k * (to - from)) + steps, 2 * steps);
      };
      Crossing c{between(a.x, b.x), 1, {}};
      for (int v = 0; v < k_attributes; ++v) c.value[v] = between(attribute_of(a, v), attribute_of(b, v));
      Ends& ends = rows[static_cast<std::size_t>(between(a.y, b.y))];
      if (c.x < ends.left.x) ends.left = c;
      if (c.x > ends.right.x) ends.right = c;
    }
  }
  for (int y = 0; y < height_; ++y) {
    const auto& [left, right] = rows[static_cast<std::size_t>(y)];
    if (left.x > right.x) continue;
    const Columns columns{static_cast<int>(left.x), static_cast<int>(right.x) + 1};
    paint(y, columns, Shade(left, right, first_corner_, columns.first));
  }
}

// 13 lb+min: the lecture's "a local minimum is drawn".
void Scanline::add_minima(const Corners& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const farop_vertex& v = corners[i];
    if (corners[(i + n - 1) % n].y <= v.y || corners[(i + 1) % n].y <= v.y) continue;
    canvas_.put(v.x, v.y, v.z, {v.r, v.g, v.b});
  }
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host*) {
  return Entry<Scanline>::table("scan lines, edge table and depth buffer, for testing the tests", 0);
}
