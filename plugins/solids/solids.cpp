// SPDX-License-Identifier: GPL-3.0-or-later
// solids - a spanning scan-line algorithm, and what it gains from knowing that it draws solids.
//
// The algorithm of M. Lenz Cesar and M. C. Ferreira de Oliveira (ICMSC-USP), "Um algoritmo scan-line para
// sólidos", 1995, which builds on J. D. Foley et al., Computer Graphics: Principles and Practice, 2nd ed.,
// Addison-Wesley 1990, section 15.6. The option `variant` chooses what the paper's table compares:
//
//   1  Any polygons. Every one brings its own edges. A line is cut into spans where a segment ends and where
//      two segments cross; in every span with several polygons their depths are compared (first of the whole
//      polygons, the "minimax test" of M. E. Newell, R. G. Newell and T. L. Sancha, 1972; then at pixels).
//   2  Solids. Every edge is entered once, with the two polygons that share it: half the edge table. Where
//      the visible polygon ends on such an edge its neighbour goes on, and a hidden one is followed by a
//      hidden one: no depths are compared. Faces of a solid do not cross: spans are cut at end points only.
//   3  As 2, and the back faces of solids never enter the tables. (The default. FAROP itself drops back faces
//      unless it is run with --two-sided; then only do 2 and 3 differ.)
//
// All three run through the same loops below, and draw the same picture.
//
// What is a solid: a surface whose edges all lie between two faces that run along it in opposite directions.
// It is told from the vertex ids. Everything else (open surfaces, surfaces cut open by the window, flat
// files, which have no ids) is drawn as 1 does, and so is every span in which more than one solid, or a solid
// and something else, lie behind each other. That a closed surface does not cut through itself is taken on
// trust: `farop table solids` proves it first.
//
//   edge table:    a bucket for every line, with the edges that begin there, from left to right
//   active edges:  the edges that cross the current line, from left to right
//   polygon table: the polygons, with a flag that says whether the line is inside
//
// Only whole numbers are used from edge to edge, span to span and pixel to pixel; the slope of a segment,
// once a line and only when it is asked for, is computed in floating point.
//
// The option statistics=1 logs a line at the end of every frame:
//   edge_table         edges entered
//   active_edges_max   on the line that has most, and
//   active_edges_sum   on all lines together
//   spans              pieces that lines were cut into (after what hides what was decided, neighbouring
//   pieces
//                      of one polygon are joined)
//   depth_comparisons  of two polygons, at one pixel or of all depths that they have
//   pixels             drawn
//   build_seconds      finding solids and neighbours, making and sorting the edge table
//   scan_seconds       active edges, spans and what is visible in them
//   pixel_seconds      writing the pixels. It is a pass of its own, so measuring it costs the others nothing.
// Storing the polygons as they come is in none of the times, nor is clearing the frame, which FAROP does.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "farop/rasterizer.h"

namespace {

/// What ends a call with a status of its own.
struct Refusal : std::runtime_error {
  Refusal(farop_status the_status, const char* why) : std::runtime_error(why), status(the_status) {}
  farop_status status;
};

constexpr std::uint32_t k_none = 0xFFFFFFFFu;

/// An edge that is not horizontal, and the two polygons it belongs to (or one, and k_none). It crosses the
/// current line at x = column - excess / denominator, 0 <= excess < denominator, so `column` is the first
/// pixel that is not left of it. Frames have at most 32767 pixels a side and 8 sub-pixel bits: the
/// denominator stays below 2^31.
struct Edge {
  std::int32_t column = 0, excess = 0, denominator = 1;
  std::int32_t step = 0, excess_step = 0;  ///< a line up, x grows by step + excess_step / denominator
  std::int32_t end_line = 0;               ///< the first line above it
  std::uint32_t polygon[2] = {k_none, k_none};
  std::uint32_t ends = 0;  ///< into the list of all ends

