// SPDX-License-Identifier: GPL-3.0-or-later
// watkins - hidden surfaces by scan line, without a depth buffer.
//
// The algorithm of G. S. Watkins, "A Real-Time Visible Surface Algorithm", PhD thesis, University of Utah,
// 1970; also in W. M. Newman and R. F. Sproull, Principles of Interactive Computer Graphics, 2nd ed.,
// McGraw-Hill 1979. Shading along the spans: H. Gouraud, "Continuous Shading of Curved Surfaces", IEEE
// Transactions on Computers C-20(6), 1971.
//
//   polygon() only stores. end_frame() then goes through the scan lines, from the bottom up:
//     edge table -> active edges:   a bucket for every line, with the edges that begin there
//     active edges -> segments:     where the line cuts the polygons (odd-even rule: a concave polygon is cut
//                                   several times)
//     segments -> sample spans:     from left to right; in a sample span one segment is nearest throughout
//     sample spans -> pixels
//
// How sample spans are found. At the left end the nearest segment is looked up. The span reaches as far as
// this segment does, unless before that another one begins in front of it, or one from behind comes through
// it (polygons may interpenetrate): there the span is cut and the search starts again. Whatever begins and
// ends behind the visible segment costs one comparison and cuts nothing. What was visible here on the line
// before is looked at first: it mostly still is, and with a near depth to begin with the search is short.
//
// Watkins' machine kept the hidden segments in a list. Here they are in a heap, by the nearest depth they
// have anywhere, and no branch of it is entered whose top lies behind what is compared: thousands of
// polygons on top of each other cost a few comparisons, not thousands.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <new>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "farop/rasterizer.h"

namespace {

/// What the host did wrong.
struct BrokenContract : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Of a polygon that is not horizontal. It crosses the current line at x = column - excess / denominator with
/// 0 <= excess < denominator, so `column` is the first sample that is not left of it: exact, for ever.
/// Frames have at most 32767 pixels a side and 8 sub-pixel bits, so the denominator stays below 2^31.
struct Edge {
  std::uint32_t polygon = 0;
  std::int32_t column = 0, excess = 0, denominator = 1;
  std::int32_t step = 0, excess_step = 0;     ///< a line up, x grows by step + excess_step / denominator
  std::int32_t first_line = 0, end_line = 0;  ///< crosses first_line .. end_line - 1
  double per_denominator = 1;
  std::uint32_t low = 0, high = 0;  ///< its ends, in the list of all corners

  void step_up() {
    excess -= excess_step;
    const std::int32_t carry = excess >> 31;  // -1 below zero, else 0: no branch, it could not be foretold
    excess += carry & denominator;
    column += step - carry;
  }
};

/// Edges of one polygon stand together, from left to right.
bool before(const Edge& a, const Edge& b) {
  if (a.polygon != b.polygon) return a.polygon < b.polygon;
  if (a.column != b.column) return a.column < b.column;
  return std::int64_t{a.excess} * b.denominator > std::int64_t{b.excess} * a.denominator;
}

/// Depths are compared in units of 1/256: fine enough to decide what whole numbers leave open, and coarse
/// enough that the last bits of the arithmetic do not. Equal depths at a sample are thus found equal, and of
/// equals the first drawn is in front.
using Depth = std::int64_t;

/// The samples of the current line, first .. end - 1 and at least one, between two edges of a polygon.
/// Anything that is linear along it has the value left + (right - left) * along(column).
struct Segment {
  std::int32_t first = 0, end = 0;
  std::uint32_t polygon = 0;
  std::uint32_t left = 0, right = 0;    ///< active edges
  double distance = 0, per_column = 0;  ///< from the left crossing to sample `first`; 1 / width; in columns
  double left_z = 0, z_change = 0;      ///< at the left crossing, and to the right one, in units of Depth
  Depth nearest = 0;                    ///< of all samples

