// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/shrink.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace farop::conformance {
namespace {

class Shrinker {
 public:
  Shrinker(Drawing drawing, const std::function<bool(const Drawing&)>& fails, const ShrinkBudget& budget)
      : best_(std::move(drawing)), fails_(fails), budget_(budget) {}

  Drawing run() {
    for (bool smaller = true; smaller && !exhausted();) {
      smaller = drop_polygons();
      smaller |= drop_corners();
      smaller |= move_to_origin();
      smaller |= halve();
      smaller |= simplify();
      smaller |= shrink_frame();
    }
    return best_;
  }
  int renders() const { return renders_; }

 private:
  bool exhausted() const {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun_;
    // On a busy machine a few renders may take that long: some are made in any case.
    return renders_ >= budget_.renders || spent.count() > 4 * budget_.seconds ||
           (spent.count() > budget_.seconds && renders_ >= budget_.renders / 8);
  }
  bool accept(const Drawing& candidate) {
    if (exhausted()) return false;
    ++renders_;
    if (!fails_(candidate)) return false;
    best_ = candidate;
    return true;
  }

  bool drop_polygons() {
    bool any = false;
    for (std::size_t part = best_.polygons.size() / 2; part >= 1; part /= 2) {
      for (std::size_t at = 0; at < best_.polygons.size() && best_.polygons.size() > 1;) {
        Drawing next = best_;
        const std::size_t count = std::min(part, next.polygons.size() - at);
        if (count == next.polygons.size()) break;
        const auto first = next.polygons.begin() + static_cast<std::ptrdiff_t>(at);
        next.polygons.erase(first, first + static_cast<std::ptrdiff_t>(count));
        if (accept(next)) {
          any = true;
        } else {
          at += part;
        }
        if (exhausted()) return any;
      }
    }
    return any;
  }

  bool drop_corners() {
    bool any = false;
    for (std::size_t p = 0; p < best_.polygons.size(); ++p) {
      for (std::size_t part = std::max<std::size_t>(1, best_.polygons[p].size() / 2); part >= 1; part /= 2) {
        for (std::size_t at = 0;
             at + part <= best_.polygons[p].size() && best_.polygons[p].size() >= part + 3;) {
          Drawing next = best_;
          TestPolygon& polygon = next.polygons[p];
          const auto first = polygon.begin() + static_cast<std::ptrdiff_t>(at);
          polygon.erase(first, first + static_cast<std::ptrdiff_t>(part));
          if (accept(next)) {
            any = true;
          } else {
            at += part;
          }
          if (exhausted()) return any;
        }
      }
    }
    return any;
  }

  bool move_to_origin() {
    int left = INT32_MAX, bottom = INT32_MAX;
    for (const TestPolygon& polygon : best_.polygons) {
      for (const ScreenVertex& v : polygon) left = std::min(left, v.x), bottom = std::min(bottom, v.y);
    }
    // A column and a row stay free, so that what is drawn too much can be seen.
    const int dx = std::max(0, left - 1), dy = std::max(0, bottom - 1);
    if (best_.polygons.empty() || (dx == 0 && dy == 0)) return false;
    Drawing next = best_;
    for (TestPolygon& polygon : next.polygons) {
      for (ScreenVertex& v : polygon) v.x -= dx, v.y -= dy;
    }
    return accept(next);
  }

  bool halve() {
    Drawing next = best_;
    bool changed = false;
    for (TestPolygon& polygon : next.polygons) {
      for (ScreenVertex& v : polygon) {
        changed = changed || v.x > 4 || v.y > 4;
        v.x /= 2, v.y /= 2;
      }
    }
    return changed && accept(next);
  }

  bool shrink_frame() {
    Drawing next = best_;
    int right = 0, top = 0;
    for (const TestPolygon& polygon : best_.polygons) {
      for (const ScreenVertex& v : polygon) right = std::max(right, v.x), top = std::max(top, v.y);
    }
    next.frame.x = std::min(next.frame.x, right + 3), next.frame.y = std::min(next.frame.y, top + 3);
    const bool changed = next.frame.x != best_.frame.x || next.frame.y != best_.frame.y;
    return changed && accept(next);
  }

  bool simplify() {
    bool any = false;
    for (std::size_t p = 0; p < best_.polygons.size(); ++p) {
      const ScreenVertex first = best_.polygons[p].front();
      Drawing next = best_;
      bool bent = false, colored = false;
      for (ScreenVertex& v : next.polygons[p]) bent = bent || v.z != first.z, v.z = first.z;
      if (bent && accept(next)) any = true;
      next = best_;
      for (ScreenVertex& v : next.polygons[p]) {
        colored = colored || v.r != first.r || v.g != first.g || v.b != first.b;
        v.r = first.r, v.g = first.g, v.b = first.b;
      }
      if (colored && accept(next)) any = true;
    }
    return any;
  }

  Drawing best_;
  const std::function<bool(const Drawing&)>& fails_;
  const ShrinkBudget& budget_;
  int renders_ = 0;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

}  // namespace

Drawing shrunk(Drawing drawing, const std::function<bool(const Drawing&)>& fails, const ShrinkBudget& budget,
               int& renders) {
  Shrinker shrinker(std::move(drawing), fails, budget);
  Drawing best = shrinker.run();
  renders = shrinker.renders();
  return best;
}

}  // namespace farop::conformance
