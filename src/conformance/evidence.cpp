// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

using Model = std::function<Bitmap(std::span<const ScreenVertex>, const Window&)>;

/// Part of a window around one of several pieces: thousands of them may share a large window.
Window part_of(const Window& all, std::span<const ScreenVertex> piece) {
  const Window w = bounds(piece, {32767, 32767, 2, 2}, 2);
  return {std::max(all.x0, w.x0), std::max(all.y0, w.y0),
          std::max(std::max(all.x0, w.x0), std::min(all.x1, w.x1)),
          std::max(std::max(all.y0, w.y0), std::min(all.y1, w.y1))};
}

Bitmap predicted(const Evidence& e, const Model& model) {
  if (e.polygons.size() == 1) return model(e.polygons.front(), e.got.window);
  Bitmap all(e.got.window);
  for (const TestPolygon& polygon : e.polygons) {
    const Window w = part_of(e.got.window, polygon);
    const Bitmap one = model(polygon, w);
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x) {
        if (one.at[w.index(x, y)] != 0) all.set(x, y, 1);
      }
    }
  }
  return all;
}

struct Score {
  std::uint64_t explained = 0, unexplained = 0, invented = 0;
  bool exact() const { return unexplained == 0 && invented == 0; }
  double share() const {
    const double all = static_cast<double>(explained + unexplained + invented);
    return all == 0 ? 0 : static_cast<double>(explained) / all;
  }
};

constexpr double k_enough_share = 0.95;

/// How well a model explains what differs from the required rule, which are `all_wrong` samples. Incomplete
/// for one that cannot reach k_enough_share any more.
Score score(const std::vector<Evidence>& evidence, const std::vector<Bitmap>& required,
            std::uint64_t all_wrong, const Model& model) {
  Score total;
  const double hopeless = static_cast<double>(all_wrong) * (1 / k_enough_share - 1);
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (static_cast<double>(total.unexplained + total.invented) > hopeless) break;
    const Evidence& e = evidence[i];
    const Bitmap guess = predicted(e, model);
    for (std::size_t s = 0; s < guess.at.size(); ++s) {
      const bool wrong = e.got.at[s] != required[i].at[s], says_wrong = guess.at[s] != required[i].at[s];
      if (wrong && says_wrong) ++total.explained;
      if (wrong && !says_wrong) ++total.unexplained;
      if (!wrong && says_wrong) ++total.invented;
    }
    total.unexplained += e.far_away;  // far outside its polygon: no rule does that
  }
  return total;
}

const char* k_rule_hint = "left and bottom edges belong to the polygon, right and top edges do not";

CoverageCause cause_of_rule(FillRule rule) {
  CoverageCause cause;
  cause.detail = rule_name(rule);
  if (is_consistent(rule)) {
    cause.verdict = "fill.rule", cause.consistent = true;
    cause.rule = static_cast<ConsistentRule>(rule);
    cause.message =
        fmt::format("it follows the fill rule {}, consistently, where lb is asked for", cause.detail);
    cause.hint = k_rule_hint;
    return cause;
  }
  switch (rule) {
    case FillRule::open:
      cause.verdict = "fill.neither-end";
      cause.message = "no sample on an edge is drawn: neighbours leave a gap";
      cause.hint = "begin at the first pixel not left of the left crossing (x >= xL)";
      break;
    case FillRule::trunc:
    case FillRule::round_less:
      cause.verdict = "fill.truncated";
      cause.message = fmt::format("everything sits {} too far left",
                                  rule == FillRule::trunc ? "up to a pixel" : "half a pixel");
      cause.hint = "both ends of a span need ceil(); a cast to int truncates";
      break;
    case FillRule::lb_min:
      cause.verdict = "fill.min-vertex";
      cause.message = "the lowest tip of a V is drawn: at the centre of a fan it is drawn twice";
      cause.hint =
          "the tip belongs to the polygon only if the span there is not empty: stop before the right "
          "crossing";
      break;
    case FillRule::half_centre:
      cause.verdict = "fill.half-pixel";
      cause.message = "the pixel's middle is tested at +1/2";
      cause.hint = "here pixel centres are the integers";
      break;
    default:
      cause.verdict = "fill.both-ends";
      cause.message =
          fmt::format("both ends of a span are drawn (rule {}): neighbours overlap", cause.detail);
      cause.hint = "stop before the right crossing (x < xR)";
  }
  return cause;
}