  double along(std::int32_t column) const { return (distance + (column - first)) * per_column; }
  Depth depth(std::int32_t column) const {
    const double shifted = left_z + z_change * along(column) + 0.5;
    return static_cast<Depth>(shifted);  // not negative: rounds to nearest
  }
  bool covers(std::int32_t column) const { return first <= column && column < end; }
};

/// Whether `a` hides `b` at a sample of both.
bool in_front(const Segment& a, const Segment& b, std::int32_t column) {
  return std::tuple(a.depth(column), a.polygon) < std::tuple(b.depth(column), b.polygon);
}

/// The first sample in from .. end - 1 where `s`, which is behind there, has come through `visible`; `end` if
/// none. Both are straight, so there is one change at most, and halving finds it.
std::int32_t cut_by(const Segment& s, const Segment& visible, std::int32_t from, std::int32_t end) {
  std::int32_t behind = from, before = std::min(s.end, end) - 1;
  if (!in_front(s, visible, before)) return end;
  while (before - behind > 1) {
    const std::int32_t middle = behind + (before - behind) / 2;
    (in_front(s, visible, middle) ? before : behind) = middle;
  }
  return before;
}

struct SampleSpan {
  std::int32_t end = 0;
  std::uint32_t polygon = 0;
};

/// What decides who is in front: smaller is.
using Rank = std::tuple<Depth, std::uint32_t>;

constexpr std::uint32_t k_none = 0xFFFFFFFFu;

class Watkins {
 public:
  void begin(const farop_frame& frame);
  void store(const farop_polygon& polygon);
  void draw();

 private:
  struct Polygon {
    std::uint32_t segment = k_none;  ///< the one of this line that was met last
    bool one_color = false;
  };

  void add_edge(std::uint32_t a, std::uint32_t b);
  void sort_into_buckets();

  void next_active_edges(std::int32_t line);
  void cut_polygons(std::int32_t line);
  void find_sample_spans(std::int32_t line);

  Rank rank(std::uint32_t segment) const { return {segments_[segment].nearest, segments_[segment].polygon}; }
  void meet(std::uint32_t segment);
  void forget_ended(std::int32_t column);
  std::uint32_t nearest_at(std::int32_t column, std::uint32_t guess);
  std::int32_t cut_by_hidden(const Segment& visible, std::int32_t from, std::int32_t end);
  template <class Visit>
  void search_met(std::int32_t column, const Rank& bound, const Visit& visit);
  std::uint32_t visible_on_last_line(std::int32_t column);

  double at_crossing(const Edge& edge, double low, double high, std::int32_t line) const;
  void paint(std::int32_t line, const Segment& segment, std::int32_t from, std::int32_t end);

