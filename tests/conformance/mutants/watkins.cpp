// SPDX-License-Identifier: GPL-3.0-or-later
// A Watkins rasterizer: no depth buffer; on every row the polygons are cut into segments, and in each sample
// span the nearest segment is looked for (G. S. Watkins, "A Real-Time Visible Surface Algorithm", PhD thesis,
// University of Utah, 1970). All in whole numbers. Compiled with -DMUTANT=n it has exactly one fault, the
// n-th of manifest.tsv; without, none.
#include <algorithm>
#include <tuple>
#include <vector>

#include "entry.h"
#include "span.h"

namespace {

struct ActiveEdge {
  Edge edge;
  std::uint32_t polygon;
};

/// Of a polygon on the current row: samples first .. end - 1.
struct Segment {
  int first, end;
  std::uint32_t polygon;
  Crossing left, right;
  Int128 z_first, z_step;  ///< depth at `first`, and from column to column, times denominator
  std::int64_t denominator;

  int depth(int column) const {
    return static_cast<int>(
        floor_div(2 * (z_first + z_step * (column - first)) + denominator, Int128{2} * denominator));
  }
};

/// Whether a hides b at a sample of both; of equal depths the first drawn is in front.
bool in_front(const Segment& a, const Segment& b, int column) {
  return std::tuple(a.depth(column), a.polygon) < std::tuple(b.depth(column), b.polygon);
}

/// The first column in from .. end - 1 where s, which is behind at `from`, has come through `visible`; `end`
/// if none.
int cut_by(const Segment& s, const Segment& visible, int from, int end) {
  int behind = from, before = std::min(s.end, end) - 1;
  if (before <= from || !in_front(s, visible, before)) return end;
  while (before - behind > 1) {
    const int middle = behind + (before - behind) / 2;
    (in_front(s, visible, middle) ? before : behind) = middle;
  }
  return before;
}

class Watkins {
 public:
  void begin(const farop_frame& frame) {
    canvas_.begin(frame);
    edges_.clear();
    first_corners_.clear();
  }
  void polygon(const farop_polygon& polygon);
  void end();

 private:
  struct SampleSpan {
    int end;
    std::uint32_t polygon;
  };

  void next_active_edges(int row);
  void cut_into_segments(int row);
  void find_sample_spans(int row);
  std::size_t nearest_at(int column) const;
  void paint(int row, const Segment& segment, int from, int end);

  Canvas canvas_;
  std::vector<ActiveEdge> edges_;  ///< the edge table: by first_row
  std::size_t entered_ = 0;        ///< edges of the table that have become active
  std::vector<const ActiveEdge*> active_;
  std::vector<farop_vertex> first_corners_;     ///< of every polygon
  std::vector<Segment> segments_;               ///< of the current row, from left to right
  std::vector<std::size_t> met_;                ///< segments that cover the current column
  std::vector<SampleSpan> spans_, last_spans_;  ///< of the current row and the one before
};

void Watkins::polygon(const farop_polygon& polygon) {
  canvas_.begin_polygon();
  const auto number = static_cast<std::uint32_t>(first_corners_.size());
  const farop_vertex* const v = polygon.vertices;
  for (std::uint32_t i = 0; i < polygon.vertex_count; ++i) {
    const farop_vertex &a = v[i], &b = v[(i + 1) % polygon.vertex_count];
    if (a.y < b.y) edges_.push_back({{a, b, a.y, b.y}, number});
    if (a.y > b.y) edges_.push_back({{b, a, b.y, a.y}, number});
  }
  first_corners_.push_back(v[0]);
}

void Watkins::end() {
  std::stable_sort(edges_.begin(), edges_.end(), [](const ActiveEdge& a, const ActiveEdge& b) {
    return a.edge.first_row < b.edge.first_row;
  });
  entered_ = 0;
  active_.clear();
  spans_.clear();
  for (int row = 0; row < canvas_.height(); ++row) {
    next_active_edges(row);
    cut_into_segments(row);
    find_sample_spans(row);
  }
}

void Watkins::next_active_edges(int row) {
  const auto ended = [&](const ActiveEdge* e) { return e->edge.end_row <= row; };
  active_.erase(std::remove_if(active_.begin(), active_.end(), ended), active_.end());
  for (; entered_ < edges_.size() && edges_[entered_].edge.first_row <= row; ++entered_) {
    active_.push_back(&edges_[entered_]);
  }
  const auto less = [&](const ActiveEdge* a, const ActiveEdge* b) {
    if (a->polygon != b->polygon) return a->polygon < b->polygon;
    const Crossing p = cross(a->edge, row), q = cross(b->edge, row);
    return p.x * q.dy < q.x * p.dy;
  };
  if (!std::is_sorted(active_.begin(), active_.end(), less)) std::sort(active_.begin(), active_.end(), less);
}

void Watkins::cut_into_segments(int row) {
  segments_.clear();
  for (std::size_t k = 0; k + 1 < active_.size(); k += 2) {
    Segment s{};
    s.left = cross(active_[k]->edge, row), s.right = cross(active_[k + 1]->edge, row);
    s.first = static_cast<int>(ceil_div(s.left.x, s.left.dy));
    s.end = static_cast<int>(ceil_div(s.right.x, s.right.dy));
    if (s.first >= s.end) continue;
    s.polygon = active_[k]->polygon;
    const std::int64_t width = s.right.x * s.left.dy - s.left.x * s.right.dy;
    const Int128 difference = Int128{s.right.value[k_z]} * s.left.dy - Int128{s.left.value[k_z]} * s.right.dy;
    s.z_first = Int128{s.left.value[k_z]} * width + difference * (s.first * s.left.dy - s.left.x);
    s.z_step = difference * s.left.dy;
    s.denominator = s.left.dy * width;
    segments_.push_back(s);
  }
  std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) {
    return std::tuple(a.first, a.polygon) < std::tuple(b.first, b.polygon);
  });
  if constexpr (k_mutant == 56) {
    // 56: the list is emptied per left edge and not per polygon: of segments that begin together none goes
    // before the last.
    for (std::size_t from = 0, to = 0; from < segments_.size(); from = to) {
      int end = 0;
      for (to = from; to < segments_.size() && segments_[to].first == segments_[from].first; ++to) {
        end = std::max(end, segments_[to].end);
      }
      for (std::size_t k = from; k < to; ++k) segments_[k].end = end;
    }
  }
}

