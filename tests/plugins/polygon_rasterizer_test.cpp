// SPDX-License-Identifier: GPL-3.0-or-later
// What rasterizers must get right that take polygons of any shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "plugins/plugin_cases.h"
#include "plugins/rasterizers.h"

namespace farop::test {
namespace {

class PolygonRasterizer : public testing::TestWithParam<TestedRasterizer> {
 protected:
  void expect_reference_coverage(const PluginFrame& frame, const Corners& corners) {
    const auto expected = reference::coverage(corners, 0, frame.width, frame.height);
    ASSERT_EQ(drawn_coverage(driver, frame, corners), expected) << text_of(corners);
  }
  /// Row -> columns drawn.
  std::map<int, std::vector<int>> rows(const Corners& corners) {
    const PluginFrame frame;
    const auto covered = drawn_coverage(driver, frame, corners);
    std::map<int, std::vector<int>> rows;
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        if (covered[index_of(x, y, frame.width)] != 0) rows[y].push_back(x);
      }
    }
    return rows;
  }
  static std::string text_of(const Corners& corners) {
    std::string text;
    for (const ScreenVertex& v : corners) {
      text += "(" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + ")";
    }
    return text;
  }
  static std::vector<int> range(int first, int last) {
    std::vector<int> columns;
    for (int x = first; x <= last; ++x) columns.push_back(x);
    return columns;
  }

  PluginDriver driver{GetParam().library};
};

INSTANTIATE_TEST_SUITE_P(, PolygonRasterizer, testing::ValuesIn(polygon_rasterizers()),
                         rasterizer_name<testing::TestParamInfo<TestedRasterizer>>);

// ---- coverage
// ---------------------------------------------------------------------------------------------------

const Corners k_lecture = {vertex(0, 1), vertex(2, 8), vertex(4, 6),
                           vertex(7, 8), vertex(9, 4), vertex(6, 1)};

TEST_P(PolygonRasterizer, FillsThePolygonOfTheLecture) {
  const std::map<int, std::vector<int>> expected = {{1, range(0, 5)}, {2, range(1, 6)}, {3, range(1, 7)},
                                                    {4, range(1, 8)}, {5, range(2, 8)}, {6, range(2, 7)},
                                                    {7, {2, 6, 7}}};
  Corners corners = k_lecture;
  for (int turn = 0; turn < 2; ++turn) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      EXPECT_EQ(rows(corners), expected) << text_of(corners);
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
    std::reverse(corners.begin(), corners.end());
  }
}

TEST_P(PolygonRasterizer, FillsTheLetterF) {
  const Corners letter = {vertex(8, 8),   vertex(16, 8),  vertex(16, 28), vertex(32, 28), vertex(32, 36),
                          vertex(16, 36), vertex(16, 48), vertex(40, 48), vertex(40, 56), vertex(8, 56)};
  std::map<int, std::vector<int>> expected;
  for (int y = 8; y < 56; ++y) expected[y] = range(8, y >= 48 ? 39 : y >= 28 && y < 36 ? 31 : 15);
  EXPECT_EQ(rows(letter), expected);
}

TEST_P(PolygonRasterizer, CoversRandomPolygonsOfEveryShape) {
  Random random(21);
  for (const Shape shape : k_shapes) {
    for (int i = 0; i < 2500; ++i) {
      PluginFrame frame;
      frame.width = random.integer(1, 36), frame.height = random.integer(1, 36);
      expect_reference_coverage(frame,
                                random_polygon(random, shape, 0, frame.width - 1, 0, frame.height - 1));
      if (HasFatalFailure()) return;
    }
  }
}