  const farop_frame* frame_ = nullptr;
  std::vector<farop_vertex> corners_;
  std::vector<Polygon> polygons_;
  std::vector<Edge> edge_table_, sorted_;  ///< by first_line once sort_into_buckets() was called
  std::vector<std::uint32_t> bucket_;      ///< line -> its first edge in edge_table_
  std::vector<Edge> active_, begun_, merged_;
  std::vector<Segment> segments_;               ///< of the current line, by first
  std::vector<std::uint32_t> met_;              ///< heap of those that have begun; top: nearest
  std::size_t ended_seen_ = 0;                  ///< ended ones that searches have come across in met_
  std::vector<std::uint32_t> path_;             ///< of a search through met_
  std::vector<SampleSpan> spans_, last_spans_;  ///< of this line and the one before
  std::size_t last_span_ = 0;
};

// ---- storing ------------------------------------------------------------------------------------

void Watkins::begin(const farop_frame& frame) {
  frame_ = &frame;
  corners_.clear();
  polygons_.clear();
  edge_table_.clear();
}

void Watkins::store(const farop_polygon& polygon) {
  const std::int32_t right = (frame_->width - 1) << frame_->subpixel_bits;
  const std::int32_t top = (frame_->height - 1) << frame_->subpixel_bits;
  const auto first = static_cast<std::uint32_t>(corners_.size());
  const farop_vertex* const v = polygon.vertices;
  Polygon stored;
  stored.one_color = true;
  for (std::uint32_t i = 0; i < polygon.vertex_count; ++i) {
    if (v[i].x < 0 || v[i].x > right || v[i].y < 0 || v[i].y > top) {
      throw BrokenContract("watkins: a corner outside the frame");
    }
    stored.one_color = stored.one_color && v[i].r == v[0].r && v[i].g == v[0].g && v[i].b == v[0].b;
    corners_.push_back(v[i]);
  }
  for (std::uint32_t i = 0; i < polygon.vertex_count; ++i) {
    add_edge(first + i, first + (i + 1 < polygon.vertex_count ? i + 1 : 0));
  }
  polygons_.push_back(stored);
}

// Lines live on y_low <= line < y_high, so horizontal edges live on none: the rule "bottom edges belong to
// the polygon, top ones do not". That "left ones do, right ones do not" follows from Edge::column.
void Watkins::add_edge(std::uint32_t a, std::uint32_t b) {
  if (corners_[a].y > corners_[b].y) std::swap(a, b);
  const farop_vertex &low = corners_[a], &high = corners_[b];
  const int bits = frame_->subpixel_bits;
  const auto line_at_or_above = [&](std::int32_t y) { return -((-y) >> bits); };
  Edge edge;
  edge.polygon = static_cast<std::uint32_t>(polygons_.size());
  edge.first_line = line_at_or_above(low.y), edge.end_line = line_at_or_above(high.y);
  if (edge.first_line >= edge.end_line) return;
  edge.low = a, edge.high = b;

  const std::int64_t dx = high.x - low.x, dy = high.y - low.y;
  const auto floor_div = [](std::int64_t p, std::int64_t q) { return p / q - (p % q < 0 ? 1 : 0); };
  edge.denominator = static_cast<std::int32_t>(dy << bits);
  edge.per_denominator = 1.0 / edge.denominator;
  const std::int64_t crossing =  // times denominator
      low.x * dy + ((std::int64_t{edge.first_line} << bits) - low.y) * dx;
  edge.column = static_cast<std::int32_t>(-floor_div(-crossing, edge.denominator));
  edge.excess = static_cast<std::int32_t>(std::int64_t{edge.column} * edge.denominator - crossing);
  edge.step = static_cast<std::int32_t>(floor_div(dx, dy));
  edge.excess_step = static_cast<std::int32_t>((dx - edge.step * dy) << bits);
  edge_table_.push_back(edge);
}

void Watkins::sort_into_buckets() {
  bucket_.assign(static_cast<std::size_t>(frame_->height) + 1, 0);
  for (const Edge& edge : edge_table_) ++bucket_[static_cast<std::size_t>(edge.first_line) + 1];
  for (std::size_t line = 1; line < bucket_.size(); ++line) bucket_[line] += bucket_[line - 1];
  std::vector<std::uint32_t> place(bucket_.begin(), bucket_.end() - 1);
  sorted_.resize(edge_table_.size());
  for (const Edge& edge : edge_table_) sorted_[place[static_cast<std::size_t>(edge.first_line)]++] = edge;
  edge_table_.swap(sorted_);
}

// ---- active edges -------------------------------------------------------------------------------

void Watkins::next_active_edges(std::int32_t line) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (active_[k].end_line <= line) continue;
    Edge edge = active_[k];
    edge.step_up();
    // Only the edges of a polygon that crosses itself ever change their order.
    std::size_t place = kept++;
    for (; place > 0 && before(edge, active_[place - 1]); --place) active_[place] = active_[place - 1];
    active_[place] = edge;
  }
  active_.resize(kept);

  const std::uint32_t first = bucket_[static_cast<std::size_t>(line)];
  const std::uint32_t end = bucket_[static_cast<std::size_t>(line) + 1];
  if (first == end) return;
  begun_.assign(edge_table_.begin() + first, edge_table_.begin() + end);
  std::sort(begun_.begin(), begun_.end(), before);
  merged_.resize(active_.size() + begun_.size());
  std::merge(active_.begin(), active_.end(), begun_.begin(), begun_.end(), merged_.begin(), before);
  active_.swap(merged_);
}

// ---- segments -----------------------------------------------------------------------------------

double Watkins::at_crossing(const Edge& edge, double low, double high, std::int32_t line) const {
  const int bits = frame_->subpixel_bits;  // the denominator is the height of the edge << bits
  const std::int32_t above_low = (line << bits) - corners_[edge.low].y;
  return low + (high - low) * ((above_low << bits) * edge.per_denominator);
}

