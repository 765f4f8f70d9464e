// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "geometry/predicates.h"

// Why the ear test is right, also for weakly simple polygons.
//
// Such a ring is a simple polygon squeezed until some of its vertices and edges touch. An ear may be cut if
// it is one of the simple polygon, before squeezing. Most of the time the squeezed coordinates tell. Where
// they do not, namely where another stretch of the ring runs along the ear's two edges, the order of the two
// stretches tells: they may not cross, so whichever is on the left where they part is on the left all along
// (runs_left()). For this the ring must not turn back upon itself, which is why repeated vertices and the
// tips of antennas go first: they enclose nothing. A ring without them and with more than three vertices
// always has an ear of positive area that passes the test, so simple polygons never get a triangle without
// area and nothing has to be guessed.

namespace farop {
namespace {

using Index = std::uint32_t;
constexpr Index k_none = std::numeric_limits<Index>::max();

/// Whether c, collinear with a and b, lies between them (and on neither).
bool is_between(const V2d& a, const V2d& c, const V2d& b) {
  const int axis = std::abs(a.x - b.x) >= std::abs(a.y - b.y) ? 0 : 1;
  return (a[axis] < c[axis] && c[axis] < b[axis]) || (b[axis] < c[axis] && c[axis] < a[axis]);
}

/// How much to forgive in further attempts, as a fraction of the largest coordinate. Polygons come from
/// exact input first of all, and are taken at their word. What was weakly simple before rounding (a concave
/// polygon that is cut by two planes, say: its bridge edges lie upon each other only roughly) may be left
/// without ears; then points that nearly coincide are taken for one, and points near a line for points on
/// it, which restores what the rounding broke.
constexpr std::array k_forgiveness{0x1p-42, 0x1p-32, 0x1p-22};

/// The vertices that are not cut yet: projected to a plane, counter-clockwise, linked in a ring.
class Ring {
 public:
  /// `forgiveness`: 0 or a power of two.
  void reset(std::span<const V3d> corners, const V3d& normal, double forgiveness);

  Index count() const { return count_; }
  Index size() const { return static_cast<Index>(points_.size()); }
  std::span<const V2d> points() const { return points_; }
  const V2d& point(Index v) const { return points_[v]; }
  Index next(Index v) const { return next_[v]; }
  Index previous(Index v) const { return previous_[v]; }
  bool is_cut(Index v) const { return next_[v] == v; }
  /// The lowest vertex left.
  Index first() const { return first_; }

  /// orientation(), exact unless something is to be forgiven: then 0 too when the three are collinear but
  /// for that.
  int side(const V2d& a, const V2d& b, const V2d& c) const;
  double tolerance() const { return tolerance_; }
  bool is_forgiving() const { return tolerance_ > 0; }

  int turn(Index v) const { return side(point(previous(v)), point(v), point(next(v))); }
  /// Whether the ring turns back upon itself at v, or stands still.
  bool is_needle(Index v) const {
    const V2d& p = point(previous(v));
    const V2d& n = point(next(v));
    return p == point(v) || point(v) == n || (turn(v) == 0 && !is_between(p, point(v), n));
  }
  /// Square of the distance Previous-Next in space, in a unit of the polygon's own.
  double ear_size(Index v) const {
    return (corners_[previous(v)] * size_scale_ - corners_[next(v)] * size_scale_).length2();
  }
  /// Takes v out and hands over its triangle.
  CornerTriangle cut(Index v);
  CornerTriangle last_triangle() const { return {first_, next(first_), previous(first_)}; }