/// Coordinates so close that most corners coincide, edges run together and polygons turn over.
TEST_P(PolygonRasterizer, CoversPolygonsOnATinyLattice) {
  Random random(22);
  PluginFrame frame;
  frame.width = frame.height = 6;
  for (const Shape shape : k_shapes) {
    for (int i = 0; i < 2500; ++i) {
      expect_reference_coverage(frame, random_polygon(random, shape, 0, 4, 0, 4));
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(PolygonRasterizer, CoversPolygonsWithManyCrossings) {
  Random random(23);
  PluginFrame frame;
  for (int i = 0; i < 60; ++i) {
    Corners corners(static_cast<std::size_t>(random.integer(50, 400)));
    for (ScreenVertex& v : corners) v = vertex(random.integer(0, 63), random.integer(0, 63));
    expect_reference_coverage(frame, corners);
    if (HasFatalFailure()) return;
  }
}

TEST_P(PolygonRasterizer, DrawsNothingWithoutArea) {
  PluginFrame frame;
  const Corners lines[] = {
      {vertex(3, 3), vertex(3, 3), vertex(3, 3), vertex(3, 3)},
      {vertex(2, 9), vertex(30, 9), vertex(60, 9), vertex(11, 9), vertex(5, 9)},
      {vertex(7, 1), vertex(7, 40), vertex(7, 60), vertex(7, 20)},
      {vertex(2, 2), vertex(40, 13), vertex(20, 50), vertex(40, 13)},                // out and back
      {vertex(2, 2), vertex(40, 13), vertex(20, 50), vertex(40, 13), vertex(2, 2)},  // with a repeated corner
  };
  for (const Corners& corners : lines) {
    EXPECT_EQ(drawn_coverage(driver, frame, corners), std::vector<std::uint8_t>(64 * 64)) << text_of(corners);
  }
}

TEST_P(PolygonRasterizer, CutsOutWhatABridgeLeadsTo) {
  // A square with a square hole, joined by a bridge that is horizontal, vertical or slanted.
  const Corners outer = rectangle(4, 4, 60, 60, 0, 0, 0, 0);
  for (const Corners& hole : {Corners{vertex(20, 4), vertex(20, 30), vertex(40, 30), vertex(40, 20)},
                              Corners{vertex(20, 20), vertex(20, 40), vertex(40, 40), vertex(40, 20)},
                              Corners{vertex(31, 17), vertex(13, 30), vertex(50, 41)},
                              Corners{vertex(30, 4), vertex(20, 20), vertex(40, 20)}}) {
    Corners corners = outer;
    corners.push_back(outer[0]);
    corners.insert(corners.end(), hole.begin(), hole.end());
    corners.push_back(hole[0]);
    expect_reference_coverage({}, corners);
    const auto covered = drawn_coverage(driver, {}, corners);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const bool expected = reference::covers(outer, 0, x, y) != reference::covers(hole, 0, x, y);
        ASSERT_EQ(covered[index_of(x, y, 64)] != 0, expected) << x << " " << y;
      }
    }
  }
}

TEST_P(PolygonRasterizer, FillsCombs) {
  PluginFrame frame;
  for (const bool sideways : {false, true}) {
    for (int teeth = 1; teeth <= 15; ++teeth) {
      for (const int gap : {1, 2}) {
        Corners comb = {vertex(1, 1)};
        for (int i = 0; i < teeth; ++i) {
          const int x = 1 + i * (gap + 2), top = 20 + i * 7 % 30;
          for (const auto& [column, row] :
               {std::pair{x, top}, {x + 2, top - i % 2}, {x + 2, 5}, {x + 2 + gap, 5}}) {
            comb.push_back(vertex(column, row));
          }
        }
        comb.push_back(vertex(1 + teeth * (gap + 2), 1));
        for (ScreenVertex& v : comb) {
          if (sideways) std::swap(v.x, v.y);
        }
        expect_reference_coverage(frame, comb);
        std::reverse(comb.begin(), comb.end());
        expect_reference_coverage(frame, comb);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST_P(PolygonRasterizer, TakesTwentyThousandCorners) {
  PluginFrame frame;
  frame.width = 500, frame.height = 60;
  Random random(24);
  Corners few = {vertex(3, 3), vertex(50, 9), vertex(20, 30)}, comb;
  for (int i = 0; i < 9999; ++i) {
    // 40 combs over each other: each sample is inside of an even or odd number of teeth.
    const int x = 2 * (i % 249);
    comb.push_back(vertex(x, random.integer(1, 5)));
    comb.push_back(vertex(x + 1, random.integer(6, 58)));
  }
  expect_reference_coverage(frame, few);
  expect_reference_coverage(frame, comb);
  expect_reference_coverage(frame, few);
}

TEST_P(PolygonRasterizer, SharesTheWindowWithoutGapOrOverlap) {
  // A star and the rest of the window, which goes round it over a bridge.
  Random random(25);
  PluginFrame frame;
  frame.width = frame.height = 41;
  const Corners window = rectangle(0, 0, 40, 40, 0, 0, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const Corners star = random_polygon(random, Shape::star, 0, 40, 0, 40);
    Corners rest = window;
    rest.push_back(window[0]);
    rest.insert(rest.end(), star.rbegin(), star.rend());
    rest.push_back(star.back());
    const auto inside = drawn_coverage(driver, frame, star), outside = drawn_coverage(driver, frame, rest);
    for (int y = 0; y < 41; ++y) {
      for (int x = 0; x < 41; ++x) {
        const std::size_t at = index_of(x, y, 41);
        ASSERT_EQ(inside[at] + outside[at], x < 40 && y < 40 ? 1 : 0) << text_of(star) << x << " " << y;
      }
    }
  }
}

TEST_P(PolygonRasterizer, CoversWhatThePartsOfASplitPolygonCover) {
  Random random(26);
  PluginFrame frame;
  frame.width = frame.height = 41;
  for (int i = 0; i < 500; ++i) {
    // Any chord will do: the parts of a polygon, added up modulo 2, are the polygon.
    const Corners whole = random_polygon(random, i % 2 == 0 ? Shape::star : Shape::tangle, 0, 40, 0, 40);
    if (whole.size() < 4) continue;
    const auto cut = static_cast<std::ptrdiff_t>(random.integer(2, static_cast<int>(whole.size()) - 2));
    const Corners front(whole.begin(), whole.begin() + cut + 1);
    Corners back(whole.begin() + cut, whole.end());
    back.push_back(whole[0]);
    const auto all = drawn_coverage(driver, frame, whole), a = drawn_coverage(driver, frame, front),
               b = drawn_coverage(driver, frame, back);
    for (std::size_t k = 0; k < all.size(); ++k) ASSERT_EQ(all[k], a[k] ^ b[k]) << text_of(whole);
  }
}

// ---- depth and colour
// -------------------------------------------------------------------------------------------

TEST_P(PolygonRasterizer, MeasuresTheDepthOfPlanarPolygons) {
  Random random(27);
  for (const std::int32_t z_far : {511, 65535, (1 << 24) - 1, (1 << 30) - 1}) {
    for (int i = 0; i < 60; ++i) {
      PluginFrame frame;
      frame.width = frame.height = 24;
      frame.z_far = z_far;
      Corners corners = random_polygon(random, k_shapes[i % 5], 0, 23, 0, 23);
      make_planar(random, corners, Attribute::z, z_far);
      const auto exact = exact_attribute(corners, Attribute::z);
      if (!exact) continue;  // no area
      std::vector<Sample> samples;
      for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 24; ++x) {
          if (reference::covers(corners, 0, x, y)) samples.push_back({x, y});
        }
      }
      const auto shows = measured_depth(driver, frame, {plugin_polygon(corners)}, samples);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        ASSERT_TRUE(exact->at(0, samples[k].x, samples[k].y).is_within(shows[k] + 1, 1))
            << text_of(corners) << " at " << samples[k].x << " " << samples[k].y << ": " << shows[k] + 1;
      }
    }
  }
}

TEST_P(PolygonRasterizer, InterpolatesThePlanarColourOfPolygons) {
  Random random(28);
  for (int i = 0; i < 500; ++i) {
    Corners corners = random_polygon(random, k_shapes[i % 5], 0, 63, 0, 63);
    for (const Attribute attribute : k_attributes) make_planar(random, corners, attribute, 255);
    std::array<std::optional<reference::AffineFunction>, 3> exact = {exact_attribute(corners, Attribute::r),
                                                                     exact_attribute(corners, Attribute::g),
                                                                     exact_attribute(corners, Attribute::b)};
    if (!exact[0]) continue;  // no area
    const PluginPicture picture = driver.draw({}, std::vector{plugin_polygon(corners)});
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (!reference::covers(corners, 0, x, y)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_TRUE(exact[k]->at(0, x, y).is_within(picture.at(x, y)[k], 1))
              << text_of(corners) << " at " << x << " " << y;
        }
      }
    }
  }
}