void Watkins::cut_polygons(std::int32_t line) {
  segments_.clear();
  for (std::uint32_t k = 0; k + 1 < active_.size(); k += 2) {
    const Edge &left = active_[k], &right = active_[k + 1];
    if (left.column >= right.column) continue;  // no sample between them
    Segment s;
    s.first = left.column, s.end = right.column;
    s.polygon = left.polygon;
    s.left = k, s.right = k + 1;
    // Sums of terms that are never negative: however thin the segment, no digits are lost.
    const double left_rest = left.excess * left.per_denominator;
    const double right_rest = (right.denominator - right.excess) * right.per_denominator;
    s.distance = left_rest;
    s.per_column = 1 / ((right.column - 1 - left.column) + left_rest + right_rest);
    const auto z = [&](const Edge& edge) {
      return 256 * at_crossing(edge, corners_[edge.low].z, corners_[edge.high].z, line);
    };
    s.left_z = z(left);
    s.z_change = z(right) - s.left_z;
    s.nearest = std::min(s.depth(s.first), s.depth(s.end - 1));
    segments_.push_back(s);
  }
  std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) {
    return std::tuple(a.first, a.polygon) < std::tuple(b.first, b.polygon);
  });
}

// ---- sample spans -------------------------------------------------------------------------------

void Watkins::find_sample_spans(std::int32_t line) {
  met_.clear();
  ended_seen_ = 0;
  last_spans_.swap(spans_);
  spans_.clear();
  last_span_ = 0;
  std::uint32_t next = 0;  // the first segment not met yet
  const auto begins_before = [&](std::int32_t column) {
    return next < segments_.size() && segments_[next].first < column;
  };
  std::int32_t column = 0;
  for (;;) {
    while (begins_before(column + 1)) meet(next++);
    forget_ended(column);
    if (met_.empty()) {
      if (next == segments_.size()) return;
      spans_.push_back({segments_[next].first, k_none});
      column = segments_[next].first;
      continue;
    }
    const Segment& visible = segments_[nearest_at(column, visible_on_last_line(column))];
    std::int32_t end = cut_by_hidden(visible, column, visible.end);
    while (begins_before(end)) {
      const Segment& s = segments_[next];
      if (in_front(s, visible, s.first)) {
        end = s.first;
      } else {
        meet(next++);
        end = cut_by(s, visible, s.first, end);
      }
    }
    paint(line, visible, column, end);
    spans_.push_back({end, visible.polygon});
    column = end;
  }
}

// ---- the heap of segments that have begun -------------------------------------------------------

void Watkins::meet(std::uint32_t segment) {
  polygons_[segments_[segment].polygon].segment = segment;
  met_.push_back(segment);
  std::push_heap(met_.begin(), met_.end(),
                 [&](std::uint32_t a, std::uint32_t b) { return rank(b) < rank(a); });
}

// Ended segments leave the heap when they come to its top, or all at once when they are in the way.
void Watkins::forget_ended(std::int32_t column) {
  const auto by_rank = [&](std::uint32_t a, std::uint32_t b) { return rank(b) < rank(a); };
  const auto ended = [&](std::uint32_t s) { return segments_[s].end <= column; };
  if (ended_seen_ > met_.size()) {
    std::erase_if(met_, ended);
    std::make_heap(met_.begin(), met_.end(), by_rank);
    ended_seen_ = 0;
  }
  while (!met_.empty() && ended(met_.front())) {
    std::pop_heap(met_.begin(), met_.end(), by_rank);
    met_.pop_back();
  }
}

// Calls visit(segment) for those that cover `column` and could be in front of `bound` somewhere. `visit` may
// bring `bound` nearer.
template <class Visit>
void Watkins::search_met(std::int32_t column, const Rank& bound, const Visit& visit) {
  path_.assign(1, 0);
  while (!path_.empty()) {
    const std::uint32_t place = path_.back();
    path_.pop_back();
    if (place >= met_.size() || !(rank(met_[place]) < bound)) continue;
    if (segments_[met_[place]].end > column) {
      visit(met_[place]);
    } else {
      ++ended_seen_;
    }
    path_.push_back(2 * place + 2);
    path_.push_back(2 * place + 1);
  }
}

std::uint32_t Watkins::nearest_at(std::int32_t column, std::uint32_t guess) {
  std::uint32_t nearest = guess;
  const auto rank_here = [&](std::uint32_t s) {
    return Rank(segments_[s].depth(column), segments_[s].polygon);
  };
  Rank bound = guess != k_none ? rank_here(guess) : Rank(INT64_MAX, k_none);
  search_met(column, bound, [&](std::uint32_t s) {
    if (const Rank here = rank_here(s); here < bound) nearest = s, bound = here;
  });
  return nearest;
}

