// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes in the corpus: their relations, what of them is compared, and how little of them is reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "conformance/check.h"
#include "conformance/decided.h"
#include "conformance/shapes.h"

namespace farop::conformance {
namespace {

/// Triangles and quadrangles at all depths, crossing each other, in colours of their own.
Drawing some_scene() {
  Drawing d{{128, 128, 65536, 256}, {}};
  Random random("scene test", 0, 1);
  for (std::size_t i = 0; i < 300; ++i) {
    TestPolygon& p = d.polygons.emplace_back(
        polygon_of(random_simple_polygon(random, 3 + static_cast<int>(i % 2), 40, 40)));
    p = moved(p, random.between(0, 88), random.between(0, 88));
    const int depth = random.between(0, 60000);
    for (ScreenVertex& v : p) v.z = depth + random.between(0, 5000);
    paint(p, identification_color(i));
  }
  return d;
}

std::vector<Case> scene_corpus() {
  CorpusOptions options;
  options.scenes.push_back({"some", 0, "Three hundred polygons.", true, some_scene});
  std::vector<Case> corpus = make_corpus(options);
  std::erase_if(corpus, [](const Case& c) { return !c.deliver; });
  return corpus;
}

using Draw = std::function<Framebuffer(const Drawing&)>;

/// Draws by a function; black background.
class Drawn : public Subject, public SubjectMaker {
 public:
  explicit Drawn(Draw draw) : draw_(std::move(draw)) {}
  Delivered draw(const Drawing& drawing) override { return {draw_(drawing), {}, {}}; }
  std::unique_ptr<Subject> make(std::uint8_t) const override { return std::make_unique<Drawn>(draw_); }