 private:
  std::span<const V3d> corners_;
  double size_scale_ = 1;
  double tolerance_ = 0;
  std::vector<V2d> points_;
  std::vector<Index> next_, previous_;
  Index count_ = 0;
  Index first_ = 0;
};

void Ring::reset(std::span<const V3d> corners, const V3d& normal, double forgiveness) {
  corners_ = corners;
  count_ = static_cast<Index>(corners.size());
  first_ = 0;

  // A power of two, so that scaling rounds nothing, and squares of huge or tiny lengths stay in range.
  double reach = 0;
  for (const V3d& p : corners) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  size_scale_ = std::isnormal(reach) ? std::scalbn(1.0, std::clamp(-std::ilogb(reach), -1000, 1000)) : 1.0;

  const V3d extent(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
  unsigned dropped = extent.y > extent.x ? 1 : 0;
  if (extent.z > extent[static_cast<int>(dropped)]) dropped = 2;
  const int u = static_cast<int>((dropped + 1) % 3);
  const int v = static_cast<int>((dropped + 2) % 3);
  points_.clear();
  for (const V3d& p : corners) points_.emplace_back(p[u], p[v]);
  if (area_sign(points_) < 0) {
    for (V2d& p : points_) std::swap(p.x, p.y);  // a mirror image turns the other way
  }

  const double grid = forgiveness / size_scale_;
  tolerance_ = 4 * grid;  // rounding to the grid takes three points off a line by not much more than one unit
  if (grid > 0) {
    for (V2d& p : points_) p = {std::round(p.x / grid) * grid, std::round(p.y / grid) * grid};
  }

  next_.resize(count_);
  previous_.resize(count_);
  for (Index i = 0; i < count_; ++i) {
    next_[i] = i + 1 < count_ ? i + 1 : 0;
    previous_[i] = i > 0 ? i - 1 : count_ - 1;
  }
}

int Ring::side(const V2d& a, const V2d& b, const V2d& c) const {
  if (tolerance_ > 0) {
    const V2d ab = b - a;
    const V2d ac = c - a;
    const double longest = std::sqrt(std::max({ab.length2(), ac.length2(), (c - b).length2()}));
    if (std::abs(ab.cross(ac)) <= tolerance_ * longest) return 0;  // the triangle is not wider than that
  }
  return orientation(a, b, c);
}

CornerTriangle Ring::cut(Index v) {
  const Index p = previous(v);
  const Index n = next(v);
  next_[p] = n;
  previous_[n] = p;
  next_[v] = previous_[v] = v;
  --count_;
  while (is_cut(first_)) ++first_;
  return {p, v, n};
}

/// Whether a step from b to p goes to the left of the path a, b, c.
bool goes_left(const Ring& ring, const V2d& a, const V2d& b, const V2d& c, const V2d& p) {
  const bool left_of_first = ring.side(a, b, p) > 0;
  const bool left_of_second = ring.side(b, c, p) > 0;
  return ring.side(a, b, c) >= 0 ? left_of_first && left_of_second : left_of_first || left_of_second;
}

/// Two stretches of the ring head from `start` for one direction: a along the ring to vertex a, b along or
/// against the ring to vertex b. Whether b is to the left of a, as told by where they part.
bool runs_left(const Ring& ring, V2d start, Index a, Index b, bool b_along_ring) {
  const auto after_b = [&](Index v) { return b_along_ring ? ring.next(v) : ring.previous(v); };
  for (Index steps = 2 * ring.count(); steps > 0; --steps) {  // rings that cross themselves may never part
    const V2d& point_a = ring.point(a);
    const V2d& point_b = ring.point(b);
    const V2d& next_a = ring.point(ring.next(a));
    const V2d& next_b = ring.point(after_b(b));
    if (point_a == point_b) {
      const bool part = ring.side(point_a, next_a, next_b) != 0 || is_between(next_a, point_a, next_b);
      if (part) return goes_left(ring, start, point_a, next_a, next_b);
      start = point_a;
      a = ring.next(a);
      b = after_b(b);
    } else if (is_between(start, point_a, point_b)) {
      const int side = ring.side(start, point_b, next_a);
      if (side != 0) return side < 0;
      start = point_a;
      a = ring.next(a);
    } else {
      const int side = ring.side(start, point_a, next_b);
      if (side != 0) return side > 0;
      start = point_b;
      b = after_b(b);
    }
  }
  return false;
}

/// What another vertex does to an ear, from harmless to worst.
enum class Contact : std::uint8_t {
  none,
  touches,   ///< lies on the line Previous-Next, between the two
  blocks,    ///< lies on the ear's border and belongs to its inside
  is_inside  ///< strictly inside
};

/// Whether the ring at v, which lies on the edge from one vertex of the ear to the next one, is on the
/// ear's side.
bool on_left_of_edge(const Ring& ring, Index edge_start, Index edge_end, Index v) {
  const V2d& from = ring.point(edge_start);
  const V2d& to = ring.point(edge_end);
  const V2d& before = ring.point(ring.previous(v));
  const V2d& after = ring.point(ring.next(v));
  const int side_before = ring.side(from, to, before);
  const int side_after = ring.side(from, to, after);
  if (side_before > 0 || side_after > 0) return true;
  if (side_before < 0 || side_after < 0) return false;
  const bool along = !is_between(after, ring.point(v), to);
  return runs_left(ring, ring.point(v), edge_end, along ? ring.next(v) : ring.previous(v), along);
}

/// Whether the ring at v, which coincides with the ear's tip, is on the ear's side.
bool on_left_of_tip(const Ring& ring, Index tip, Index v) {
  const V2d& p = ring.point(ring.previous(tip));
  const V2d& c = ring.point(tip);
  const V2d& n = ring.point(ring.next(tip));
  const V2d& before = ring.point(ring.previous(v));
  const V2d& after = ring.point(ring.next(v));
  if (goes_left(ring, p, c, n, before) || goes_left(ring, p, c, n, after)) return true;
  const auto along_first = [&](const V2d& q) { return ring.side(p, c, q) == 0 && !is_between(p, c, q); };
  const auto along_second = [&](const V2d& q) { return ring.side(c, n, q) == 0 && !is_between(q, c, n); };
  if (along_first(before) && along_second(after)) {
    return runs_left(ring, c, ring.next(tip), ring.next(v), true);
  }
  if (along_second(before) && along_first(after)) {
    return runs_left(ring, c, ring.next(tip), ring.previous(v), false);
  }
  return false;
}

/// What v, not one of the ear's own vertices, does to the ear at `tip`, which turns left. Only vertices
/// that do not turn left need to be asked: whatever enters an ear turns right at its deepest point, or runs
/// straight.
Contact contact(const Ring& ring, Index tip, Index v) {
  const V2d& p = ring.point(ring.previous(tip));
  const V2d& c = ring.point(tip);
  const V2d& n = ring.point(ring.next(tip));
  const V2d& q = ring.point(v);
  const int side_first = ring.side(p, c, q);
  if (side_first < 0) return Contact::none;
  const int side_second = ring.side(c, n, q);
  if (side_second < 0) return Contact::none;
  const int side_cut = ring.side(n, p, q);
  if (side_cut < 0) return Contact::none;
  if (side_first > 0 && side_second > 0 && side_cut > 0) return Contact::is_inside;
  // Here the ear's new edge could be bent around v. If the ring enters the ear from v, it shows farther in.
  if (q == p || q == n) return Contact::none;
  if (side_cut == 0) return Contact::touches;
  bool on_left = false;
  if (q == c) {
    on_left = on_left_of_tip(ring, tip, v);
  } else if (side_first == 0) {
    on_left = on_left_of_edge(ring, ring.previous(tip), tip, v);
  } else {
    on_left = on_left_of_edge(ring, tip, ring.next(tip), v);
  }
  return on_left ? Contact::blocks : Contact::none;
}

/// What to do with a vertex, from best to worst.
enum class Grade : std::uint8_t {
  needle,      ///< repeats a neighbour or is the tip of an antenna: goes at once
  ear,         ///< contains no other vertex
  touching,    ///< an ear, but vertices lie on the line Previous-Next: would leave a triangle without area if
               ///< cut early
  blocked,     ///< turns left but contains a vertex
  not_an_ear,  ///< runs straight or turns right
};

bool has_infinite_corner(std::span<const V3d> corners) {
  return !std::ranges::all_of(
      corners, [](const V3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

/// Predicates need numbers: a polygon with an infinite corner is cut into a fan.
void fan(std::size_t corners, std::vector<CornerTriangle>& triangles) {
  for (Index i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
}

Grade grade(const Ring& ring, Index v) {
  if (ring.is_needle(v)) return Grade::needle;
  if (ring.turn(v) <= 0) return Grade::not_an_ear;
  Contact worst = Contact::none;
  for (Index other = ring.next(ring.next(v)); other != ring.previous(v); other = ring.next(other)) {
    if (ring.turn(other) <= 0) worst = std::max(worst, contact(ring, v, other));
  }
  if (worst >= Contact::blocks) return Grade::blocked;
  return worst == Contact::touches ? Grade::touching : Grade::ear;
}

/// Whether everything that was cut was an ear. Forgiving attempts give up at the first one that is none.
bool cut_all(Ring& ring, std::vector<CornerTriangle>& triangles) {
  bool all_ears = true;
  while (ring.count() > 3) {
    Index best = ring.first();
    std::pair best_key{Grade::not_an_ear, std::numeric_limits<double>::infinity()};
    Index v = ring.first();
    do {  // from the lowest vertex on, so that of equals the first one stays
      const Grade g = grade(ring, v);
      const bool has_size = g != Grade::needle && g != Grade::not_an_ear;
      const std::pair key{g, has_size ? ring.ear_size(v) : 0.0};
      if (key < best_key) {
        best = v;
        best_key = key;
      }
      v = ring.next(v);
    } while (v != ring.first());
    if (best_key.first > Grade::touching) {
      if (ring.is_forgiving()) return false;
      all_ears = false;
    }
    triangles.push_back(ring.cut(best));
  }
  triangles.push_back(ring.last_triangle());
  return all_ears && ring.turn(ring.first()) >= 0;
}

/// The vertices that may block ears, in a k-d tree: balanced whatever their distribution, and what is empty
/// by now costs nothing (a grid has many empty cells to cross for the long thin triangles that ear clipping
/// comes to at last).
class BlockerTree {
 public:
  /// A tree with room for all the points, but none in it.
  void reset(std::span<const V2d> points);
  void insert(Index v) { set_present(v, true); }
  void remove(Index v) { set_present(v, false); }

  /// Calls `visit(vertex)` for every vertex in or near a counter-clockwise triangle until it answers false.
  template <typename Visitor>
  void visit_near(const std::array<V2d, 3>& triangle, double tolerance, const Visitor& visit) const;

 private:
  static constexpr Index k_leaf_size = 8;
  struct Node {
    V2d low, high;     ///< bounds of all its points, present or not
    Index begin, end;  ///< range in vertices_
    Index present;     ///< how many of them are in the tree
    bool is_leaf;      ///< else the children of node i are 2i + 1 and 2i + 2
  };

  void build(std::span<const V2d> points, std::size_t node, Index begin, Index end);
  void set_present(Index v, bool present);
  /// False only if no point of the node can lie in the triangle.
  static bool may_touch(const Node& node, const std::array<V2d, 3>& triangle, double tolerance);

  std::vector<Node> nodes_;
  std::vector<Index> vertices_;
  std::vector<Index> leaf_of_;
  std::vector<bool> is_present_;
};

void BlockerTree::reset(std::span<const V2d> points) {
  vertices_.resize(points.size());
  std::iota(vertices_.begin(), vertices_.end(), Index{0});
  leaf_of_.resize(points.size());
  is_present_.assign(points.size(), false);
  nodes_.clear();
  build(points, 0, 0, static_cast<Index>(points.size()));
}

void BlockerTree::build(std::span<const V2d> points, std::size_t node, Index begin, Index end) {
  if (node >= nodes_.size()) nodes_.resize(node + 1);
  V2d low = points[vertices_[begin]];
  V2d high = low;
  for (Index i = begin; i < end; ++i) {
    const V2d& p = points[vertices_[i]];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const bool is_leaf = end - begin <= k_leaf_size;
  nodes_[node] = {low, high, begin, end, 0, is_leaf};
  if (is_leaf) {
    for (Index i = begin; i < end; ++i) leaf_of_[vertices_[i]] = static_cast<Index>(node);
    return;
  }
  const int axis = high.x - low.x >= high.y - low.y ? 0 : 1;
  const Index middle = begin + (end - begin) / 2;
  const auto first = vertices_.begin();
  std::nth_element(first + begin, first + middle, first + end,
                   [&](Index a, Index b) { return points[a][axis] < points[b][axis]; });
  build(points, 2 * node + 1, begin, middle);
  build(points, 2 * node + 2, middle, end);
}

void BlockerTree::set_present(Index v, bool present) {
  if (is_present_[v] == present) return;
  is_present_[v] = present;
  for (std::size_t node = leaf_of_[v];; node = (node - 1) / 2) {
    nodes_[node].present += present ? 1 : -1;
    if (node == 0) return;
  }
}

bool BlockerTree::may_touch(const Node& node, const std::array<V2d, 3>& triangle, double tolerance) {
  constexpr double k_rounding = 8 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < 3; ++i) {
    const V2d& a = triangle[i];
    const V2d edge = triangle[(i + 1) % 3] - a;
    // The corner of the node that reaches farthest to the left of the edge; is even that one on its right?
    const V2d corner(edge.y > 0 ? node.low.x : node.high.x, edge.x > 0 ? node.high.y : node.low.y);
    const double left = edge.x * (corner.y - a.y);
    const double right = edge.y * (corner.x - a.x);
    const double slack =
        k_rounding * (std::abs(left) + std::abs(right)) +
        tolerance * (edge.length() + (corner - a).length() + (node.high - node.low).length());
    if (left - right < -slack) return false;
  }
  const auto [low_x, high_x] = std::minmax({triangle[0].x, triangle[1].x, triangle[2].x});
  const auto [low_y, high_y] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
  return node.low.x <= high_x + tolerance && node.high.x >= low_x - tolerance &&
         node.low.y <= high_y + tolerance && node.high.y >= low_y - tolerance;
}

template <typename Visitor>
void BlockerTree::visit_near(const std::array<V2d, 3>& triangle, double tolerance,
                             const Visitor& visit) const {
  std::array<std::size_t, 64> stack;  // the tree is balanced: its depth is below 32
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::size_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (node.present == 0 || !may_touch(node, triangle, tolerance)) continue;
    if (!node.is_leaf) {
      stack[depth++] = 2 * at + 2;
      stack[depth++] = 2 * at + 1;
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i) {
      if (is_present_[vertices_[i]] && !visit(vertices_[i])) return;
    }
  }
}

/// A vertex waiting to be cut. `stamp` tells whether its triangle is still the one that was measured.
struct Candidate {
  double size;
  Index vertex;
  Index stamp;

  friend bool operator>(const Candidate& a, const Candidate& b) {
    return std::pair(a.size, a.vertex) > std::pair(b.size, b.vertex);
  }
};

/// Priority queue that keeps its memory between polygons; the smallest candidate comes first. It holds a
/// candidate only once, however often it is pushed.
class CandidateQueue {
 public:
  void reset(std::size_t vertices) {
    heap_.clear();
    held_stamp_.assign(vertices, k_none);
  }
  bool empty() const { return heap_.empty(); }
  void push(const Candidate& c) {
    if (held_stamp_[c.vertex] == c.stamp) return;
    held_stamp_[c.vertex] = c.stamp;
    heap_.push_back(c);
    std::ranges::push_heap(heap_, std::greater<>());
  }
  Candidate pop() {
    std::ranges::pop_heap(heap_, std::greater<>());
    const Candidate c = heap_.back();
    heap_.pop_back();
    if (held_stamp_[c.vertex] == c.stamp) held_stamp_[c.vertex] = k_none;
    return c;
  }

 private:
  std::vector<Candidate> heap_;
  std::vector<Index> held_stamp_;
};

/// Ear clipping with queues instead of searches. An ear is tested when it comes up as the smallest, not
/// before. One that a vertex stands in the way of waits in that vertex's list of watchers until something
/// happens to the vertex.
class EarClipper {
 public:
  /// Whether everything that was cut was an ear. Forgiving attempts give up at the first one that is none.
  bool run(Ring& ring, std::vector<CornerTriangle>& triangles);

 private:
  /// Where the latest candidate of a vertex is.
  enum class Place : std::uint8_t { nowhere, untested, touching, blocked };
  /// What wakes a watcher: the vertex is cut or begins to turn left; or, besides, one of its edges changes.
  enum class Wake : std::uint8_t { on_removal, on_change };
  struct Watcher {
    Index vertex;
    Index stamp;
    Index next;
    Wake wake;
  };
  static constexpr double k_needle_size = -1;  // before all ears

  void enqueue(Index v);
  void watch(Index watched, const Candidate& waiting, Wake wake);
  void wake_watchers(Index v, bool all);
  void update_neighbor(Index v);
  void cut(Index v, std::vector<CornerTriangle>& triangles);
  /// Tests the ear; if it is not one now, puts it where it has to wait.
  bool is_ear(const Candidate& c, bool accept_touching);
  bool is_current(const Candidate& c, Place place) const {
    return stamp_[c.vertex] == c.stamp && place_[c.vertex] == place;
  }
  Index next_to_cut();

  Ring* ring_ = nullptr;
  BlockerTree blockers_;
  std::vector<bool> turns_left_;
  std::vector<Index> stamp_;
  std::vector<Place> place_;
  std::vector<Index> watchers_;  ///< per vertex: head of its list in watcher_pool_
  std::vector<Watcher> watcher_pool_;
  Index free_watchers_ = k_none;
  CandidateQueue untested_, touching_, blocked_;
  bool all_ears_ = true;
};

void EarClipper::enqueue(Index v) {
  place_[v] = Place::nowhere;
  const bool needle = ring_->is_needle(v);
  if (!needle && !turns_left_[v]) return;
  place_[v] = Place::untested;
  untested_.push({needle ? k_needle_size : ring_->ear_size(v), v, stamp_[v]});
}

void EarClipper::watch(Index watched, const Candidate& waiting, Wake wake) {
  Index at = free_watchers_;
  if (at == k_none) {
    at = static_cast<Index>(watcher_pool_.size());
    watcher_pool_.emplace_back();
  } else {
    free_watchers_ = watcher_pool_[at].next;
  }
  watcher_pool_[at] = {waiting.vertex, waiting.stamp, watchers_[watched], wake};
  watchers_[watched] = at;
}

void EarClipper::wake_watchers(Index v, bool all) {
  Index* link = &watchers_[v];
  while (*link != k_none) {
    const Index at = *link;
    Watcher& w = watcher_pool_[at];
    const bool is_stale = stamp_[w.vertex] != w.stamp;
    if (!is_stale && !all && w.wake == Wake::on_removal) {
      link = &w.next;
      continue;
    }
    if (!is_stale) {
      place_[w.vertex] = Place::untested;
      untested_.push({ring_->ear_size(w.vertex), w.vertex, w.stamp});
    }
    *link = w.next;
    w.next = free_watchers_;
    free_watchers_ = at;
  }
}

void EarClipper::update_neighbor(Index v) {
  const bool turns_left = ring_->turn(v) > 0;
  wake_watchers(v, turns_left && !turns_left_[v]);
  turns_left_[v] = turns_left;
  if (turns_left) {
    blockers_.remove(v);
  } else {
    blockers_.insert(v);
  }
  ++stamp_[v];
  enqueue(v);
}

void EarClipper::cut(Index v, std::vector<CornerTriangle>& triangles) {
  const Index p = ring_->previous(v);
  const Index n = ring_->next(v);
  triangles.push_back(ring_->cut(v));
  blockers_.remove(v);
  ++stamp_[v];
  wake_watchers(v, true);
  update_neighbor(p);
  update_neighbor(n);
}

bool EarClipper::is_ear(const Candidate& c, bool accept_touching) {
  const Index tip = c.vertex;
  const std::array ear{ring_->previous(tip), tip, ring_->next(tip)};
  const std::array triangle{ring_->point(ear[0]), ring_->point(ear[1]), ring_->point(ear[2])};
  Contact worst = Contact::none;
  Index worst_vertex = k_none;
  blockers_.visit_near(triangle, ring_->tolerance(), [&](Index v) {
    if (v == ear[0] || v == ear[2]) return true;
    const Contact found = contact(*ring_, tip, v);
    if (found > worst) {
      worst = found;
      worst_vertex = v;
    }
    return worst < Contact::blocks;
  });
  if (worst == Contact::none || (worst == Contact::touches && accept_touching)) return true;
  if (worst == Contact::touches) {
    place_[tip] = Place::touching;
    touching_.push(c);
  } else {
    place_[tip] = Place::blocked;
    blocked_.push(c);
  }
  watch(worst_vertex, c, worst == Contact::is_inside ? Wake::on_removal : Wake::on_change);
  return false;
}

Index EarClipper::next_to_cut() {
  while (!untested_.empty()) {
    const Candidate c = untested_.pop();
    if (!is_current(c, Place::untested)) continue;
    if (c.size == k_needle_size || is_ear(c, false)) return c.vertex;
  }
  while (!touching_.empty()) {
    const Candidate c = touching_.pop();
    if (is_current(c, Place::touching) && is_ear(c, true)) return c.vertex;
  }
  // Only rings that cross themselves come here: the smallest corner that at least turns the right way.
  all_ears_ = false;
  while (!blocked_.empty()) {
    const Candidate c = blocked_.pop();
    if (is_current(c, Place::blocked)) return c.vertex;
  }
  return ring_->first();
}

bool EarClipper::run(Ring& ring, std::vector<CornerTriangle>& triangles) {
  ring_ = &ring;
  const std::size_t n = ring.size();
  blockers_.reset(ring.points());
  stamp_.assign(n, 0);
  place_.assign(n, Place::nowhere);
  watchers_.assign(n, k_none);
  watcher_pool_.clear();
  free_watchers_ = k_none;
  for (CandidateQueue* queue : {&untested_, &touching_, &blocked_}) queue->reset(n);
  turns_left_.resize(n);
  for (Index v = 0; v < n; ++v) {
    turns_left_[v] = ring.turn(v) > 0;
    if (!turns_left_[v]) blockers_.insert(v);
  }
  for (Index v = 0; v < n; ++v) enqueue(v);
  all_ears_ = true;
  while (ring.count() > 3) {
    const Index v = next_to_cut();
    if (!all_ears_ && ring.is_forgiving()) return false;
    cut(v, triangles);
  }
  triangles.push_back(ring.last_triangle());
  return all_ears_ && ring.turn(ring.first()) >= 0;
}

/// Cuts with as little forgiveness as it takes to find nothing but ears. If none is enough, the polygon
/// crosses itself: what the first attempt cut stands.
template <typename CutAll>
void cut_with_forgiveness(std::span<const V3d> corners, const V3d& normal, Ring& ring,
                          std::vector<CornerTriangle>& attempt, std::vector<CornerTriangle>& triangles,
                          const CutAll& cut_all_of) {
  ring.reset(corners, normal, 0);
  if (cut_all_of(ring, triangles)) return;
  for (const double forgiveness : k_forgiveness) {
    ring.reset(corners, normal, forgiveness);
    attempt.clear();
    if (cut_all_of(ring, attempt)) {
      triangles.swap(attempt);
      return;
    }
  }
}

}  // namespace

namespace reference {

void triangulate(std::span<const V3d> corners, const V3d& normal, std::vector<CornerTriangle>& triangles) {
  triangles.clear();
  if (corners.size() <= 3 || has_infinite_corner(corners)) {
    fan(corners.size(), triangles);
    return;
  }
  Ring ring;
  std::vector<CornerTriangle> attempt;
  cut_with_forgiveness(corners, normal, ring, attempt, triangles, cut_all);
}

}  // namespace reference

struct TriangulateBuffers {
  Ring ring;
  EarClipper clipper;
  std::vector<CornerTriangle> attempt;
};

TriangulateScratch::TriangulateScratch() : buffers_(std::make_unique<TriangulateBuffers>()) {}
TriangulateScratch::~TriangulateScratch() = default;

void triangulate(std::span<const V3d> corners, const V3d& normal, std::vector<CornerTriangle>& triangles,
                 TriangulateScratch& scratch) {
  triangles.clear();
  if (corners.size() <= 3 || has_infinite_corner(corners)) {
    fan(corners.size(), triangles);
    return;
  }
  TriangulateBuffers& buffers = scratch.buffers();
  cut_with_forgiveness(
      corners, normal, buffers.ring, buffers.attempt, triangles,
      [&](Ring& ring, std::vector<CornerTriangle>& out) { return buffers.clipper.run(ring, out); });
}

}  // namespace farop
