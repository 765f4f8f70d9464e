// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <optional>
#include <utility>

#include "conformance/case_kinds.h"
#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

constexpr std::uint64_t k_max_probes = 4000;

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

}  // namespace

void run_probe(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  if (run.skip_boundary) {
    row.status = CaseStatus::skipped, row.reason = "depth cannot be measured without a consistent fill rule";
    return;
  }
  const Drawing given = run.maker.as_given(c.drawings.front());
  const Expectation expected(given, run.rule);
  std::vector<Probe> probes;
  std::uint64_t covered = 0;
  for (int y = 0; y < given.frame.y; ++y) {
    for (int x = 0; x < given.frame.x; ++x) covered += expected.covering(x, y).empty() ? 0 : 1;
  }
  if (covered == 0) return;
  // Large polygons are measured at every n-th sample, n odd to the rows' lengths.
  const std::uint64_t every = covered / k_max_probes + 1;
  std::uint64_t number = 0;
  for (int y = 0; y < given.frame.y; ++y) {
    for (int x = 0; x < given.frame.x; ++x) {
      const int owner = expected.nearest(x, y);
      if (owner < 0 || number++ % every != 0 || !probe_square(run.rule, given.frame, x, y)) continue;
      const auto& plane = expected.polygons()[static_cast<std::size_t>(owner)].plane(Attribute::z);
      if (!plane) continue;
      probes.push_back({x, y, static_cast<std::uint32_t>(owner), plane->at(x, y), -1, given.frame.z});
    }
  }
  row.judged += probes.size();
  // Right when a probe just beyond the tolerance wins in front and loses behind.
  const auto bound = [&](const Probe& p, bool loose) {
    const Tolerance& t = expected.polygons()[p.owner].tolerance(Attribute::z);
    return loose ? t.bound : t.unremarkable;
  };
  const auto misses = [&](bool loose) -> std::optional<std::vector<std::size_t>> {
    std::vector<std::int64_t> front, behind;
    for (const Probe& p : probes) {
      const Rational t = bound(p, loose);
      front.push_back(static_cast<std::int64_t>((p.value - t - Rational{1, 1}).ceil()));
      behind.push_back(static_cast<std::int64_t>((p.value + t).floor()) + 1);
    }
    const auto wins = probes_show(run, c, subject, given, probes, front, out);
    if (!wins) return std::nullopt;
    const auto loses = probes_show(run, c, subject, given, probes, behind, out);
    if (!loses) return std::nullopt;
    std::vector<std::size_t> wrong;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      if (!(*wins)[i] || (*loses)[i]) wrong.push_back(i);
    }
    return wrong;
  };
  const auto drifting = misses(false);
  if (!drifting || drifting->empty()) return;
  const auto wrong = misses(true);
  if (!wrong) return;
  std::vector<Probe> bad;
  for (const std::size_t i : wrong->empty() ? *drifting : *wrong) bad.push_back(probes[i]);
  // How deep is it there? All at once, by halving.
  for (bool open = true; open;) {
    open = false;
    std::vector<std::int64_t> depths;
    for (const Probe& p : bad) depths.push_back(p.high - p.low > 1 ? p.low + (p.high - p.low) / 2 : -1);
    const auto shows = probes_show(run, c, subject, given, bad, depths, out);
    if (!shows) return;
    for (std::size_t i = 0; i < bad.size(); ++i) {
      if (depths[i] < 0) continue;
      ((*shows)[i] ? bad[i].low : bad[i].high) = depths[i];
      open = open || bad[i].high - bad[i].low > 1;
    }
  }
  std::vector<MeasuredDepth> measured;
  Problem p;
  for (const Probe& b : bad) {
    measured.push_back({b.x, b.y, b.owner, b.low});
    p.wrong.push_back({b.x, b.y, Wrong::owner, static_cast<int>(b.owner), static_cast<int>(b.owner), {}});
  }
  DepthStatistics::Name name = name_depths(expected, measured);
  if (c.name == "write" && name.verdict == "depth.wrong")
    name = {"depth.stale", "a polygon that loses the depth test leaves its depth behind",
            "write depth and colour together, and only where the test is won"};
  if (c.name == "zres" && given.frame.z > 65536 && name.verdict != "depth.drift")
    name = {"depth.overflow", fmt::format("depths are wrong at a depth resolution of {}", given.frame.z),
            "a product exceeds 32 bits: use 64"};
  if (wrong->empty())
    name = {"depth.drift", "depths are off by more than rounding",
            "keep more fractional bits, or use double"};
  p.case_id = row.id, p.verdict = name.verdict, p.message = name.message, p.hint = name.hint;
  p.severity = wrong->empty() ? Severity::warning : Severity::error;
  p.drawing = given, p.count = p.wrong.size();
  row.wrong += wrong->size();
  if (const auto picture = run.picture_of(c, subject, given, out)) p.got = *picture;
  out.problems.push_back(std::move(p));
}

}  // namespace farop::conformance
