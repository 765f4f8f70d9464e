// SPDX-License-Identifier: GPL-3.0-or-later
// The checker against rasterizers that are right, or wrong in one known way.
#include "conformance/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>

#include "conformance/expectation.h"
#include "conformance/fill_rules.h"
#include "conformance/shapes.h"
#include "conformance/shrink.h"

namespace farop::conformance {
namespace {

/// A z-buffer from exact parts, with switches.
struct Faults {
  FillRule rule = FillRule::lb;
  enum class Test { nearer, none, farther, nearer_or_equal } test = Test::nearer;
  bool first_color = false, flip_y = false, swap_channels = false, blank = false, far_plane = false,
       flat_depth = false;
};

class Simulated : public Subject {
 public:
  Simulated(const Faults& faults, const Color& background) : faults_(faults), background_(background) {}

  Delivered draw(const Drawing& drawing) override {
    Framebuffer picture;
    picture.width = drawing.frame.x, picture.height = drawing.frame.y;
    const Window frame = window_of(drawing.frame);
    for (std::size_t i = 0; i < frame.samples(); ++i)
      picture.rgb.insert(picture.rgb.end(), background_.begin(), background_.end());
    std::vector<double> depth(frame.samples(), faults_.test == Faults::Test::farther ? -1
                                               : faults_.far_plane ? static_cast<double>(drawing.frame.z - 1)
                                                                   : std::numeric_limits<double>::infinity());
    for (const TestPolygon& polygon : drawing.polygons) {
      if (faults_.blank) continue;
      const Bitmap covered = rule_coverage(polygon, faults_.rule, bounds(polygon, drawing.frame, 1));
      const auto z_plane = plane_through(polygon, Attribute::z);
      for (int y = covered.window.y0; y < covered.window.y1; ++y) {
        for (int x = covered.window.x0; x < covered.window.x1; ++x) {
          if (covered.get(x, y) == 0) continue;
          const double z = z_plane && !faults_.flat_depth ? std::floor(z_plane->at(x, y).value() + 0.5)
                                                          : polygon.front().z;
          double& stored = depth[frame.index(x, y)];
          using Test = Faults::Test;
          const bool wins = faults_.test == Test::none || (faults_.test == Test::farther  ? z > stored
                                                           : faults_.test == Test::nearer ? z < stored
                                                                                          : z <= stored);
          if (!wins) continue;
          stored = z;
          const int row = faults_.flip_y ? picture.height - 1 - y : y;
          for (std::size_t c = 0; c < 3; ++c)
            picture.rgb[3 * picture.pixel(x, row) + (faults_.swap_channels ? 2 - c : c)] =
                color(polygon, k_channels[c], x, y, drawing.frame.color);
        }
      }
    }
    return {std::move(picture), {}, {}, 0};
  }

 private:
  std::uint8_t color(const TestPolygon& polygon, Attribute a, int x, int y, int cres) const {
    const auto plane = plane_through(polygon, a);
    const auto row = plane ? std::nullopt : scan_line_value(polygon, a, x, y);
    double v = plane ? plane->at(x, y).value()
               : row ? row->value()
                     : static_cast<double>(value_of(polygon.front(), a));
    if (faults_.first_color) v = static_cast<double>(value_of(polygon.front(), a));
    return static_cast<std::uint8_t>(std::clamp(std::floor(v * 255 / (cres - 1) + 0.5), 0.0, 255.0));
  }

  Faults faults_;
  Color background_;
};

class SimulatedMaker : public SubjectMaker {
 public:
  explicit SimulatedMaker(const Faults& faults) : faults_(faults) {}
  std::unique_ptr<Subject> make(std::uint8_t) const override {
    return std::make_unique<Simulated>(faults_, k_background);
  }
  Color background() const override { return k_background; }