bool is_convex(const TestPolygon& polygon) {
  int sides = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return Point{polygon[k % polygon.size()].x, polygon[k % polygon.size()].y};
    };
    const std::int64_t t = turn(at(i), at(i + 1), at(i + 2));
    sides |= t > 0 ? 1 : t < 0 ? 2 : 0;
  }
  return sides == 1 || sides == 2;
}

/// Two edges, neither of them horizontal, share more than a point: a bridge, a spike, a polygon without area.
bool walks_an_edge_twice(const TestPolygon& polygon) {
  // By line: direction with dy > 0, and the line's distance from the origin, times its length.
  std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, std::vector<std::pair<int, int>>> rows;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.y == b.y) continue;
    const ScreenVertex &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    const std::int64_t steps = std::gcd(high.x - low.x, high.y - low.y);
    const std::int64_t dx = (high.x - low.x) / steps, dy = (high.y - low.y) / steps;
    rows[{dx, dy, dx * low.y - dy * low.x}].emplace_back(low.y, high.y);
  }
  return std::ranges::any_of(rows, [](auto& line) {
    std::ranges::sort(line.second);
    return std::ranges::adjacent_find(line.second, [](const auto& lower, const auto& upper) {
             return upper.first < lower.second;
           }) != line.second.end();
  });
}

/// Facts about the wrong samples of one piece of evidence.
struct Looks {
  std::uint64_t missing = 0, extra = 0, whole_rows_missing = 0, whole_rows_extra = 0, wrong_rows = 0;
  std::uint64_t on_horizontal_rows = 0, near_edge = 0, outside_bounds = 0;
  bool thin = true, convex = true, clockwise = false;
};

Looks look(const Evidence& e, const Bitmap& required) {
  Looks l;
  const TestPolygon& polygon = e.polygons.front();
  l.convex = e.polygons.size() > 1 || is_convex(polygon);
  l.clockwise = twice_area(polygon) < 0;
  const Window& w = e.got.window;
  const Window box = bounds(polygon, {32767, 32767, 2, 2});
  for (int y = w.y0; y < w.y1; ++y) {
    int wanted = 0, missing = 0, extra = 0;
    const bool horizontal = std::ranges::any_of(e.polygons, [&](const TestPolygon& p) {
      for (std::size_t i = 0; i < p.size(); ++i) {
        if (p[i].y == y && p[(i + 1) % p.size()].y == y) return true;
      }
      return false;
    });
    for (int x = w.x0; x < w.x1; ++x) {
      const bool want = required.get(x, y) != 0, got = e.got.get(x, y) != 0;
      wanted += want ? 1 : 0;
      if (want == got) continue;
      (want ? missing : extra) += 1;
      if (horizontal) ++l.on_horizontal_rows;
      if (!box.contains(x, y)) ++l.outside_bounds;
      // Near where coverage changes in this row: a pixel, and more where a crossing is added up over many
      // rows.
      bool beside = false;
      for (int d = 1; d <= 1 + w.height() / 16 && !beside; ++d)
        beside = (required.get(x - d, y) != 0) != want || (required.get(x + d, y) != 0) != want;
      if (beside) ++l.near_edge;
    }
    l.missing += static_cast<std::uint64_t>(missing), l.extra += static_cast<std::uint64_t>(extra);
    if (wanted >= 2) l.thin = false;
    if (missing + extra == 0) continue;
    ++l.wrong_rows;
    if (missing > 0 && missing == wanted && extra == 0) ++l.whole_rows_missing;
    if (wanted == 0 && extra > 0) ++l.whole_rows_extra;
  }
  return l;
}