std::int32_t Watkins::cut_by_hidden(const Segment& visible, std::int32_t from, std::int32_t end) {
  const Rank farthest(std::max(visible.depth(from), visible.depth(end - 1)), visible.polygon);
  search_met(from, farthest, [&](std::uint32_t s) {
    if (&segments_[s] != &visible) end = cut_by(segments_[s], visible, from, end);
  });
  return end;
}

// The segment of the polygon that was visible at this sample on the line before, if it is here again.
// `column` only grows within a line.
std::uint32_t Watkins::visible_on_last_line(std::int32_t column) {
  while (last_span_ < last_spans_.size() && last_spans_[last_span_].end <= column) ++last_span_;
  if (last_span_ == last_spans_.size() || last_spans_[last_span_].polygon == k_none) return k_none;
  const std::uint32_t segment = polygons_[last_spans_[last_span_].polygon].segment;
  // What is left over from a line before, or from another place of this line, is no guess.
  const bool here = segment < segments_.size() && segments_[segment].covers(column) &&
                    segments_[segment].polygon == last_spans_[last_span_].polygon;
  return here ? segment : k_none;
}

// ---- pixels -------------------------------------------------------------------------------------

void Watkins::paint(std::int32_t line, const Segment& segment, std::int32_t from, std::int32_t end) {
  std::uint8_t* pixel = frame_->pixels + line * frame_->row_bytes + 3 * std::int64_t{from};
  if (polygons_[segment.polygon].one_color) {
    const farop_vertex& color = corners_[active_[segment.left].low];
    for (std::int32_t column = from; column < end; ++column, pixel += 3) {
      pixel[0] = color.r, pixel[1] = color.g, pixel[2] = color.b;
    }
    return;
  }
  // Gouraud, from the ends of the whole segment: what hides a part of it does not change the rest.
  double color[3], change[3];  // at sample `from`, and from sample to sample
  const auto start = [&](int channel, std::uint8_t farop_vertex::*component) {
    const auto at = [&](const Edge& edge) {
      return at_crossing(edge, corners_[edge.low].*component, corners_[edge.high].*component, line);
    };
    const double left = at(active_[segment.left]), right = at(active_[segment.right]);
    color[channel] = left + (right - left) * segment.along(from) + 0.5;  // dropping the fraction rounds
    change[channel] = (right - left) * segment.per_column;
  };
  start(0, &farop_vertex::r), start(1, &farop_vertex::g), start(2, &farop_vertex::b);
  for (std::int32_t i = 0; i < end - from; ++i, pixel += 3) {
    for (int c = 0; c < 3; ++c) {
      // Not below zero, and 255.5 at most but for the last bit.
      pixel[c] = static_cast<std::uint8_t>(std::min(static_cast<int>(color[c] + i * change[c]), 255));
    }
  }
}

void Watkins::draw() {
  sort_into_buckets();
  active_.clear();
  spans_.clear();
  for (std::int32_t line = 0; line < frame_->height; ++line) {
    next_active_edges(line);
    cut_polygons(line);
    find_sample_spans(line);
  }
}

// ---- the interface: nothing is thrown across it -------------------------------------------------

const farop_host* g_host = nullptr;

template <class Body>
farop_status guarded(const Body& body) noexcept {
  try {
    body();
    return FAROP_OK;
  } catch (const std::bad_alloc&) {
    return FAROP_E_MEMORY;
  } catch (const BrokenContract& error) {
    g_host->log(g_host, FAROP_LOG_ERROR, error.what());
    return FAROP_E_INVALID;
  } catch (const std::exception& error) {
    g_host->log(g_host, FAROP_LOG_ERROR, error.what());
    return FAROP_E_INTERNAL;
  }
}

Watkins& of(void* self) {
  return *static_cast<Watkins*>(self);
}

}  // namespace

extern "C" const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  g_host = host;
  static const farop_rasterizer table = {
      sizeof table,
      FAROP_ABI_VERSION,
      "watkins",
      "Watkins' scan-line visible surfaces, Gouraud",
      0,
      0,
      [](const farop_host*, void** self) { return guarded([&] { *self = new Watkins; }); },
      [](void* self) { delete &of(self); },
      [](void* self, const farop_frame* frame) { return guarded([&] { of(self).begin(*frame); }); },
      [](void* self, const farop_polygon* polygon) { return guarded([&] { of(self).store(*polygon); }); },
      [](void* self) { return guarded([&] { of(self).draw(); }); }};
  return &table;
}
