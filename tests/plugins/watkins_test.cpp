// SPDX-License-Identifier: GPL-3.0-or-later
// Visible surfaces without a depth buffer: every way in which segments can begin, end, hide, touch and come
// through each other. For Watkins' algorithm, and for others that find visible segments on a line.
#include <gtest/gtest.h>

#include <algorithm>

#include "plugins/visibility.h"

namespace farop::test {
namespace {

struct Finder {
  std::string name, library;
  std::map<std::string, std::string> options;
};

void PrintTo(const Finder& finder, std::ostream* out) {
  *out << finder.name;
}

template <class Info>
std::string finder_name(const Info& info) {
  return info.param.name;
}

class VisibleSegments : public testing::TestWithParam<Finder> {
 protected:
  /// As many polygons as asked for, of all shapes, planar on the lattice.
  VisibilityScene random_scene(Random& random, const PluginFrame& frame, int count, int size) {
    VisibilityScene scene;
    const int right = (frame.width - 1) << frame.subpixel_bits, top = (frame.height - 1)
                                                                      << frame.subpixel_bits;
    for (int i = 0; i < count; ++i) {
      const int x = random.integer(0, std::max(0, right - size)),
                y = random.integer(0, std::max(0, top - size));
      Corners corners =
          random_polygon(random, k_shapes[i % 5], x, std::min(x + size, right), y, std::min(y + size, top));
      make_planar(random, corners, Attribute::z, frame.z_far);
      scene.add(corners);
    }
    return scene;
  }
  void expect_seen(const VisibilityScene& scene, const PluginFrame& frame, bool exact,
                   const std::string& what) {
    scene.expect_seen(driver.draw(frame, scene.polygons()), frame, exact, what);
  }