/// Gouraud's interpolation, sample by sample: along the two edges that bound the span to its row, then along
/// the span. In double; the exact value is within 10^-9 of it.
double gouraud(const Corners& corners, int column, int row, Attribute attribute) {
  struct Crossing {
    double x, value;
  };
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ScreenVertex *low = &corners[i], *high = &corners[(i + 1) % corners.size()];
    if (low->y > high->y) std::swap(low, high);
    if (row < low->y || row >= high->y) continue;
    const double t = static_cast<double>(row - low->y) / (high->y - low->y);
    const auto from = static_cast<double>(value_of(*low, attribute)),
               to = static_cast<double>(value_of(*high, attribute));
    crossings.push_back({low->x + t * (high->x - low->x), from + t * (to - from)});
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const Crossing &left = crossings[i], &right = crossings[i + 1];
    if (column < left.x - 1e-9 || column >= right.x - 1e-9) continue;
    return left.value + (column - left.x) * (right.value - left.value) / (right.x - left.x);
  }
  return -1000;  // not covered
}

TEST_P(PolygonRasterizer, InterpolatesAnyColourByScanLines) {
  Random random(29);
  for (int i = 0; i < 400; ++i) {
    // Corners on rows of their own and a convex or concave outline: no two crossings of a row coincide but at
    // tips.
    Corners corners = random_polygon(random, Shape::star, 0, 63, 0, 63);
    for (const Attribute attribute : k_attributes) scatter(random, corners, attribute, 255);
    const PluginPicture picture = driver.draw({}, std::vector{plugin_polygon(corners)});
    int low[3] = {255, 255, 255}, high[3] = {0, 0, 0};
    for (const ScreenVertex& v : corners) {
      for (int k = 0; k < 3; ++k) {
        const auto value = static_cast<int>(value_of(v, k_attributes[k + 1]));
        low[k] = std::min(low[k], value), high[k] = std::max(high[k], value);
      }
    }
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (!reference::covers(corners, 0, x, y)) continue;
        for (int k = 0; k < 3; ++k) {
          const int got = picture.at(x, y)[static_cast<std::size_t>(k)];
          ASSERT_GE(got, low[k]);
          ASSERT_LE(got, high[k]);
          ASSERT_NEAR(got, gouraud(corners, x, y, k_attributes[k + 1]), 1 - 1e-6)
              << text_of(corners) << " at " << x << " " << y << " component " << k;
        }
      }
    }
  }
}