 private:
  Draw draw_;
};

Framebuffer right(const Drawing& d) {
  return ideal_picture(Expectation(d, ConsistentRule::lb), {});
}

/// What is drawn when only some polygons are.
Draw without(const std::function<bool(const TestPolygon&)>& left_out) {
  return [left_out](Drawing d) {
    std::erase_if(d.polygons, left_out);
    return right(d);
  };
}

std::vector<std::string> verdicts(const CheckResult& result) {
  std::vector<std::string> all;
  for (const Finding& f : result.findings) all.push_back(f.verdict);
  std::ranges::sort(all);
  return all;
}

TEST(Scenes, AreDeliveredWhenTheirTurnComes) {
  const std::vector<Case> corpus = scene_corpus();
  std::map<std::string, int> count;
  for (const Case& c : corpus) {
    ++count[c.group()];
    EXPECT_TRUE(c.drawings.empty());
    EXPECT_TRUE(c.purpose.ends_with('.')) << c.purpose;
    const std::vector<Drawing> drawings = c.deliver();
    EXPECT_EQ(drawings.size(), c.kind == CaseKind::relation ? 2u : c.kind == CaseKind::state ? 3u : 1u);
    for (const Drawing& d : drawings) {
      for (const TestPolygon& p : d.polygons) {
        for (const ScreenVertex& v : p)
          ASSERT_TRUE(v.x >= 0 && v.x < d.frame.x && v.y >= 0 && v.y < d.frame.y && v.z >= 0 &&
                      v.z < d.frame.z);
      }
    }
  }
  EXPECT_EQ(count["scene/some"], 1);
  EXPECT_EQ(count.size(), 9u) << "the scene and eight relations";
}

TEST(Scenes, PassForARightRasterizer) {
  const CheckResult result = run_check(scene_corpus(), Drawn(right), {});
  EXPECT_EQ(verdicts(result), std::vector<std::string>{});
  for (const CaseResult& c : result.cases) {
    EXPECT_EQ(c.status, CaseStatus::passed) << c.id;
    EXPECT_GT(c.judged, 128u * 128 / 2) << c.id << ": most of it is decided";
  }
}

TEST(Scenes, FailWhereOneOfTheirPolygonsDoes) {
  // The 57th one is not drawn: pictures are wrong, relations between wrong pictures hold.
  const Color lost = identification_color(57);
  const CheckResult result = run_check(scene_corpus(), Drawn(without([&](const TestPolygon& p) {
                                         return p[0].r == lost[0] && p[0].g == lost[1] && p[0].b == lost[2];
                                       })),
                                       {});
  ASSERT_FALSE(result.findings.empty());
  for (const Finding& f : result.findings) {
    EXPECT_FALSE(f.verdict.starts_with("meta.")) << f.message;
    ASSERT_FALSE(f.examples.empty());
    EXPECT_LE(f.examples.front().polygons.size(), 2u) << f.verdict << ": of 300";
    EXPECT_GT(f.examples.front().wrong_pixels, 0u);
  }
}

/// Overlapping triangles whose colours are much alike, and vary.
Drawing smooth_scene() {
  Drawing d = some_scene();
  std::erase_if(d.polygons, [](const TestPolygon& p) { return p.size() > 3; });
  Random random("smooth scene", 0, 1);
  for (TestPolygon& p : d.polygons) {
    for (ScreenVertex& v : p) v.r = v.g = v.b = static_cast<std::uint16_t>(random.between(100, 130));
  }
  return d;
}

// Where a wrong colour is another polygon's by chance, or nearly right, smaller pictures know better.
TEST(Scenes, AddNoSecondCauseToAKnownOne) {
  const auto flat = [](Drawing d) {
    for (TestPolygon& p : d.polygons) {
      for (ScreenVertex& v : p) v.r = p[0].r, v.g = p[0].g, v.b = p[0].b;
    }
    return right(d);
  };
  CorpusOptions options;
  options.scenes.push_back({"smooth", 0, "Triangles.", true, smooth_scene});
  std::vector<Case> corpus = make_corpus(options);
  std::erase_if(corpus, [](const Case& c) { return !c.deliver && c.group() != "colour/frac"; });
  const CheckResult result = run_check(corpus, Drawn(flat), {});
  EXPECT_EQ(verdicts(result), std::vector<std::string>{"colour.flat"});
  for (const CaseResult& c : result.cases) {
    if (c.id.starts_with("scene/")) {
      EXPECT_EQ(c.verdicts, std::vector<std::string>{"colour.flat"}) << c.id;
    }
  }
  // Nothing else to explain it: what the scene shows is told.
  std::erase_if(corpus, [](const Case& c) { return !c.deliver; });
  EXPECT_GT(verdicts(run_check(corpus, Drawn(flat), {})).size(), 1u);
}

TEST(Scenes, ViolateTheRelationThatAFaultBreaks) {
  const auto alone = [](const Draw& draw) {
    std::vector<Case> corpus = scene_corpus();
    std::erase_if(corpus, [](const Case& c) { return c.kind != CaseKind::relation; });
    return verdicts(run_check(corpus, Drawn(draw), {}));
  };
  const auto has = [](const std::vector<std::string>& all, const char* verdict) {
    return std::ranges::find(all, verdict) != all.end();
  };
  // No depth test: the last one drawn is seen.
  const auto painter = alone([](Drawing d) {
    for (std::size_t i = 0; i < d.polygons.size(); ++i)
      set_depth(d.polygons[i], static_cast<std::int64_t>(10 * (d.polygons.size() - i)));
    return right(d);
  });
  EXPECT_TRUE(has(painter, "meta.scene-order"));
  EXPECT_TRUE(has(painter, "meta.scene-hidden"));
  EXPECT_FALSE(has(painter, "meta.scene-translate"));
  const auto small_only = alone(without([](const TestPolygon& p) { return p.size() > 3; }));
  EXPECT_TRUE(has(small_only, "meta.scene-split"));
  EXPECT_TRUE(has(small_only, "meta.scene-edge-points"));
  EXPECT_FALSE(has(small_only, "meta.scene-order"));
  const auto left_turns = alone(without([](const TestPolygon& p) { return twice_area(p) < 0; }));
  EXPECT_TRUE(has(left_turns, "meta.scene-vertices"));
  const auto near_the_origin = alone(without([](const TestPolygon& p) { return p[0].x + p[0].y < 60; }));
  EXPECT_TRUE(has(near_the_origin, "meta.scene-translate"));
  const auto in_small_frames = alone([](const Drawing& d) {
    Drawing none{d.frame, {}};
    return right(d.frame.x > 144 ? none : d);
  });
  EXPECT_EQ(in_small_frames, std::vector<std::string>{"meta.scene-crop"});
}

TEST(Scenes, AreComparedWhereDepthsLeaveNoChoice) {
  Drawing d{{16, 16, 512, 256}, {rectangle(0, 0, 8, 8), rectangle(4, 0, 12, 8), rectangle(4, 8, 12, 15)}};
  for (std::size_t i = 0; i < 3; ++i) paint(d.polygons[i], identification_color(i));
  set_depth(d.polygons[0], 100), set_depth(d.polygons[1], 100), set_depth(d.polygons[2], 100);
  const Expectation tied(d, ConsistentRule::lb);
  const Bitmap open = decided_alike(tied, tied, {0, 0, 16, 16}, 0, 0);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) EXPECT_EQ(open.get(x, y), y < 8 && x >= 4 && x < 8 ? 0 : 1) << x << " " << y;
  }
  Drawing behind = d;
  set_depth(behind.polygons[1], 102);
  const Expectation clear(behind, ConsistentRule::lb);
  const Bitmap all = decided_alike(clear, clear, {0, 0, 16, 16}, 0, 0);
  EXPECT_EQ(std::ranges::count(all.at, 1), 256);
  const Bitmap moved_on = decided_alike(clear, clear, {0, 0, 16, 16}, 1, 0);
  EXPECT_EQ(moved_on.get(15, 0), 0) << "beyond the other frame";
  EXPECT_EQ(moved_on.get(7, 2), 0) << "another polygon there";
  EXPECT_EQ(moved_on.get(2, 2), 1);
}

}  // namespace
}  // namespace farop::conformance