  PluginDriver driver{GetParam().library, GetParam().options};
};

INSTANTIATE_TEST_SUITE_P(, VisibleSegments,
                         testing::Values(Finder{"watkins", FAROP_WATKINS, {}},
                                         Finder{"solids_1", FAROP_SOLIDS, {{"variant", "1"}}},
                                         Finder{"solids_2", FAROP_SOLIDS, {{"variant", "2"}}},
                                         Finder{"solids_3", FAROP_SOLIDS, {{"variant", "3"}}}),
                         finder_name<testing::TestParamInfo<Finder>>);

/// Depths are whole numbers at every sample, so there is one right picture, ties included.
TEST_P(VisibleSegments, ShowsTheFirstOfTheNearestInRandomScenes) {
  Random random(101);
  for (int i = 0; i < 800; ++i) {
    PluginFrame frame;
    frame.width = random.integer(1, 48), frame.height = random.integer(1, 48);
    // Few depths: many ties and many crossings at samples. Many: neither.
    frame.z_far = i % 4 == 0 ? 100 : i % 4 == 1 ? 511 : i % 4 == 2 ? 65535 : (1 << 30) - 1;
    const VisibilityScene scene = random_scene(random, frame, random.integer(1, 25), i % 3 == 0 ? 12 : 47);
    expect_seen(scene, frame, true, "scene " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

TEST_P(VisibleSegments, ShowsTheNearestBetweenPixels) {
  Random random(102);
  for (int i = 0; i < 240; ++i) {
    PluginFrame frame;
    frame.width = frame.height = 24;
    frame.subpixel_bits = 1 + i % 8;
    const VisibilityScene scene =
        random_scene(random, frame, random.integer(2, 12), 23 << frame.subpixel_bits);
    expect_seen(scene, frame, true, "scene " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

/// Triangles with any depths at their corners: steep, and crossing anywhere.
TEST_P(VisibleSegments, ShowsNoTriangleAUnitBehindAnother) {
  Random random(103);
  for (int i = 0; i < 600; ++i) {
    PluginFrame frame;
    frame.width = frame.height = 40;
    frame.z_far = i % 3 == 0 ? 20 : i % 3 == 1 ? 1000 : 65535;
    VisibilityScene scene;
    for (int k = random.integer(2, 20); k > 0; --k) {
      Corners corners = random_polygon(random, Shape::triangle, 0, 39, 0, 39);
      scatter(random, corners, Attribute::z, frame.z_far);
      scene.add(corners);
    }
    expect_seen(scene, frame, false, "scene " + std::to_string(i));
    if (HasFatalFailure()) return;
  }
}

/// Every line is cut by hundreds of segments that end, begin and come through each other.
TEST_P(VisibleSegments, ShowsTheNearestOfManyNeedles) {
  Random random(104);
  PluginFrame frame;
  frame.width = 50, frame.height = 40;
  VisibilityScene scene;
  for (int i = 0; i < 1500; ++i) {
    const int x = random.integer(0, 48), y = random.integer(0, 5);
    Corners corners = {vertex(x, y), vertex(x + 1, y), vertex(random.integer(0, 49), random.integer(20, 39))};
    scatter(random, corners, Attribute::z, 65535);
    scene.add(corners);
  }
  expect_seen(scene, frame, false, "needles");
}

/// Nested squares, nearer inside or nearer outside, with common edges and rows to start on.
TEST_P(VisibleSegments, ShowsNestedSquaresInEveryOrder) {
  PluginFrame frame;
  for (const bool nearer_inside : {false, true}) {
    for (const int shift : {0, 1}) {
      std::vector<Corners> squares;
      for (int i = 0; i < 7; ++i) {
        const int z = 1000 + (nearer_inside ? -10 : 10) * i;
        squares.push_back(rectangle(4 + shift * i, 4 + shift * i, 60 - 4 * i, 60 - 4 * i, z, 0, 0, 0));
      }
      Random random(105);
      for (int turn = 0; turn < 40; ++turn) {
        VisibilityScene scene;
        for (const Corners& corners : squares) scene.add(corners);
        expect_seen(scene, frame, true, "turn " + std::to_string(turn));
        if (HasFatalFailure()) return;
        for (std::size_t i = squares.size() - 1; i > 0; --i) {
          std::swap(squares[i], squares[random.bits() % (i + 1)]);
        }
      }
    }
  }
}

/// Sheets that all lie in one plane, each a column further: the first stays as long as it lasts.
TEST_P(VisibleSegments, KeepsTheFirstOfManyInOnePlane) {
  PluginFrame frame;
  for (const int slope : {0, 7}) {
    for (const bool backwards : {false, true}) {
      VisibilityScene scene;
      for (int i = 0; i < 30; ++i) {
        const int x = backwards ? 30 - i : i;
        Corners corners = rectangle(x, i % 3, x + 12, 60 - i % 5, 0, 0, 0, 0);
        for (ScreenVertex& v : corners) v.z = 500 + slope * (v.x + v.y);
        scene.add(corners);
      }
      expect_seen(scene, frame, true, slope == 0 ? "level" : "sloping");
      if (HasFatalFailure()) return;
    }
  }
}

/// Ten planes fan out of one line: all cross in the same place.
TEST_P(VisibleSegments, ShowsAFanOfPlanesThroughOneLine) {
  PluginFrame frame;
  for (const int axis_x : {20, 31}) {
    VisibilityScene scene;
    for (int i = -5; i <= 5; ++i) {
      Corners corners = rectangle(4, 4, 60, 60, 0, 0, 0, 0);
      for (ScreenVertex& v : corners) v.z = 5000 + 40 * i * (v.x - axis_x);
      scene.add(corners);
    }
    expect_seen(scene, frame, true, "axis " + std::to_string(axis_x));
  }
}

TEST_P(VisibleSegments, DrawsAnEmptyLineBetweenFullOnes) {
  // Nothing of the first group may be left over when the second one starts.
  VisibilityScene scene;
  for (const int y : {2, 30, 50}) {
    for (int i = 0; i < 4; ++i) scene.add(rectangle(5 + 3 * i, y, 40 + i, y + 9 - i, 100 - 7 * i, 0, 0, 0));
  }
  expect_seen(scene, {}, true, "groups");
}

/// What hides a part of a polygon must not change the colours of the rest.
TEST_P(VisibleSegments, KeepsTheColoursOfAPartlyHiddenPolygon) {
  Random random(106);
  for (int i = 0; i < 100; ++i) {
    Corners shaded = random_polygon(random, k_shapes[i % 5], 0, 63, 0, 63);
    for (const Attribute attribute : k_attributes) make_planar(random, shaded, attribute, 250);
    for (ScreenVertex& v : shaded) v.z += 1000;
    std::vector<PluginPolygon> scene = {plugin_polygon(shaded)};
    const PluginPicture alone = driver.draw({}, scene);
    std::vector<Corners> screens;
    for (int k = 0; k < 6; ++k) {
      Corners screen = random_polygon(random, Shape::triangle, 0, 63, 0, 63);
      for (ScreenVertex& v : screen) v.z = 10 + k, v.r = 255, v.g = 251, v.b = 254;
      screens.push_back(screen);
      scene.push_back(plugin_polygon(screen));
    }
    const PluginPicture hidden = driver.draw({}, scene);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const bool covered = std::any_of(screens.begin(), screens.end(),
                                         [&](const Corners& s) { return reference::covers(s, 0, x, y); });
        const auto expected = covered ? std::array<std::uint8_t, 3>{255, 251, 254} : alone.at(x, y);
        ASSERT_EQ(hidden.at(x, y), expected) << "scene " << i << " at " << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace farop::test
