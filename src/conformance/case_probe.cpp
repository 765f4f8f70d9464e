// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

/// Every sample of a small frame; in large ones, where a mistake shows at many samples, some.
std::uint64_t most_probes(const Resolution& frame) {
  return frame.x * frame.y <= 128 * 128 ? 4000 : 100;
}

struct Probe {
  int x = 0, y = 0;
  std::uint32_t owner = 0;
  Rational value;
  std::int64_t low = -1, high = 0;  ///< farthest depth known to win, nearest known to lose
};

/// The unit square that covers exactly this sample under the rule in use; where it fits.
std::optional<TestPolygon> probe_square(ConsistentRule rule, const Resolution& frame, int x, int y) {
  const auto r = static_cast<unsigned>(rule) % 4;
  const int x0 = (r & 2) != 0 ? x - 1 : x, y0 = (r & 1) != 0 ? y - 1 : y;
  if (x0 < 0 || y0 < 0 || x0 + 1 >= frame.x || y0 + 1 >= frame.y) return std::nullopt;
  return rectangle(x0, y0, x0 + 1, y0 + 1);
}

/// Draws the scene and one probe per sample at the depths given; true where the probe shows.
std::optional<std::vector<bool>> probes_show(Run& run, const Case& c, Subject& subject, const Drawing& scene,
                                             const std::vector<Probe>& probes,
                                             const std::vector<std::int64_t>& depths, Outcome& out) {
  Drawing drawing = scene;
  for (TestPolygon& p : drawing.polygons) paint(p, {252, 4, 8});
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (depths[i] < 0 || depths[i] >= scene.frame.z) continue;
    TestPolygon square = *probe_square(run.rule, scene.frame, probes[i].x, probes[i].y);
    paint(square, {4, 252, 8});
    set_depth(square, depths[i]);
    drawing.polygons.push_back(std::move(square));
  }
  const auto picture = run.picture_of(c, subject, run.maker.as_given(drawing), out);
  if (!picture) return std::nullopt;
  std::vector<bool> shows;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Color got = pixel_at(*picture, probes[i].x, probes[i].y);
    shows.push_back(depths[i] < 0 || (depths[i] < scene.frame.z && got[1] > 128));
  }
  return shows;
}

/// Samples to be measured: all, or every n-th of large polygons.
std::vector<Probe> probes_of(const Run& run, const Drawing& given, const Expectation& expected) {
  std::uint64_t covered = 0;
  for (int y = 0; y < given.frame.y; ++y) {
    for (int x = 0; x < given.frame.x; ++x) covered += expected.covering(x, y).empty() ? 0 : 1;
  }
  const std::uint64_t every = covered / most_probes(given.frame) + 1;
  std::uint64_t number = 0;
  std::vector<Probe> probes;
  for (int y = 0; y < given.frame.y; ++y) {
    for (int x = 0; x < given.frame.x; ++x) {
      const int owner = expected.nearest(x, y);
      // Where two polygons may be in front, two depths are right.
      if (owner < 0 || expected.admissible(x, y).size() != 1 || number++ % every != 0 ||
          !probe_square(run.rule, given.frame, x, y))
        continue;
      const auto& plane = expected.polygons()[static_cast<std::size_t>(owner)].plane(Attribute::z);
      if (!plane) continue;
      probes.push_back({x, y, static_cast<std::uint32_t>(owner), plane->at(x, y), -1, given.frame.z});
    }
  }
  return probes;
}

Rational bound_of(const Expectation& expected, const Probe& p, bool loose) {
  const Tolerance& t = expected.polygons()[p.owner].tolerance(Attribute::z);
  return loose ? t.bound : t.unremarkable;
}

/// Depths of one drawing: read where pictures bring them along, otherwise probed.
class Measurement {
 public:
  Measurement(Run& run, const Case& c, Subject& subject, const Drawing& given, Outcome& out)
      : run_(run), case_(c), subject_(subject), given_(given), out_(out) {}

  /// Fetches depths that are delivered. False: a picture failed.
  bool begin() {
    if (!run_.maker.may_deliver_depth()) return true;
    auto picture = run_.picture_of(case_, subject_, given_, out_);
    if (!picture) return false;
    if (!picture->depth.empty()) delivered_ = std::move(*picture);
    return true;
  }