  void step_up() {
    excess -= excess_step;
    const std::int32_t carry = excess >> 31;  // -1 below zero, else 0: no branch, it could not be foretold
    excess += carry & denominator;
    column += step - carry;
  }
};

/// Of an edge, in the list of all corners. Not in the Edge itself, which is copied a lot.
struct EdgeEnds {
  std::uint32_t low = 0, high = 0;
  std::int32_t low_y = 0;
  double per_denominator = 1;      ///< 1 / Edge::denominator
  double low_z = 0, z_change = 0;  ///< up to the other end
};

/// From left to right.
bool before(const Edge& a, const Edge& b) {
  if (a.column != b.column) return a.column < b.column;
  return std::int64_t{a.excess} * b.denominator > std::int64_t{b.excess} * a.denominator;
}

/// Depths are compared in units of 1/256: fine enough to decide what whole numbers leave open, and coarse
/// enough that the last bits of the arithmetic do not. Which of equals is in front: see Solids::in_front().
constexpr int k_depth_bits = 28;  ///< fraction of Polygon::z and z_step: 2^30 depths fit, and their slopes
constexpr int k_compare_bits = 8;
constexpr int k_color_bits = 22;  ///< fraction of colours: 255 fits 32 bits, 32767 steps lose 1/100

/// One in a cache line: the sweep goes from one to another all the time.
struct alignas(64) Polygon {
  std::uint32_t first_corner = 0, corner_count = 0;
  std::uint32_t surface = 0;
  bool back_facing = false, one_color = false;
  bool in_surface = false;                 ///< a flat file has no surfaces
  std::int32_t nearest = 0, farthest = 0;  ///< depth of its corners
  // Of the current line:
  bool in = false;                 ///< the sweep is inside
  bool slope_known = false;        ///< z, z_step
  std::uint32_t place = 0;         ///< in the list of those that are in
  std::uint32_t candidate_at = 0;  ///< column number, see Solids::candidates_
  std::uint32_t left = 0;   ///< crossing at which it was entered: 2 k + side, active edge k has it there
  std::uint32_t right = 0;  ///< active edge at which it is left; 0: nobody has asked
  std::int32_t column = 0;  ///< there
  std::int64_t z = 0, z_step = 0;  ///< depth at `column`, from pixel to pixel
};

struct Surface {
  std::uint64_t balance = 0;  ///< see find_solids()
  bool solid = true;
  std::uint32_t in = 0;  ///< how many of its polygons the sweep is inside of
};

/// Pixels first .. end - 1 of a line.
struct Span {
  std::int32_t first = 0, end = 0;
  std::uint32_t polygon = 0;
  std::uint32_t ramp = k_none;  ///< into the list of ramps, unless the polygon has one colour
};

/// R, G, B at the first pixel of a span, and from pixel to pixel. Unsigned: past the last pixel they may
/// wrap.
struct Ramp {
  std::uint32_t color[3], step[3];
};

/// Four pixels of one colour, as they stand in the frame: what fill() copies.
using FourPixels = std::array<std::uint8_t, 12>;

FourPixels four_of(const farop_vertex& v) {
  return {v.r, v.g, v.b, v.r, v.g, v.b, v.r, v.g, v.b, v.r, v.g, v.b};
}

/// A number that depends on all bits of two ids. (The finisher of S. Vigna's SplitMix64.)
std::uint64_t mixed(std::uint32_t a, std::uint32_t b) {
  std::uint64_t h = (std::uint64_t{a} << 32 | b) + 0x9E3779B97F4A7C15u;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBu;
  return h ^ (h >> 31);
}

/// Twice the signed area of a triangle.
std::int64_t turn(const farop_vertex& a, const farop_vertex& b, const farop_vertex& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

struct Statistics {
  std::uint64_t active_edges_max = 0, active_edges_sum = 0, spans = 0, depth_comparisons = 0, pixels = 0;
};

class Solids {
 public:
  Solids(const farop_host* host, int variant, bool log_statistics)
      : host_(host), variant_(variant), log_statistics_(log_statistics) {}

  void begin(const farop_frame& frame);
  void store(const farop_polygon& polygon);
  void draw();
  const farop_host* host() const { return host_; }

 private:
  /// Of a polygon's segment on the current line: see ends().
  struct Ends {
    double left = 0, right = 0, to_first = 0, width = 1;
    std::int32_t pixels = 0;
  };

  // the tables
  std::uint32_t number_of_surface(std::uint32_t object_id, std::uint32_t surface_id);
  void find_solids();
  void build_edge_table();
  bool is_back_face(const Polygon& polygon);
  int back_face_sign();
  std::int64_t twice_area(const Polygon& polygon) const;
  std::int64_t outline_length(const Polygon& polygon) const;  ///< |dx| + |dy| of all edges
  void enter_polygon(std::uint32_t polygon);
  bool enter_second_polygon(std::uint32_t low, std::uint32_t high, std::uint32_t polygon, bool on_its_left);
  void enter_edge(std::uint32_t low, std::uint32_t high, std::int32_t first_line, std::int32_t end_line,
                  std::uint32_t polygon);
  void sort_into_buckets();

  // a line (what runs once a crossing is defined inline)
  void next_active_edges();
  void sweep();
  void cross(std::uint32_t active);
  void enter(std::uint32_t polygon, std::uint32_t crossing);
  void leave(std::uint32_t polygon);
  void replace(std::uint32_t from, std::uint32_t to, std::uint32_t crossing);
  void make_candidate(std::uint32_t polygon);
  bool must_be_careful() const;
  void emit_trusting(std::int32_t column, std::int32_t end);
  void emit_careful(const std::vector<std::uint32_t>& polygons, std::int32_t column, std::int32_t end);
  bool nearest_among(const std::vector<std::uint32_t>& polygons, std::int32_t column);
  void emit(std::int32_t column, std::int32_t end);

  // depths and colours on it
  const Edge& right_edge(Polygon& polygon);
  template <class At>
  Ends ends(Polygon& polygon, const At& at);
  bool is_all_behind(std::uint32_t a, std::uint32_t b) const;
  std::int64_t depth(std::uint32_t polygon, std::int32_t column);
  void find_slope(Polygon& polygon);
  bool in_front(std::uint32_t a, std::int64_t depth_a, std::uint32_t b, std::int64_t depth_b);
  std::int32_t comes_through(std::uint32_t a, std::uint32_t b, std::int32_t column, std::int32_t end);
  std::uint32_t make_ramp(Polygon& polygon, std::int32_t column);

  void write_pixels();
  void report(double build, double scan, double pixel) const;

  const farop_host* host_;
  int variant_;
  bool log_statistics_;
  Statistics count_;

  const farop_frame* frame_ = nullptr;
  std::vector<farop_vertex> corners_;
  std::vector<std::uint32_t> ids_;  ///< of the corners
  std::vector<Polygon> polygons_;
  std::vector<FourPixels> colors_;  ///< of the polygons, at their first corner
  std::vector<Surface> surfaces_;
  std::unordered_map<std::uint64_t, std::uint32_t> surface_number_;  ///< both ids -> into surfaces_
  std::uint64_t last_surface_ = 0;
  std::uint32_t last_surface_number_ = 0;
  int back_face_sign_ = 0;  ///< 0: not asked for yet
  bool several_ = false;    ///< variants 2 and 3 draw anything but one solid

  std::vector<Edge> edge_table_, sorted_;  ///< by bucket once sorted
  std::vector<EdgeEnds> edge_ends_;
  std::vector<std::int32_t> first_line_;  ///< of the edges, before they are sorted
  std::vector<std::uint32_t> bucket_;     ///< line -> its first edge
  std::vector<std::uint32_t> slots_;      ///< hash table: ids and surface -> edge, or k_none

  // The current line.
  std::int32_t line_ = 0;
  std::vector<Edge> active_;
  std::vector<std::uint32_t> in_;          ///< polygons whose flag is set
  std::vector<std::uint32_t> candidates_;  ///< entered at this column: may be in front of what was visible
  std::uint32_t visible_ = k_none;
  std::uint32_t column_number_ = 0;  ///< counts the columns of the frame at which edges cross
  std::uint32_t solids_in_ = 0, others_in_ = 0;

  std::vector<Span> spans_;
  std::vector<std::size_t> line_end_;  ///< line -> end of its spans
  std::vector<Ramp> ramps_;
  std::size_t line_begin_ = 0;        ///< of the current line, in spans_
  std::uint32_t last_left_ = k_none;  ///< crossing at which the polygon of the last span was entered
};

// ---- storing ------------------------------------------------------------------------------------

void Solids::begin(const farop_frame& frame) {
  frame_ = &frame;
  corners_.clear();
  ids_.clear();
  polygons_.clear();
  colors_.clear();
  surfaces_.clear();
  surface_number_.clear();
}

void Solids::store(const farop_polygon& polygon) {
  const std::int32_t right = (frame_->width - 1) << frame_->subpixel_bits;
  const std::int32_t top = (frame_->height - 1) << frame_->subpixel_bits;
  const farop_vertex* const v = polygon.vertices;
  const std::uint32_t count = polygon.vertex_count;
  std::int32_t nearest = v[0].z, farthest = v[0].z;
  int other_colors = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (v[i].x < 0 || v[i].x > right || v[i].y < 0 || v[i].y > top) {
      throw Refusal(FAROP_E_INVALID, "solids: a corner outside the frame");
    }
    other_colors |= (v[i].r ^ v[0].r) | (v[i].g ^ v[0].g) | (v[i].b ^ v[0].b);
    nearest = std::min(nearest, v[i].z), farthest = std::max(farthest, v[i].z);
  }
  const auto first_corner = static_cast<std::uint32_t>(corners_.size());
  corners_.insert(corners_.end(), v, v + count);
  if (variant_ >= 2) {
    if (polygon.vertex_ids != nullptr) {
      ids_.insert(ids_.end(), polygon.vertex_ids, polygon.vertex_ids + count);
    } else {
      ids_.resize(corners_.size(), FAROP_NO_VERTEX_ID);
    }
  }
  colors_.push_back(four_of(v[0]));
  const std::uint32_t surface = number_of_surface(polygon.object_id, polygon.surface_id);
  Polygon& stored = polygons_.emplace_back();
  stored.first_corner = first_corner, stored.corner_count = count;
  stored.surface = surface, stored.in_surface = polygon.surface_id != 0;
  stored.back_facing = (polygon.flags & FAROP_POLYGON_BACK_FACING) != 0;
  stored.one_color = other_colors == 0;
  stored.nearest = nearest, stored.farthest = farthest;
}

// Polygons of a surface mostly come one after the other.
std::uint32_t Solids::number_of_surface(std::uint32_t object_id, std::uint32_t surface_id) {
  const std::uint64_t key = std::uint64_t{object_id} << 32 | surface_id;
  if (!surfaces_.empty() && key == last_surface_) return last_surface_number_;
  const auto found = surface_number_.try_emplace(key, static_cast<std::uint32_t>(surfaces_.size()));
  if (found.second) surfaces_.emplace_back();
  last_surface_ = key, last_surface_number_ = found.first->second;
  return last_surface_number_;
}

// ---- building the tables ------------------------------------------------------------------------

// A surface is closed and turns the same way everywhere if every edge is walked once in each direction. To
// see that, edges need not be found again: give each a random number, add it where the edge is walked from
// the smaller id to the larger one and subtract it where it is walked back. Then the sum is zero; for all
// other surfaces it is zero with a chance of 2^-64. (An edge that four faces share is found later, as the
// third polygon comes to it.)
void Solids::find_solids() {
  for (const Polygon& polygon : polygons_) {
    Surface& surface = surfaces_[polygon.surface];
    const std::uint32_t* const ids = &ids_[polygon.first_corner];
    std::uint32_t from = ids[polygon.corner_count - 1];
    for (std::uint32_t i = 0; i < polygon.corner_count; ++i) {
      const std::uint32_t to = ids[i];
      if (to == FAROP_NO_VERTEX_ID) surface.solid = false;
      // Without branches, which way an edge runs could not be foretold: h, -h or, from a corner to itself, 0.
      const std::uint64_t h = from == to ? 0 : mixed(std::min(from, to), std::max(from, to));
      const std::uint64_t backwards = from > to ? ~std::uint64_t{0} : 0;
      surface.balance += (h ^ backwards) - backwards;
      from = to;
    }
  }
  for (Surface& surface : surfaces_) surface.solid = surface.solid && surface.balance == 0;
}

void Solids::build_edge_table() {
  edge_table_.clear(), edge_ends_.clear();
  first_line_.clear();
  back_face_sign_ = 0;
  if (variant_ >= 2) {
    find_solids();
    std::size_t slots = 16;
    while (slots < corners_.size()) slots *= 2;  // edges are half as many: at most half full
    slots_.assign(slots, k_none);
  }
  for (std::uint32_t p = 0; p < polygons_.size(); ++p) {
    if (variant_ == 3 && surfaces_[polygons_[p].surface].solid && is_back_face(polygons_[p])) continue;
    enter_polygon(p);
  }
  several_ = variant_ >= 2 && !(surfaces_.size() == 1 && surfaces_[0].solid);
  sort_into_buckets();
}

// A back face, but for the few that rounding to pixels has turned over: on the screen these are front faces,
// and where they stand on the outline of a solid there is no other. A quadrangle may have turned over in
// part: then it crosses itself, and its corners turn both ways.
bool Solids::is_back_face(const Polygon& polygon) {
  if (!polygon.back_facing) return false;
  const int sign = back_face_sign();
  const farop_vertex* const v = &corners_[polygon.first_corner];
  const std::uint32_t count = polygon.corner_count;
  if (count == 3) return sign * turn(v[0], v[1], v[2]) >= 0;
  if (count == 4) {
    // Both diagonals cut it into two triangles: the four ways that its corners turn.
    const std::int64_t at_1 = sign * turn(v[0], v[1], v[2]), at_3 = sign * turn(v[0], v[2], v[3]);
    const std::int64_t at_2 = sign * turn(v[1], v[2], v[3]), at_0 = at_1 + at_3 - at_2;
    return at_1 + at_3 > 0 && std::min({at_0, at_1, at_2, at_3}) >= 0;
  }
  const std::int64_t area = sign * twice_area(polygon);
  if (area <= 0) return false;
  bool both_ways = false;
  for (std::uint32_t i = 0, last = count - 1, before_last = count - 2; i < count;
       before_last = last, last = i++) {
    both_ways = both_ways || sign * turn(v[before_last], v[last], v[i]) < 0;
  }
  // Polygons of more corners may well be concave; rounding can turn over thin ones only.
  return !(both_ways && area <= outline_length(polygon));
}

// Which way round back faces run on the screen: it depends on whether y points up or down. Rounding moves a
// corner by half a unit, and so twice the area by the length of the outline and little more. The first back
// face that is larger tells; where all are smaller, the sum does.
int Solids::back_face_sign() {
  if (back_face_sign_ == 0) {
    std::int64_t sum = 0;
    for (const Polygon& polygon : polygons_) {
      if (!polygon.back_facing) continue;
      const std::int64_t area = twice_area(polygon);
      if (std::abs(area) > outline_length(polygon) + 3 * std::int64_t{polygon.corner_count}) {
        sum = area;
        break;
      }
      sum += area;
    }
    back_face_sign_ = sum > 0 ? 1 : -1;
  }
  return back_face_sign_;
}

std::int64_t Solids::twice_area(const Polygon& polygon) const {
  const farop_vertex* const v = &corners_[polygon.first_corner];
  std::int64_t sum = 0;
  for (std::uint32_t i = 2; i < polygon.corner_count; ++i) sum += turn(v[0], v[i - 1], v[i]);
  return sum;
}

std::int64_t Solids::outline_length(const Polygon& polygon) const {
  const farop_vertex* const v = &corners_[polygon.first_corner];
  std::int64_t length = 0;
  for (std::uint32_t i = 0, last = polygon.corner_count - 1; i < polygon.corner_count; last = i++) {
    length += std::abs(v[i].x - v[last].x) + std::abs(v[i].y - v[last].y);
  }
  return length;
}

// An edge lives on the lines y_low <= line < y_high, so horizontal edges live on none: the rule "bottom edges
// belong to the polygon, top ones do not". That "left ones do, right ones do not" follows from Edge::column.
void Solids::enter_polygon(std::uint32_t polygon) {
  const std::uint32_t first = polygons_[polygon].first_corner, count = polygons_[polygon].corner_count;
  const int bits = frame_->subpixel_bits;
  const auto line_at_or_above = [&](std::int32_t y) { return -((-y) >> bits); };
  std::uint32_t from = first + count - 1;
  for (std::uint32_t to = first; to < first + count; from = to++) {
    const bool upwards = corners_[from].y < corners_[to].y;
    const std::uint32_t low = upwards ? from : to, high = upwards ? to : from;
    const std::int32_t first_line = line_at_or_above(corners_[low].y);
    const std::int32_t end_line = line_at_or_above(corners_[high].y);
    if (first_line >= end_line) continue;
    if (variant_ >= 2 && ids_[low] != FAROP_NO_VERTEX_ID && ids_[high] != FAROP_NO_VERTEX_ID &&
        enter_second_polygon(low, high, polygon, upwards != polygons_[polygon].back_facing)) {
      continue;
    }
    enter_edge(low, high, first_line, end_line, polygon);
  }
}

// Gives the edge that a neighbour has entered its second polygon. Or makes room for the edge to be entered
// next, and returns false. The polygon that the sweep leaves at the edge comes first: which one that is
// decides whether the polygons are in, not this order; but cross() is faster where it can be foretold.
bool Solids::enter_second_polygon(std::uint32_t low, std::uint32_t high, std::uint32_t polygon,
                                  bool on_its_left) {
  const std::uint32_t low_id = ids_[low], high_id = ids_[high], surface = polygons_[polygon].surface;
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>(mixed(low_id ^ (surface << 16), high_id)) & mask;
  for (; slots_[at] != k_none; at = (at + 1) & mask) {
    Edge& edge = edge_table_[slots_[at]];
    const EdgeEnds& ends = edge_ends_[edge.ends];
    if (ids_[ends.low] != low_id || ids_[ends.high] != high_id ||
        polygons_[edge.polygon[0]].surface != surface) {
      continue;
    }
    const auto same_place = [&](const farop_vertex& a, const farop_vertex& b) {
      return a.x == b.x && a.y == b.y && a.z == b.z;
    };
    const bool same =
        same_place(corners_[ends.low], corners_[low]) && same_place(corners_[ends.high], corners_[high]);
    if (same && edge.polygon[1] == k_none) {
      edge.polygon[1] = polygon;
      if (on_its_left) std::swap(edge.polygon[0], edge.polygon[1]);
      return true;
    }
    surfaces_[surface].solid = false;  // a third polygon, or ids that are none
    return false;
  }
  slots_[at] = static_cast<std::uint32_t>(edge_table_.size());
  return false;
}

void Solids::enter_edge(std::uint32_t low, std::uint32_t high, std::int32_t first_line, std::int32_t end_line,
                        std::uint32_t polygon) {
  const std::int32_t x = corners_[low].x, y = corners_[low].y;
  const int bits = frame_->subpixel_bits;
  const std::int32_t dx = corners_[high].x - x, dy = corners_[high].y - y;
  Edge edge;
  edge.end_line = end_line;
  edge.polygon[0] = polygon;
  edge.denominator = dy << bits;
  edge.ends = static_cast<std::uint32_t>(edge_ends_.size());
  edge_ends_.push_back({low, high, y, 1.0 / edge.denominator, static_cast<double>(corners_[low].z),
                        static_cast<double>(corners_[high].z - corners_[low].z)});
  edge.step = dx / dy;
  if (edge.step * dy > dx) --edge.step;  // rounds down, not towards zero
  edge.excess_step = (dx - edge.step * dy) << bits;
  // In units of 1 / (denominator << bits): the first line lies `up` above the lower end, a part of a line.
  const std::int64_t up = (first_line << bits) - y;
  const std::int64_t crossing = std::int64_t{x} * dy + up * dx;
  edge.column = -((-x) >> bits);  // where the lower end is
  if (up != 0) edge.column = static_cast<std::int32_t>((crossing + edge.denominator - 1) / edge.denominator);
  edge.excess = static_cast<std::int32_t>(std::int64_t{edge.column} * edge.denominator - crossing);
  edge_table_.push_back(edge);
  first_line_.push_back(first_line);
}

void Solids::sort_into_buckets() {
  bucket_.assign(static_cast<std::size_t>(frame_->height) + 2, 0);
  for (const std::int32_t line : first_line_) ++bucket_[static_cast<std::size_t>(line) + 2];
  for (std::size_t line = 2; line < bucket_.size(); ++line) bucket_[line] += bucket_[line - 1];
  // bucket_[line + 1] is where the next edge of the line goes; afterwards, where the next line begins.
  sorted_.resize(edge_table_.size());
  for (std::size_t e = 0; e < edge_table_.size(); ++e) {
    sorted_[bucket_[static_cast<std::size_t>(first_line_[e]) + 1]++] = edge_table_[e];
  }
  edge_table_.swap(sorted_);
  for (std::size_t line = 0; line + 2 < bucket_.size(); ++line) {
    if (bucket_[line + 1] - bucket_[line] < 2) continue;
    std::sort(edge_table_.begin() + bucket_[line], edge_table_.begin() + bucket_[line + 1], before);
  }
}

// ---- active edges -------------------------------------------------------------------------------

void Solids::next_active_edges() {
  // Drop, step, and put back in order those that have crossed others: few, unless the picture is a heap of
  // needles.
  std::size_t kept = 0, moves_left = 16 * active_.size() + 256;
  Edge* const active = active_.data();
  for (std::size_t k = 0, count = active_.size(); k < count; ++k) {
    if (active[k].end_line <= line_) continue;
    Edge edge = active[k];
    edge.step_up();
    std::size_t place = kept++;
    for (; place > 0 && moves_left > 0 && before(edge, active[place - 1]); --place, --moves_left) {
      active[place] = active[place - 1];
    }
    active[place] = edge;
  }
  active_.resize(kept);
  if (moves_left == 0) std::sort(active_.begin(), active_.end(), before);

  // Merge the bucket in, from the right.
  const Edge* const bucket = edge_table_.data() + bucket_[static_cast<std::size_t>(line_)];
  std::size_t begun = bucket_[static_cast<std::size_t>(line_) + 1] - bucket_[static_cast<std::size_t>(line_)];
  active_.resize(kept + begun);
  while (begun > 0) {
    const bool old = kept > 0 && before(bucket[begun - 1], active_[kept - 1]);
    active_[kept + begun - 1] = old ? active_[kept - 1] : bucket[begun - 1];
    --(old ? kept : begun);
  }
  count_.active_edges_sum += active_.size();
  count_.active_edges_max = std::max<std::uint64_t>(count_.active_edges_max, active_.size());
}

// ---- from left to right through a line ----------------------------------------------------------

void Solids::sweep() {
  visible_ = k_none;
  line_begin_ = spans_.size();
  const Edge* const active = active_.data();
  const auto count = static_cast<std::uint32_t>(active_.size());
  for (std::uint32_t k = 0; k < count;) {
    const std::int32_t column = active[k].column;
    ++column_number_;
    candidates_.clear();
    do {
      cross(k++);
    } while (k < count && active[k].column == column);
    if (in_.empty()) continue;
    ++count_.spans;
    const std::int32_t end = active[k].column;
    if (in_.size() > 1 && must_be_careful()) {
      emit_careful(in_, column, end);
    } else {
      emit_trusting(column, end);
    }
  }
}

// The sweep crosses an active edge: it enters or leaves its polygons.
void Solids::cross(std::uint32_t active) {
  const std::uint32_t a = active_[active].polygon[0], b = active_[active].polygon[1];
  const auto enter_or_leave = [&](std::uint32_t polygon, std::uint32_t crossing) {
    if (polygons_[polygon].in) {
      leave(polygon);
      if (visible_ == polygon) visible_ = k_none;
    } else {
      enter(polygon, crossing);
      make_candidate(polygon);
    }
  };
  if (b == k_none) {
    enter_or_leave(a, 2 * active);
  } else if (a == b) {
    // a bridge of one polygon, walked twice
  } else if (polygons_[a].in == polygons_[b].in) {
    enter_or_leave(a, 2 * active);  // the outline of a solid
    enter_or_leave(b, 2 * active + 1);
  } else {
    // From a face to its neighbour: what goes for one goes for the other, as they meet here.
    const auto go_over = [&](std::uint32_t from, std::uint32_t to, std::uint32_t crossing) {
      replace(from, to, crossing);
      if (visible_ == from) visible_ = to;
      if (polygons_[from].candidate_at == column_number_) make_candidate(to);
    };
    if (polygons_[a].in) {  // always, or never if y points down: but for faces that rounding has turned over
      go_over(a, b, 2 * active + 1);
    } else {
      go_over(b, a, 2 * active);
    }
  }
}

inline void Solids::enter(std::uint32_t polygon, std::uint32_t crossing) {
  Polygon& p = polygons_[polygon];
  p.in = true;
  p.slope_known = false;
  p.left = crossing, p.right = 0;
  p.column = active_[crossing / 2].column;
  p.place = static_cast<std::uint32_t>(in_.size());
  in_.push_back(polygon);
  if (!several_) return;
  Surface& surface = surfaces_[p.surface];
  if (!surface.solid)
    ++others_in_;
  else if (surface.in++ == 0)
    ++solids_in_;
}

// leave() and enter() for two of one surface.
inline void Solids::replace(std::uint32_t from, std::uint32_t to, std::uint32_t crossing) {
  Polygon &p = polygons_[from], &q = polygons_[to];
  p.in = false, q.in = true;
  q.slope_known = false;
  q.left = crossing, q.right = 0;
  q.column = active_[crossing / 2].column;
  q.place = p.place;
  in_[q.place] = to;
}

inline void Solids::leave(std::uint32_t polygon) {
  Polygon& p = polygons_[polygon];
  p.in = false;
  in_[p.place] = in_.back();
  polygons_[in_.back()].place = p.place;
  in_.pop_back();
  if (!several_) return;
  Surface& surface = surfaces_[p.surface];
  if (!surface.solid)
    --others_in_;
  else if (--surface.in == 0)
    --solids_in_;
}

inline void Solids::make_candidate(std::uint32_t polygon) {
  polygons_[polygon].candidate_at = column_number_;
  candidates_.push_back(polygon);
}

bool Solids::must_be_careful() const {
  return variant_ == 1 || others_in_ > 0 || solids_in_ > 1;
}

// What is visible from this column to the next end point, if all that is there belongs to one solid: nothing
// new, unless the sweep came over an outline. Faces do not cross, so depths at this pixel hold up to the end.
inline void Solids::emit_trusting(std::int32_t column, std::int32_t end) {
  bool certain = true;
  if (visible_ != k_none && candidates_.empty()) {
    // It stays, or its neighbour has taken its place.
  } else if (in_.size() == 1) {
    visible_ = in_[0];
  } else if (visible_ == k_none) {
    certain = nearest_among(in_, column);
  } else {
    std::erase_if(candidates_, [&](std::uint32_t p) { return !polygons_[p].in || p == visible_; });
    candidates_.push_back(visible_);
    certain = nearest_among(candidates_, column);
  }
  if (certain && !polygons_[visible_].back_facing) return emit(column, end);
  // Either faces touch here: where they meet in an edge or a corner that lies on this very pixel, it takes
  // the next one to tell which is in front. Or a back face is in sight: rounding to pixels has folded the
  // solid. The next span does not rely on this one.
  emit_careful(in_, column, end);
  visible_ = k_none;
}

// The same for any polygons: the span is cut where one comes through another.
void Solids::emit_careful(const std::vector<std::uint32_t>& polygons, std::int32_t column, std::int32_t end) {
  for (std::int32_t cut = end; column < end; column = cut, cut = end) {
    nearest_among(polygons, column);
    for (const std::uint32_t polygon : polygons) {
      if (polygon == visible_ || cut == column + 1 || is_all_behind(polygon, visible_)) continue;
      ++count_.depth_comparisons;
      if (!in_front(polygon, depth(polygon, cut - 1), visible_, depth(visible_, cut - 1))) continue;
      cut = comes_through(polygon, visible_, column, cut);
    }
    if (cut < end) ++count_.spans;
    emit(column, cut);
  }
}

// Makes the nearest one visible. False if another one is as near.
bool Solids::nearest_among(const std::vector<std::uint32_t>& polygons, std::int32_t column) {
  bool alone = true;
  visible_ = polygons[0];
  for (std::size_t i = 1; i < polygons.size(); ++i) {
    const std::uint32_t polygon = polygons[i];
    ++count_.depth_comparisons;
    if (is_all_behind(polygon, visible_)) continue;
    if (is_all_behind(visible_, polygon)) {
      visible_ = polygon, alone = true;
      continue;
    }
    const std::int64_t nearest = depth(visible_, column), here = depth(polygon, column);
    if (here > nearest) continue;
    alone = here < nearest;
    if (in_front(polygon, here, visible_, nearest)) visible_ = polygon;
  }
  return alone;
}

inline void Solids::emit(std::int32_t column, std::int32_t end) {
  Polygon& polygon = polygons_[visible_];
  if (spans_.size() > line_begin_ && spans_.back().end == column && spans_.back().polygon == visible_ &&
      (polygon.one_color || last_left_ == polygon.left)) {
    spans_.back().end = end;
    return;
  }
  last_left_ = polygon.left;
  spans_.push_back({column, end, visible_, polygon.one_color ? k_none : make_ramp(polygon, column)});
}

// ---- depths and colours on a line ---------------------------------------------------------------

// Where a polygon that was entered on this line is left. Only for those that somebody asks for.
const Edge& Solids::right_edge(Polygon& polygon) {
  if (polygon.right == 0) {
    const std::uint32_t self = static_cast<std::uint32_t>(&polygon - polygons_.data());
    std::uint32_t k = polygon.left / 2 + 1;
    // Its next edge, but no bridge that is walked twice.
    while ((active_[k].polygon[0] == self) == (active_[k].polygon[1] == self)) ++k;
    polygon.right = k;
  }
  return active_[polygon.right];
}

// Anything that is linear along the segment of a polygon on this line: what `at` says of the edges that bound
// it, at a part 0 .. 1 of their height. The segment is `width` columns wide, and its first pixel lies
// `to_first` columns from its left end.
template <class At>
Solids::Ends Solids::ends(Polygon& polygon, const At& at) {
  const Edge &left = active_[polygon.left / 2], &right = right_edge(polygon);
  const EdgeEnds &left_ends = edge_ends_[left.ends], &right_ends = edge_ends_[right.ends];
  const int bits = frame_->subpixel_bits;  // denominator = height << bits
  const auto along = [&](const EdgeEnds& edge) {
    return (((line_ << bits) - edge.low_y) << bits) * edge.per_denominator;
  };
  Ends ends;
  ends.left = at(left_ends, along(left_ends)), ends.right = at(right_ends, along(right_ends));
  // Sums of terms that are never negative: however thin the segment, no digits are lost.
  ends.to_first = left.excess * left_ends.per_denominator;
  ends.width = (right.column - 1 - left.column) + ends.to_first +
               (right.denominator - right.excess) * right_ends.per_denominator;
  ends.pixels = right.column - left.column;
  return ends;
}

// Most polygons that lie behind each other are so far apart that no depths at a pixel need be known.
inline bool Solids::is_all_behind(std::uint32_t a, std::uint32_t b) const {
  return polygons_[a].nearest > polygons_[b].farthest;
}

inline std::int64_t Solids::depth(std::uint32_t polygon, std::int32_t column) {
  Polygon& p = polygons_[polygon];
  if (!p.slope_known) find_slope(p);
  return (p.z + p.z_step * (column - p.column)) >> (k_depth_bits - k_compare_bits);
}

void Solids::find_slope(Polygon& polygon) {
  const Ends z = ends(polygon, [](const EdgeEnds& edge, double t) { return edge.low_z + edge.z_change * t; });
  constexpr double one = 1 << k_depth_bits;
  const double slope = (z.right - z.left) / z.width;
  polygon.z = static_cast<std::int64_t>((z.left + slope * z.to_first) * one);
  polygon.z += std::int64_t{1} << (k_depth_bits - k_compare_bits - 1);  // so that dropping bits rounds
  polygon.z_step = z.pixels > 1 ? static_cast<std::int64_t>(slope * one) : 0;
  polygon.slope_known = true;
}

// Of equal depths the first drawn stays. But where a front and a back face of one surface touch, on the
// outline of a solid, the front face shows, as it does where variant 3 has dropped the other.
bool Solids::in_front(std::uint32_t a, std::int64_t depth_a, std::uint32_t b, std::int64_t depth_b) {
  if (depth_a != depth_b) return depth_a < depth_b;
  const Polygon &p = polygons_[a], &q = polygons_[b];
  if (p.in_surface && p.surface == q.surface && (p.back_facing || q.back_facing)) {
    if (p.back_facing != q.back_facing) return q.back_facing;
    const bool p_is_back = is_back_face(p), q_is_back = is_back_face(q);
    if (p_is_back != q_is_back) return q_is_back;
  }
  return a < b;
}

// `a` is behind `b` at `column` and in front at end - 1: the first pixel where it is in front. Segments are
// straight, so there is one change only, and halving finds it.
std::int32_t Solids::comes_through(std::uint32_t a, std::uint32_t b, std::int32_t column, std::int32_t end) {
  std::int32_t behind = column, before = end - 1;
  while (before - behind > 1) {
    ++count_.depth_comparisons;
    const std::int32_t middle = behind + (before - behind) / 2;
    (in_front(a, depth(a, middle), b, depth(b, middle)) ? before : behind) = middle;
  }
  return before;
}

std::uint32_t Solids::make_ramp(Polygon& polygon, std::int32_t column) {
  Ramp ramp;
  const auto set = [&](int channel, std::uint8_t farop_vertex::*component) {
    const Ends c = ends(polygon, [&](const EdgeEnds& edge, double t) {
      const double low = corners_[edge.low].*component, high = corners_[edge.high].*component;
      return low + (high - low) * t;
    });
    constexpr double one = 1 << k_color_bits;
    const double slope = (c.right - c.left) / c.width;
    const double start = c.left + slope * (c.to_first + (column - polygon.column));
    ramp.color[channel] = static_cast<std::uint32_t>((start + 0.5) * one);
    ramp.step[channel] =
        static_cast<std::uint32_t>(c.pixels > 1 ? static_cast<std::int32_t>(slope * one) : 0);
  };
  set(0, &farop_vertex::r), set(1, &farop_vertex::g), set(2, &farop_vertex::b);
  ramps_.push_back(ramp);
  return static_cast<std::uint32_t>(ramps_.size() - 1);
}

// ---- pixels -------------------------------------------------------------------------------------

/// The same three bytes `count` times, count > 0. Some pixels are written twice: that is faster than to ask
/// how many are left.
void fill(std::uint8_t* to, std::int32_t count, const FourPixels& four) {
  std::uint8_t* const end = to + 3 * std::ptrdiff_t{count};
  if (count >= 4) {
    std::memcpy(to, four.data(), 12);
    std::memcpy(end - 12, four.data(), 12);
    for (; count > 8; count -= 4) std::memcpy(to += 12, four.data(), 12);
  } else {
    std::memcpy(to, four.data(), 3);
    std::memcpy(to + 3 * (count / 2), four.data(), 3);
    std::memcpy(end - 3, four.data(), 3);
  }
}

void Solids::write_pixels() {
  std::size_t at = 0;
  for (std::int32_t line = 0; line < frame_->height; ++line) {
    std::uint8_t* const row = frame_->pixels + line * frame_->row_bytes;
    for (; at < line_end_[static_cast<std::size_t>(line)]; ++at) {
      const Span& span = spans_[at];
      std::uint8_t* pixel = row + 3 * std::int64_t{span.first};
      count_.pixels += static_cast<std::uint64_t>(span.end - span.first);
      if (span.ramp == k_none) {
        fill(pixel, span.end - span.first, colors_[span.polygon]);
        continue;
      }
      Ramp ramp = ramps_[span.ramp];
      for (std::int32_t column = span.first; column < span.end; ++column, pixel += 3) {
        for (int c = 0; c < 3; ++c) {
          pixel[c] = static_cast<std::uint8_t>(ramp.color[c] >> k_color_bits);
          ramp.color[c] += ramp.step[c];
        }
      }
    }
  }
}

void Solids::draw() {
  using Clock = std::chrono::steady_clock;
  count_ = {};
  const auto start = Clock::now();
  build_edge_table();
  const auto built = Clock::now();
  // Whatever a frame that failed has left behind.
  active_.clear(), in_.clear();
  spans_.clear(), ramps_.clear();
  solids_in_ = others_in_ = column_number_ = 0;
  line_end_.clear();
  for (line_ = 0; line_ < frame_->height; ++line_) {
    next_active_edges();
    sweep();
    line_end_.push_back(spans_.size());
  }
  const auto scanned = Clock::now();
  write_pixels();
  if (!log_statistics_) return;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  report(seconds(built - start), seconds(scanned - built), seconds(Clock::now() - scanned));
}

void Solids::report(double build, double scan, double pixel) const {
  char text[512];
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::snprintf(text, sizeof text,
                "statistics edge_table=%llu active_edges_max=%llu active_edges_sum=%llu spans=%llu "
                "depth_comparisons=%llu pixels=%llu build_seconds=%.9f scan_seconds=%.9f pixel_seconds=%.9f",
                number(edge_table_.size()), number(count_.active_edges_max), number(count_.active_edges_sum),
                number(count_.spans), number(count_.depth_comparisons), number(count_.pixels), build, scan,
                pixel);
  host_->log(host_, FAROP_LOG_INFO, text);
}

// ---- the interface: nothing is thrown across it -------------------------------------------------

template <class Body>
farop_status guarded(const farop_host* host, const Body& body) noexcept {
  try {
    body();
    return FAROP_OK;
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  } catch (const Refusal& refusal) {
    host->log(host, FAROP_LOG_ERROR, refusal.what());
    return refusal.status;
  } catch (const std::exception& error) {
    host->log(host, FAROP_LOG_ERROR, error.what());
    return FAROP_E_INTERNAL;
  }
}

Solids* new_solids(const farop_host* host) {
  const auto option = [&](const char* key, const char* otherwise) {
    const char* const value = host->option(host, key);
    return std::string_view(value != nullptr ? value : otherwise);
  };
  const std::string_view variant = option("variant", "3"), statistics = option("statistics", "0");
  if (variant != "1" && variant != "2" && variant != "3") {
    throw Refusal(FAROP_E_UNSUPPORTED, "solids: option variant is 1, 2 or 3");
  }
  if (statistics != "0" && statistics != "1") {
    throw Refusal(FAROP_E_UNSUPPORTED, "solids: option statistics is 0 or 1");
  }
  return new Solids(host, variant[0] - '0', statistics == "1");
}

Solids& of(void* self) {
  return *static_cast<Solids*>(self);
}

}  // namespace

extern "C" const farop_rasterizer* farop_rasterizer_entry(const farop_host*) {
  static const farop_rasterizer table = {
      sizeof table,
      FAROP_ABI_VERSION,
      "solids",
      "spanning scan-line, faster on solids (Lenz Cesar, Oliveira)",
      FAROP_WANT_VERTEX_IDS,
      0,
      [](const farop_host* host, void** self) { return guarded(host, [&] { *self = new_solids(host); }); },
      [](void* self) { delete &of(self); },
      [](void* self, const farop_frame* frame) {
        return guarded(of(self).host(), [&] { of(self).begin(*frame); });
      },
      [](void* self, const farop_polygon* polygon) {
        return guarded(of(self).host(), [&] { of(self).store(*polygon); });
      },
      [](void* self) { return guarded(of(self).host(), [&] { of(self).draw(); }); }};
  return &table;
}
