// SPDX-License-Identifier: GPL-3.0-or-later
// Every mutant draws something that the rasterizer it is made from does not: none is faultless by accident.
// Those with a fill rule of their own draw exactly what that rule says.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "conformance/exact_cases.h"

namespace farop::test {
namespace {

struct Mutant {
  int number = 0;
  std::string source, name;
};

void PrintTo(const Mutant& mutant, std::ostream* out) {
  *out << mutant.number << " " << mutant.name;
}

std::vector<Mutant> manifest() {
  std::vector<Mutant> mutants;
  std::ifstream file(FAROP_SOURCE_DIR "/tests/conformance/mutants/manifest.tsv");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;
    Mutant mutant;
    std::istringstream words(line);
    words >> mutant.number >> mutant.source;
    words.ignore();
    std::getline(words, mutant.name, '\t');
    mutants.push_back(mutant);
  }
  return mutants;
}

std::string library(int number) {
  return FAROP_MUTANTS "/mutant_" + std::string(number < 10 ? "0" : "") + std::to_string(number) + ".so";
}

struct Scene {
  PluginFrame frame;
  std::vector<PluginPolygon> polygons;
};

/// Colours at most 127 before, so that none looks like a background; drawn fan by fan where triangles are
/// wanted.
Scene as_triangles(const Scene& scene) {
  Scene cut{scene.frame, {}};
  for (const PluginPolygon& p : scene.polygons) {
    for (std::size_t i = 1; i + 1 < p.corners.size(); ++i) {
      PluginPolygon triangle = p;
      triangle.corners = {p.corners[0], p.corners[i], p.corners[i + 1]};
      cut.polygons.push_back(triangle);
    }
  }
  return cut;
}

/// Some of everything: polygons alone and in heaps, flat and steep, nested with one left edge, on the far
/// plane, equal depths, great depths; frames that are and are not square.
std::vector<Scene> scenes() {
  std::vector<Scene> scenes;
  Random random(7);
  for (int i = 0; i < 400; ++i) {
    Scene scene{{i / 2 % 2 == 0 ? 24 : 31, 24}, {}};
    scene.frame.background = {3, 5, 7};
    if (i % 3 == 0) scene.frame.z_far = (1 << 30) - 1;
    const int polygons = i % 4 == 0 ? 1 : random.integer(2, 5);
    for (int k = 0; k < polygons; ++k) {
      const Shape shape = k_shapes[random.bits() % std::size(k_shapes)];
      const int extent = random.integer(2, 23);
      Corners corners = random_polygon(random, shape, 23 - extent, 23, 0, extent);
      for (const Attribute attribute : k_attributes) {
        scatter(random, corners, attribute, attribute == Attribute::z ? scene.frame.z_far : 255);
      }
      if (k % 2 == 1) {
        for (ScreenVertex& v : corners) v.z = scene.frame.z_far;
      }
      scene.polygons.push_back(plugin_polygon(corners));
    }
    scenes.push_back(scene);
  }
  Scene nested{{24, 24}, {}};
  for (int k = 0; k < 6; ++k) {
    nested.polygons.push_back(
        plugin_polygon(rectangle(2, 2 + k, 20 - 3 * k, 20 - k, 200 - 10 * k, 40 * k, 255 - 40 * k, 9)));
  }
  scenes.push_back(nested);
  return scenes;
}

/// Draws with a new instance each; the base's pictures are made once.
const std::vector<PluginPicture>& base_pictures(const std::string& source, const std::vector<Scene>& scenes) {
  static std::map<std::string, std::vector<PluginPicture>> made;
  std::vector<PluginPicture>& pictures = made[source];
  if (!pictures.empty()) return pictures;
  PluginDriver driver(FAROP_INNOCENTS "/base_" + source + ".so");
  const bool triangles = (driver.table().wants & FAROP_WANT_TRIANGLES) != 0;
  for (const Scene& scene : scenes) {
    pictures.push_back(driver.draw(scene.frame, triangles ? as_triangles(scene).polygons : scene.polygons));
  }
  return pictures;
}

/// Scenes that the mutant draws otherwise, or not without breaking the interface.
int differing_scenes(const Mutant& mutant) {
  static const std::vector<Scene> all = scenes();
  const std::vector<PluginPicture>& expected = base_pictures(mutant.source, all);
  PluginDriver driver(library(mutant.number));
  const bool triangles = (driver.table().wants & FAROP_WANT_TRIANGLES) != 0;
  int differing = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    try {
      const Scene& scene = all[i];
      if (driver.draw(scene.frame, triangles ? as_triangles(scene).polygons : scene.polygons) != expected[i])
        ++differing;
    } catch (const std::runtime_error&) {
      ++differing;
    }
  }
  return differing;
}

TEST(Manifest, HasEveryMutantOnce) {
  std::set<int> numbers;
  for (const Mutant& mutant : manifest()) EXPECT_TRUE(numbers.insert(mutant.number).second) << mutant.number;
  EXPECT_EQ(numbers.size(), 68u);
  EXPECT_EQ(*numbers.begin(), 1);
  EXPECT_EQ(*numbers.rbegin(), 68);
}

class EveryMutant : public testing::TestWithParam<Mutant> {};

INSTANTIATE_TEST_SUITE_P(, EveryMutant, testing::ValuesIn(manifest()),
                         [](const auto& i) { return std::to_string(i.param.number); });

TEST_P(EveryMutant, DrawsSomethingElse) {
  switch (GetParam().number) {
    case 22:
    case 34:
      GTEST_SKIP() << "crashes: see MutantsThatCrash";
    case 64:
    case 68:
      GTEST_SKIP() << "not the same every time: see MutantsThatVary";
    case 66:
    case 67:
      // Right, and slow: what shows is the time they take.
      EXPECT_EQ(differing_scenes(GetParam()), 0);
      return;
    default:
      EXPECT_GT(differing_scenes(GetParam()), 0);
  }
}