TEST_P(PolygonRasterizer, ShowsEveryBarOfARing) {
  // Four bars, each over the next: no order of whole polygons is right.
  const auto bar = [](int x1, int y1, int x2, int y2, int shade) {
    return rectangle(x1, y1, x2, y2, 0, shade, 0, 0);
  };
  std::array<Corners, 4> bars = {bar(8, 8, 56, 16, 50), bar(48, 8, 56, 56, 90), bar(8, 48, 56, 56, 130),
                                 bar(8, 8, 16, 56, 170)};
  for (ScreenVertex& v : bars[0]) v.z = 64 + 5 * v.x;         // near on the left: over bar 3
  for (ScreenVertex& v : bars[1]) v.z = 64 + 5 * v.y;         // near at the bottom: over bar 0
  for (ScreenVertex& v : bars[2]) v.z = 64 + 5 * (64 - v.x);  // near on the right: over bar 1
  for (ScreenVertex& v : bars[3]) v.z = 64 + 5 * (64 - v.y);  // near at the top: over bar 2
  std::array<int, 4> order = {0, 1, 2, 3};
  do {
    std::vector<PluginPolygon> scene;
    for (const int i : order) scene.push_back(plugin_polygon(bars[static_cast<std::size_t>(i)]));
    const PluginPicture picture = driver.draw({}, scene);
    const auto expect_square = [&](int x0, int y0, int shade) {
      for (int y = y0; y < y0 + 7; ++y) {
        for (int x = x0; x < x0 + 7; ++x) ASSERT_EQ(picture.at(x, y)[0], shade) << x << " " << y;
      }
    };
    expect_square(8, 9, 50);
    expect_square(49, 8, 90);
    expect_square(49, 49, 130);
    expect_square(8, 49, 170);
  } while (std::next_permutation(order.begin(), order.end()));
}

// ---- manners
// ----------------------------------------------------------------------------------------------------

TEST_P(PolygonRasterizer, RefusesCornersOutsideTheFrame) {
  for (const ScreenVertex& outside : {vertex(-1, 5), vertex(64, 5), vertex(5, -1), vertex(5, 64),
                                      vertex(1 << 30, 5), vertex(5, -(1 << 30))}) {
    EXPECT_THROW(driver.draw({}, std::vector{plugin_polygon({vertex(2, 2), vertex(50, 7), outside})}),
                 std::runtime_error);
    EXPECT_EQ(driver.logs.size(), 1u);
  }
  expect_reference_coverage({}, k_lecture);
}

TEST_P(PolygonRasterizer, SurvivesMoreCornersThanAnnounced) {
  PluginFrame frame;
  frame.max_vertices = 3;
  Corners corners;
  for (int i = 0; i < 2000; ++i) corners.push_back(vertex(1 + i % 2 * 50 + i % 7, 1 + i * 60 / 2000));
  try {
    EXPECT_EQ(drawn_coverage(driver, frame, corners), reference::coverage(corners, 0, 64, 64));
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("polygon returned -3"), std::string::npos) << error.what();
  }
  expect_reference_coverage({}, corners);
}

TEST_P(PolygonRasterizer, TakesThousandsOfTinyPolygons) {
  Random random(30);
  PluginFrame frame;
  std::vector<PluginPolygon> scene;
  std::vector<int> expected(64 * 64);
  for (int i = 0; i < 30000; ++i) {
    const int x = random.integer(0, 60), y = random.integer(0, 60);
    Corners corners = random_polygon(random, Shape::triangle, x, x + 2, y, y + 2);
    for (ScreenVertex& v : corners) v.z = 30000 - i;  // ever nearer
    paint(corners, 1 + i % 255, 0, 0);
    scene.push_back(plugin_polygon(corners));
    for (int row = y; row < y + 3; ++row) {
      for (int column = x; column < x + 3; ++column) {
        if (reference::covers(corners, 0, column, row)) expected[index_of(column, row, 64)] = 1 + i % 255;
      }
    }
  }
  const PluginPicture picture = driver.draw(frame, scene);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x)
      ASSERT_EQ(picture.at(x, y)[0], expected[index_of(x, y, 64)]) << x << " " << y;
  }
}

}  // namespace
}  // namespace farop::test