std::size_t Watkins::nearest_at(int column) const {
  if constexpr (k_mutant == 55) {
    // 55: what was visible here on the row below still is, and nobody checks.
    const auto last = std::find_if(last_spans_.begin(), last_spans_.end(),
                                   [&](const SampleSpan& span) { return column < span.end; });
    for (const std::size_t k : met_) {
      if (last != last_spans_.end() && segments_[k].polygon == last->polygon) return k;
    }
  }
  return *std::min_element(met_.begin(), met_.end(), [&](std::size_t a, std::size_t b) {
    return in_front(segments_[a], segments_[b], column);
  });
}

void Watkins::find_sample_spans(int row) {
  met_.clear();
  last_spans_.swap(spans_);
  spans_.clear();
  std::size_t next = 0;  // the first segment not met yet
  int column = 0;
  const auto ended = [&](std::size_t k) { return segments_[k].end <= column; };
  for (;;) {
    met_.erase(std::remove_if(met_.begin(), met_.end(), ended), met_.end());
    for (; next < segments_.size() && segments_[next].first <= column; ++next) met_.push_back(next);
    if (met_.empty()) {
      if (next == segments_.size()) return;
      column = segments_[next].first;
      spans_.push_back({column, UINT32_MAX});
      continue;
    }
    const std::size_t winner = nearest_at(column);
    const Segment& visible = segments_[winner];
    int end = visible.end;
    // 54: cuts a span where a segment begins or ends, not where two of them cross.
    const auto cut = [&](const Segment& s, int from) {
      return k_mutant == 54 ? end : cut_by(s, visible, from, end);
    };
    for (const std::size_t k : met_) {
      if (k != winner) end = cut(segments_[k], column);
    }
    while (next < segments_.size() && segments_[next].first < end) {
      const Segment& s = segments_[next];
      if (in_front(s, visible, s.first)) {
        end = s.first;
      } else {
        met_.push_back(next++);
        end = cut(s, s.first);
      }
    }
    paint(row, visible, column, end);
    spans_.push_back({end, visible.polygon});
    column = end;
  }
}

void Watkins::paint(int row, const Segment& segment, int from, int end) {
  Shade shade(segment.left, segment.right, first_corners_[segment.polygon], from);
  for (int x = from; x < end; ++x, shade.next()) canvas_.set_color(x, row, shade.color());
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host*) {
  return Entry<Watkins>::table("Watkins' scan-line algorithm, for testing the tests", 0);
}