// ---- crashes
// --------------------------------------------------------------------------------------------------------

/// Draws in a process of its own.
[[noreturn]] void draw_alone(int number, const Corners& corners) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  PluginDriver driver(library(number));
  driver.draw({64, 64}, std::vector{plugin_polygon(corners)});
  std::_Exit(0);
}

TEST(MutantsThatCrash, DividesByZeroAtAHorizontalEdge) {
#if !defined(__x86_64__) && !defined(__i386__)
  GTEST_SKIP() << "only x86 traps a division by zero";
#endif
  EXPECT_EXIT(draw_alone(22, {vertex(0, 0), vertex(9, 3), vertex(4, 9)}), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(draw_alone(22, {vertex(0, 0), vertex(9, 0), vertex(4, 9)}), testing::KilledBySignal(SIGFPE),
              "");
}

TEST(MutantsThatCrash, HasNoRoomForTheSixtyFifthCorner) {
  Corners many;
  for (int i = 0; i < 2000; ++i) many.push_back(vertex(i % 2 == 0 ? 0 : 63, 10 + i % 40));
  EXPECT_EXIT(draw_alone(34, Corners(many.begin(), many.begin() + 64)), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(
      draw_alone(34, many), [](int status) { return status != 0; }, "");
}

// ---- variation
// ------------------------------------------------------------------------------------------------------

TEST(MutantsThatVary, ReadsWhatWasOnTheHeap) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer's heap cannot be filled at will";
#endif
  PluginDriver driver(library(64));
  const std::vector scene{plugin_polygon(rectangle(0, 0, 20, 20, 100, 1, 2, 3))};
  mallopt(M_PERTURB, 0xFF);  // new blocks hold its complement
  const PluginPicture zeros = driver.draw({24, 24}, scene);
  mallopt(M_PERTURB, 0x01);
  const PluginPicture ones = driver.draw({24, 24}, scene);
  mallopt(M_PERTURB, 0);
  EXPECT_NE(zeros, ones);
}

TEST(MutantsThatVary, DrawsAWrongPixelNowAndThen) {
  PluginDriver driver(library(68));
  const std::vector scene{plugin_polygon(rectangle(0, 0, 200, 399, 100, 1, 2, 3))};
  std::vector<PluginPicture> pictures;
  for (int i = 0; i < 100; ++i) pictures.push_back(driver.draw({400, 400}, scene));
  EXPECT_TRUE(std::any_of(pictures.begin(), pictures.end(), [&](const auto& p) { return p != pictures[0]; }));
}

// ---- fill rules
// -----------------------------------------------------------------------------------------------------

class FillRule : public testing::Test {
 protected:
  template <class Expected>
  void expect(int number, const Expected& expected) {
    PluginDriver driver(library(number));
    const bool triangles = (driver.table().wants & FAROP_WANT_TRIANGLES) != 0;
    Random random(8);
    for (int i = 0; i < 600 && !HasFailure(); ++i) {
      const int extent = i % 2 == 0 ? 5 : 20;
      Corners corners = random_polygon(random, triangles || i % 3 == 0 ? Shape::triangle : Shape::star, 1,
                                       extent, 1, extent);
      if (twice_area(corners) == 0) continue;
      ASSERT_EQ(drawn_coverage(driver, frame, corners), expected(corners))
          << "mutant " << number << " " << text_of(corners);
    }
  }
  void expect_moved(int number, const MovedSample& rule) {
    expect(number, [&](const Corners& c) { return moved_coverage(c, rule, frame.width, frame.height); });
  }
  PluginFrame frame{24, 24};
};

TEST_F(FillRule, IsTheNamedOneOfTheOtherSeven) {
  expect_moved(1, {+1, -1, true});
  expect_moved(2, {-1, +1, true});
  expect_moved(3, {-1, -1, true});
  expect_moved(4, {+1, +1, false});
  expect_moved(5, {+1, -1, false});
  expect_moved(6, {-1, +1, false});
  expect_moved(7, {-1, -1, false});
}

TEST_F(FillRule, IsClosedOrOpen) {
  expect(8, [&](const Corners& c) { return closed_coverage(c, frame.width, frame.height); });
  expect(14, [&](const Corners& c) { return open_coverage(c, frame.width, frame.height); });
}

// `trunc` is `rb` a pixel to the left.
TEST_F(FillRule, IsTruncated) {
  expect(15, [&](Corners c) {
    for (ScreenVertex& v : c) --v.x;
    return moved_coverage(c, {-1, +1, true}, frame.width, frame.height);
  });
}

/// In twice as fine a lattice.
Coverage half_moved(Corners c, int x, int y, const MovedSample& rule, const PluginFrame& frame) {
  for (ScreenVertex& v : c) v.x = 2 * v.x - x, v.y = 2 * v.y - y;
  const Coverage fine = moved_coverage(c, rule, 2 * frame.width, 2 * frame.height);
  Coverage coverage;
  for (int j = 0; j < frame.height; ++j) {
    for (int i = 0; i < frame.width; ++i)
      coverage.push_back(fine[static_cast<std::size_t>(4 * j * frame.width + 2 * i)]);
  }
  return coverage;
}

TEST_F(FillRule, SamplesHalfAPixelAway) {
  expect(16, [&](const Corners& c) { return half_moved(c, 1, 0, {-1, +1, true}, frame); });
  expect(17, [&](const Corners& c) { return half_moved(c, 1, 1, k_lb, frame); });
}

}  // namespace
}  // namespace farop::test