  /// Numbers of the probes that are off by more than a tolerance; nothing where a picture failed. Sets the
  /// limits of those that are not.
  std::optional<std::vector<std::size_t>> misses(const Expectation& expected, std::vector<Probe>& probes,
                                                 bool loose) {
    std::vector<std::size_t> wrong;
    if (delivered_) {
      for (std::size_t i = 0; i < probes.size(); ++i) {
        if (bound_of(expected, probes[i], loose) <
            absolute(Rational{depth_at(probes[i]), 1} - probes[i].value))
          wrong.push_back(i);
      }
      return wrong;
    }
    // Right when a probe just beyond the tolerance wins in front and loses behind.
    std::vector<std::int64_t> front, behind;
    for (const Probe& p : probes) {
      const Rational t = bound_of(expected, p, loose);
      front.push_back(static_cast<std::int64_t>((p.value - t - Rational{1, 1}).ceil()));
      behind.push_back(static_cast<std::int64_t>((p.value + t).floor()) + 1);
    }
    const auto wins = probes_show(run_, case_, subject_, given_, probes, front, out_);
    if (!wins) return std::nullopt;
    const auto loses = probes_show(run_, case_, subject_, given_, probes, behind, out_);
    if (!loses) return std::nullopt;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      if ((*wins)[i] && !(*loses)[i])
        probes[i].low = std::max<std::int64_t>(front[i], -1),
        probes[i].high = std::min<std::int64_t>(behind[i], given_.frame.z);
      else
        wrong.push_back(i);
    }
    return wrong;
  }

  /// Narrows low .. high of every probe to 1, all at once, by halving. False: a picture failed.
  bool narrow(std::vector<Probe>& probes) {
    if (delivered_) {
      for (Probe& p : probes) p.low = p.high = depth_at(p);
      return true;
    }
    const auto wide = [](const Probe& p) { return p.high - p.low > 1; };
    while (std::ranges::any_of(probes, wide)) {
      std::vector<std::int64_t> depths;
      depths.reserve(probes.size());
      for (const Probe& p : probes) depths.push_back(wide(p) ? p.low + (p.high - p.low) / 2 : -1);
      const auto shows = probes_show(run_, case_, subject_, given_, probes, depths, out_);
      if (!shows) return false;
      for (std::size_t i = 0; i < probes.size(); ++i) {
        if (depths[i] >= 0) ((*shows)[i] ? probes[i].low : probes[i].high) = depths[i];
      }
    }
    return true;
  }

  /// Whether of equal depths the last one drawn wins: then the farthest probe that wins has the depth itself,
  /// else one less. False where a picture failed.
  bool last_wins() {
    Drawing scene{{64, 64, 512, 256}, {rectangle(8, 8, 24, 24)}};
    set_depth(scene.polygons.front(), 256);
    const auto shows =
        probes_show(run_, case_, subject_, scene, {{16, 16, 0, {256, 1}, 0, 512}}, {256}, out_);
    return shows && shows->front();
  }
  bool delivered() const { return delivered_.has_value(); }

  /// Whether narrow() needs no pictures that were not asked for when files were written.
  bool narrows_freely() const { return delivered_ || !run_.maker.may_deliver_depth(); }

  /// How far the exact depth is from what was measured.
  static double error_of(const Probe& p) {
    const double v = p.value.value();
    return std::max({0.0, static_cast<double>(p.low) - v, v - static_cast<double>(p.high)});
  }

 private:
  std::int64_t depth_at(const Probe& p) const {
    return static_cast<std::int64_t>(delivered_->depth[delivered_->pixel(p.x, p.y)]);
  }

  Run& run_;
  const Case& case_;
  Subject& subject_;
  const Drawing& given_;
  Outcome& out_;
  std::optional<Framebuffer> delivered_;
};

DepthStatistics::Name name_of(const Case& c, DepthStatistics::Name name) {
  if (c.name == "write" && name.verdict == "depth.wrong")
    return {"depth.stale", "a polygon that loses the depth test leaves its depth behind",
            "write depth and colour together, and only where the test is won"};
  return name;
}

}  // namespace

void run_probe(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  if (run.skip_boundary) {
    row.status = CaseStatus::skipped, row.reason = "depth cannot be measured without a consistent fill rule";
    return;
  }
  const Drawing given = run.maker.as_given(c.drawings.front());
  const Expectation expected(given, run.rule);
  std::vector<Probe> probes = probes_of(run, given, expected);
  if (probes.empty()) return;
  row.judged += probes.size();
  Measurement measurement(run, c, subject, given, out);
  if (!measurement.begin()) return;
  const auto note_errors = [&](const std::vector<Probe>& measured) {
    for (const Probe& p : measured)
      out.worst_depth = std::max(out.worst_depth, std::optional(Measurement::error_of(p)));
  };
  const auto drifting = measurement.misses(expected, probes, false);
  if (!drifting) return;
  if (drifting->empty()) {
    if (measurement.narrows_freely() && measurement.narrow(probes)) note_errors(probes);
    return;
  }
  const auto wrong = measurement.misses(expected, probes, true);
  if (!wrong) return;
  std::vector<Probe> bad;
  for (const std::size_t i : wrong->empty() ? *drifting : *wrong) {
    bad.push_back(probes[i]);
    if (!wrong->empty()) bad.back().low = -1, bad.back().high = given.frame.z;
  }
  if (!measurement.narrow(bad)) return;
  note_errors(bad);
  Problem p;
  const std::int64_t offset = measurement.delivered() || measurement.last_wins() ? 0 : 1;
  for (const Probe& b : bad) {
    p.measured.push_back({b.x, b.y, b.owner, b.low, b.low + offset});
    p.wrong.push_back({b.x, b.y, Wrong::owner, static_cast<int>(b.owner), static_cast<int>(b.owner), {}});
  }
  const DepthStatistics::Name name =
      wrong->empty() ? DepthStatistics::Name{"depth.drift", "depths are off by more than rounding",
                                             "keep more fractional bits, or use double"}
                     : name_of(c, name_depths(expected, p.measured));
  p.case_id = row.id, p.verdict = name.verdict, p.message = name.message, p.hint = name.hint;
  p.severity = wrong->empty() ? Severity::warning : Severity::error;
  if (given.frame.z > 512 && c.name == "zres" && name.verdict != "depth.drift") {
    p.else_verdict = std::move(p.verdict), p.else_message = std::move(p.message),
    p.else_hint = std::move(p.hint);
    p.verdict = "depth.overflow",
    p.message = fmt::format("depths are wrong at a depth resolution of {} only", given.frame.z),
    p.hint = "a product exceeds 32 bits: use 64";
  }
  p.drawing = given, p.count = p.wrong.size();
  row.wrong += wrong->size();
  if (const auto picture = run.picture_of(c, subject, given, out)) p.got = *picture;
  out.problems.push_back(std::move(p));
}

}  // namespace farop::conformance