CoverageCause cause_by_looks(const std::vector<Evidence>& evidence, const std::vector<Bitmap>& required) {
  Looks sum;
  bool only_concave = true, only_thin = true, only_clockwise = true, only_counter = true, both_ways = false;
  std::uint64_t far = 0, polygons = 0;
  bool only_doubled = true, some_area = false;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (evidence[i].wrong == 0) continue;
    const Looks l = look(evidence[i], required[i]);
    sum.missing += l.missing, sum.extra += l.extra;
    sum.whole_rows_missing += l.whole_rows_missing, sum.whole_rows_extra += l.whole_rows_extra;
    sum.wrong_rows += l.wrong_rows, sum.on_horizontal_rows += l.on_horizontal_rows;
    sum.near_edge += l.near_edge, sum.outside_bounds += l.outside_bounds;
    only_concave = only_concave && !l.convex;
    only_thin = only_thin && l.thin;
    ++polygons;
    (l.clockwise ? only_counter : only_clockwise) = false;
    // Only there everything comes in both directions.
    both_ways = both_ways || evidence[i].name == "tri4" || evidence[i].name == "quad4";
    far += evidence[i].far_away;
    only_doubled = only_doubled && std::ranges::any_of(evidence[i].polygons, walks_an_edge_twice);
    some_area = some_area ||
                std::ranges::any_of(evidence[i].polygons, [](const auto& p) { return twice_area(p) != 0; });
  }
  const std::uint64_t in_windows = sum.missing + sum.extra;
  const auto most = [](std::uint64_t part, std::uint64_t all) { return all > 0 && 100 * part >= 95 * all; };
  CoverageCause cause;
  const auto say = [&](const char* verdict, std::string message, const char* hint) {
    cause.verdict = verdict, cause.message = std::move(message), cause.hint = hint;
    return cause;
  };
  if (both_ways && polygons > 20 && (only_clockwise || only_counter)) {
    return say("cov.order",
               fmt::format("only polygons that run {} are wrong",
                           only_clockwise ? "clockwise" : "counter-clockwise"),
               "the same polygon, listed the other way round, must give the same picture");
  }
  if (most(sum.on_horizontal_rows, in_windows) && far == 0)
    return say("cov.horizontal", "only rows with horizontal edges are wrong",
               "horizontal edges must not be counted: they are drawn by their neighbours");
  if (only_thin)
    return say("cov.sliver", "only polygons thinner than two pixels are wrong",
               "draw whatever samples a thin polygon covers");
  if (most(sum.whole_rows_missing, sum.wrong_rows))
    return say("cov.row-missing", "whole rows are missing", "an edge lives for ymin <= y < ymax");
  if (most(sum.whole_rows_extra, sum.wrong_rows))
    return say("cov.row-extra", "whole rows are too many",
               "the top row does not belong: an edge lives for ymin <= y < ymax");
  const bool leaks = 20 * far > in_windows || 10 * sum.outside_bounds > in_windows;
  // Polygons without area alone may as well be drawn as lines.
  if (only_doubled && some_area)
    return say("cov.leak",
               "only polygons that walk an edge twice are wrong: the count of crossings is wrong there",
               "the outline there and back adds two crossings to every row: keep both, or drop both");
  if (leaks)
    return say("cov.leak", "rows are filled beyond the polygon: the count of crossings is wrong there",
               "a vertex must add an even number of crossings to its row: give every edge the rows ymin <= y "
               "< ymax");
  if (only_concave) {
    return say("cov.concave", "convex polygons are right, concave ones are wrong",
               "sort all crossings of a row and fill between the first and second, the third and fourth ...");
  }
  if (most(sum.near_edge, in_windows))
    return say("cov.off-by-one", "spans begin or end a pixel early or late at some edges",
               "the crossing has to be exact: keep it as a fraction, or with enough bits");
  if (sum.missing >= sum.extra)
    return say("cov.missing", "samples are missing", "the smallest example is below");
  return say("cov.extra", "there are samples too many", "the smallest example is below");
}

}  // namespace

std::uint64_t wrong_samples(const Evidence& evidence) {
  const Bitmap required =
      predicted(evidence, [](auto p, const Window& w) { return rule_coverage(p, FillRule::lb, w); });
  std::uint64_t wrong = evidence.far_away;
  for (std::size_t s = 0; s < required.at.size(); ++s) wrong += required.at[s] != evidence.got.at[s] ? 1 : 0;
  return wrong;
}