 private:
  Faults faults_;
};

CheckResult check(const Faults& faults, Level level = Level::normal) {
  // Large frames cost time and add nothing here.
  std::vector<Case> corpus = make_corpus({level, 1, false});
  std::erase_if(corpus,
                [](const Case& c) { return c.name == "size" || c.name == "big-n" || c.name == "vertices"; });
  return run_check(corpus, SimulatedMaker(faults), {});
}

CheckResult check_families(const Faults& faults, const std::vector<std::string>& families,
                           const CheckOptions& options = {}) {
  std::vector<Case> corpus = make_corpus({});
  std::erase_if(corpus, [&](const Case& c) {
    return std::ranges::find(families, c.family) == families.end() &&
           std::ranges::find(families, c.group()) == families.end();
  });
  return run_check(corpus, SimulatedMaker(faults), options);
}

std::vector<std::string> errors(const CheckResult& result) {
  std::vector<std::string> verdicts;
  for (const Finding& f : result.findings) {
    if (f.severity == Severity::error)
      verdicts.push_back(f.detail.empty() ? f.verdict : f.verdict + " " + f.detail);
  }
  return verdicts;
}

using Verdicts = std::vector<std::string>;

TEST(Check, FindsNothingWrongWithARightRasterizer) {
  const CheckResult result = check({});
  EXPECT_TRUE(result.findings.empty()) << finding_line(result.findings.front());
  EXPECT_EQ(result.summary.verdict, "pass");
  EXPECT_EQ(result.summary.failed, 0u);
  EXPECT_EQ(result.rule_fingerprint.named, "lb");
  for (const FingerprintRow& row : result.rule_fingerprint.table) {
    EXPECT_GT(row.cases, 20u) << row.kind;
    if (row.kind == "left" || row.kind == "bottom") {
      EXPECT_EQ(row.owned, row.cases) << row.kind;
    }
    if (row.kind == "right" || row.kind == "top" || row.kind == "maximum") {
      EXPECT_EQ(row.owned, 0u) << row.kind;
    }
  }
}

TEST(Check, AcceptsThatTheLastOfEqualDepthsWins) {
  Faults faults;
  faults.test = Faults::Test::nearer_or_equal;
  EXPECT_EQ(errors(check(faults)), Verdicts{});
}

TEST(Check, NamesEveryFillRule) {
  for (int r = 1; r < k_fill_rules; ++r) {
    Faults faults;
    faults.rule = FillRule{static_cast<std::uint8_t>(r)};
    const CheckResult result = check(faults, Level::quick);
    ASSERT_EQ(errors(result).size(), 1u) << rule_name(faults.rule) << " " << errors(result)[1];
    EXPECT_EQ(result.findings.front().detail, rule_name(faults.rule));
    EXPECT_EQ(result.rule_fingerprint.named, rule_name(faults.rule));
    EXPECT_EQ(result.findings.front().verdict == "fill.rule", is_consistent(faults.rule));
  }
}

TEST(Check, ReportsAConsistentRuleAloneAndAcceptsItWhenAsked) {
  Faults faults;
  faults.rule = FillRule::rt;
  EXPECT_EQ(errors(check(faults)), Verdicts{"fill.rule rt"});
  CheckOptions options;
  options.accepted_rule = "rt";
  const CheckResult accepted =
      run_check(make_corpus({Level::quick, 1, false}), SimulatedMaker(faults), options);
  EXPECT_EQ(errors(accepted), Verdicts{});
  EXPECT_EQ(accepted.summary.verdict, "pass.other-rule");
}

TEST(Check, NamesWholeFrameMistakesAlone) {
  Faults flipped, swapped, blank, far_plane;
  flipped.flip_y = swapped.swap_channels = blank.blank = far_plane.far_plane = true;
  EXPECT_EQ(errors(check(flipped)), Verdicts{"frame.flip-y"});
  EXPECT_EQ(errors(check(swapped)), Verdicts{"frame.channels bgr"});
  EXPECT_EQ(errors(check(blank)), Verdicts{"frame.blank"});
  EXPECT_EQ(errors(check(far_plane)), Verdicts{"depth.far-plane"});
}

TEST(Check, NamesWrongDepthTestsAndColors) {
  Faults none, farther, flat;
  none.test = Faults::Test::none, farther.test = Faults::Test::farther, flat.first_color = true;
  EXPECT_EQ(errors(check(none)).front(), "depth.none");
  EXPECT_EQ(errors(check(farther)).front(), "depth.inverted");
  EXPECT_EQ(errors(check(flat)).front(), "colour.flat");
}

TEST(Check, ShrinksExamplesToAFewPolygons) {
  Faults faults;
  faults.test = Faults::Test::none;
  const CheckResult result = check(faults);
  ASSERT_FALSE(result.findings.empty());
  const Example& example = result.findings.front().examples.front();
  EXPECT_TRUE(example.shrunk);
  EXPECT_EQ(example.polygons.size(), 2u);
  EXPECT_FALSE(example.flat.empty());
  EXPECT_GT(example.wrong_pixels, 0u);
}

TEST(Check, ShowsDifferentCasesAsExamples) {
  Faults faults;
  faults.test = Faults::Test::none;
  // Each draws the same two squares, and more, in several orders.
  const CheckResult result = check_families(faults, {"depth/two", "depth/cross", "abi/frames"});
  for (const Finding& f : result.findings) {
    std::set<std::string> cases;
    for (const Example& e : f.examples) EXPECT_TRUE(cases.insert(e.from_case).second) << e.from_case;
  }
  EXPECT_EQ(result.findings.front().examples.size(), 3u);
}

TEST(Check, ShrinksDepthsThatNobodySees) {
  Faults faults;
  faults.flat_depth = true;
  const CheckResult result = check_families(faults, {"depth/slope", "depth/zres"});
  ASSERT_EQ(errors(result), Verdicts{"depth.wrong"}) << "no overflow where small depths are wrong as well";
  const Example& example = result.findings.front().examples.front();
  EXPECT_TRUE(example.shrunk && example.alone);
  EXPECT_EQ(example.polygons.size(), 1u);
  EXPECT_EQ(example.polygons.front().size(), 3u);
  EXPECT_LT(example.frame.x, 64);
  ASSERT_FALSE(example.pixels.empty());
  EXPECT_EQ(example.pixels.front().kind, "depth");

  Case file;
  file.family = "depth", file.name = "file", file.kind = CaseKind::file;
  file.drawings.push_back({example.frame, example.polygons});
  EXPECT_EQ(errors(run_check({file}, SimulatedMaker(faults), {})), Verdicts{"depth.wrong"});
  EXPECT_EQ(errors(run_check({file}, SimulatedMaker({}), {})), Verdicts{});
}

TEST(Check, AcceptsTheLectureRuleWhenAsked) {
  Faults faults;
  faults.rule = FillRule::lb_min;
  EXPECT_EQ(errors(check_families(faults, {"smoke", "cov/tri4", "cov/quad4", "tile/fan"})).front(),
            "fill.min-vertex lb+min");
  CheckOptions options;
  options.accepted_rule = "lb+min";
  const CheckResult result =
      check_families(faults, {"smoke", "cov/tri4", "cov/quad4", "tile/fan", "depth/two"}, options);
  EXPECT_EQ(errors(result), Verdicts{});
  EXPECT_EQ(result.summary.verdict, "pass.other-rule");
}

/// All that a run says, but for times.
std::string account_of(const CheckResult& result) {
  std::string text;
  for (const Finding& f : result.findings) {
    text += finding_line(f) + "\n";
    for (const std::string& id : f.case_ids) text += id + "\n";
    for (const Example& e : f.examples) text += e.from_case + "\n" + e.flat;
  }
  for (const CaseResult& c : result.cases) {
    text += c.id + " " + std::to_string(static_cast<int>(c.status)) + " " + std::to_string(c.judged) + " " +
            std::to_string(c.wrong) + " " + std::to_string(c.ambiguous);
    for (const std::string& verdict : c.verdicts) text += " " + verdict;
    text += "\n";
  }
  return text;
}

TEST(Check, SaysTheSameWithOneThreadAndWithEight) {
  Faults wrong;
  wrong.test = Faults::Test::none, wrong.rule = FillRule::closed;
  std::vector<std::string> told[2], said;
  for (const int workers : {1, 8}) {
    CheckOptions options;
    options.workers = workers;
    // One at a time, in the order of the corpus.
    options.finished = [&](const CaseResult& c) { told[workers == 8].push_back(c.id); };
    said.push_back(account_of(check_families(
        wrong, {"cov/convex", "tile/fan", "depth/two", "depth/cross", "meta/split"}, options)));
  }
  EXPECT_EQ(said[0], said[1]);
  EXPECT_EQ(told[0], told[1]);
  EXPECT_GT(told[0].size(), 250u);
}

TEST(Check, StopsWhenAskedAndKeepsWhatWasFound) {
  Faults faults;
  faults.test = Faults::Test::none;
  int asked = 0;
  CheckOptions options;
  options.interrupted = [&] { return ++asked > 3; };
  const CheckResult result = check_families(faults, {"depth/two", "depth/order", "depth/cross"}, options);
  EXPECT_EQ(result.summary.verdict, "interrupted");
  EXPECT_GT(result.summary.failed, 0u);
  EXPECT_GT(result.summary.skipped, 0u);
  EXPECT_EQ(result.cases.back().reason, "not reached");
}

TEST(Shrinking, KeepsWhatFailsAndStopsInTime) {
  Drawing drawing{{64, 64, 512, 256}, {}};
  for (int i = 0; i < 20; ++i) drawing.polygons.push_back(rectangle(20 + i, 30, 40 + i, 50));
  drawing.polygons[7][0].z = 7;
  int renders = 0;
  const auto fails = [](const Drawing& d) {
    return std::ranges::any_of(d.polygons, [](const TestPolygon& p) {
      return std::ranges::any_of(p, [](const ScreenVertex& v) { return v.z == 7; });
    });
  };
  const Drawing small = shrunk(drawing, fails, {}, renders);
  EXPECT_TRUE(fails(small));
  EXPECT_EQ(small.polygons.size(), 1u);
  EXPECT_EQ(small.polygons.front().size(), 3u);
  EXPECT_LE(renders, 400);
  int few = 0;
  EXPECT_TRUE(fails(shrunk(drawing, fails, {3, 10}, few)));
  EXPECT_LE(few, 3);
}

}  // namespace
}  // namespace farop::conformance