CoverageCause name_coverage(std::vector<Evidence>& evidence) {
  const Model lb = [](auto p, const Window& w) { return rule_coverage(p, FillRule::lb, w); };
  std::vector<Bitmap> required;
  std::uint64_t wrong = 0;
  for (Evidence& e : evidence) {
    required.push_back(predicted(e, lb));
    e.wrong = e.far_away;
    for (std::size_t s = 0; s < e.got.at.size(); ++s) e.wrong += e.got.at[s] != required.back().at[s] ? 1 : 0;
    wrong += e.wrong;
  }
  CoverageCause cause;
  if (wrong == 0) return cause;
  std::optional<CoverageCause> best;
  double best_share = k_enough_share;
  const auto consider = [&](const CoverageCause& candidate, const Model& model) {
    const Score s = score(evidence, required, wrong, model);
    if (s.share() < best_share || (best && s.share() <= best_share)) return;
    best = candidate, best->explained = s.explained, best_share = s.share();
  };
  for (int r = 1; r < k_fill_rules; ++r) {
    const FillRule rule{static_cast<std::uint8_t>(r)};
    consider(cause_of_rule(rule), [rule](auto p, const Window& w) { return rule_coverage(p, rule, w); });
  }
  const bool exact_rule = best && best_share == 1;
  for (int s = 0; s < k_slips && !exact_rule; ++s) {
    const Slip slip{static_cast<std::uint8_t>(s)};
    const SlipFacts& facts = slip_facts(slip);
    CoverageCause candidate;
    candidate.verdict = facts.verdict, candidate.message = facts.sentence, candidate.hint = facts.hint;
    for (const bool open_end : {false, true}) {
      consider(candidate,
               [slip, open_end](auto p, const Window& w) { return slip_coverage(p, slip, open_end, w); });
    }
  }
  cause = best ? *best : cause_by_looks(evidence, required);
  cause.exact = best && best_share == 1;
  if (!cause.exact) cause.consistent = false;
  cause.wrong = wrong;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (evidence[i].wrong > 0) cause.witnesses.push_back(i);
  }
  const auto effort = [&](std::size_t i) {
    const Window& w = evidence[i].got.window;
    return std::tuple(evidence[i].polygons.front().size(), w.samples(), evidence[i].wrong);
  };
  std::ranges::stable_sort(cause.witnesses,
                           [&](std::size_t a, std::size_t b) { return effort(a) < effort(b); });
  return cause;
}

std::vector<FingerprintRow> fingerprint(const std::vector<Evidence>& evidence) {
  std::vector<FingerprintRow> rows = {{"left", 0, 0},    {"right", 0, 0},   {"bottom", 0, 0}, {"top", 0, 0},
                                      {"minimum", 0, 0}, {"maximum", 0, 0}, {"through", 0, 0}};
  const auto count = [&](std::size_t row, const Evidence& e, const ScreenVertex& at) {
    ++rows[row].cases;
    rows[row].owned += e.got.get(at.x, at.y) != 0 ? 1 : 0;
  };
  for (const Evidence& e : evidence) {
    // Whatever has spikes or repeated corners has sides of both kinds at one place.
    if (e.polygons.size() != 1 || (e.name != "tri4" && e.name != "quad4" && e.name != "tri-random")) continue;
    const TestPolygon p = turned_left(e.polygons.front());
    if (!is_convex(p)) continue;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const ScreenVertex &before = p[(i + p.size() - 1) % p.size()], &a = p[i], &b = p[(i + 1) % p.size()];
      // The inside lies to the left of an edge: one that falls is a left edge.
      const int steps = std::gcd(b.x - a.x, b.y - a.y);
      for (int k = 1; k < steps; ++k) {
        const ScreenVertex at{
            a.x + k * ((b.x - a.x) / steps), a.y + k * ((b.y - a.y) / steps), 0, 0, 0, 0, 0};
        count(b.y < a.y ? 0 : b.y > a.y ? 1 : b.x > a.x ? 2 : 3, e, at);
      }
      if (before.y > a.y && b.y > a.y) count(4, e, a);
      if (before.y < a.y && b.y < a.y) count(5, e, a);
      if ((before.y < a.y && a.y < b.y) || (before.y > a.y && a.y > b.y)) count(6, e, a);
    }
  }
  return rows;
}

}  // namespace farop::conformance
