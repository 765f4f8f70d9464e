// SPDX-License-Identifier: GPL-3.0-or-later
// The rasterizers that the checker must not accuse have no fault: those of other kinds, and those that the
// mutants are made from by one change.
#include <gtest/gtest.h>

#include <algorithm>

#include "conformance/exact_cases.h"
#include "plugins/rasterizers.h"
#include "plugins/visibility.h"

namespace farop::test {
namespace {

class Innocent : public testing::TestWithParam<TestedRasterizer> {
 protected:
  bool takes_polygons() const { return (driver.table().wants & FAROP_WANT_TRIANGLES) == 0; }
  std::vector<Shape> shapes() const {
    return takes_polygons() ? std::vector<Shape>(std::begin(k_shapes), std::end(k_shapes))
                            : std::vector<Shape>{Shape::triangle};
  }
  void expect_exact_coverage(const Corners& corners) {
    const Coverage expected = moved_coverage(corners, k_lb, frame.width, frame.height);
    ASSERT_EQ(drawn_coverage(driver, frame, corners), expected) << text_of(corners);
  }

  PluginDriver driver{GetParam().library};
  PluginFrame frame{23, 19};
};

INSTANTIATE_TEST_SUITE_P(, Innocent, testing::ValuesIn(all_rasterizers()),
                         rasterizer_name<testing::TestParamInfo<TestedRasterizer>>);

TEST_P(Innocent, CoversWhatTheRuleSays) {
  Random random(1);
  for (const Shape shape : shapes()) {
    for (int i = 0; i < (takes_polygons() ? 300 : 1500) && !HasFailure(); ++i) {
      expect_exact_coverage(random_polygon(random, shape, 0, frame.width - 1, 0, frame.height - 1));
    }
  }
}

// In a small range most edges pass through samples and many corners share a row.
TEST_P(Innocent, CoversWhatTheRuleSaysOnASmallLattice) {
  Random random(2);
  frame.width = frame.height = 6;
  for (const Shape shape : shapes()) {
    for (int i = 0; i < 1500 && !HasFailure(); ++i) {
      expect_exact_coverage(random_polygon(random, shape, 0, 5, 0, 5));
    }
  }
}

TEST_P(Innocent, CoversEveryTriangleOfALatticeInAnyOrder) {
  frame.width = frame.height = 4;
  const auto point = [](int i) { return vertex(i % 4, i / 4); };
  for (int a = 0; a < 16 && !HasFailure(); ++a) {
    for (int b = 0; b < 16; ++b) {
      for (int c = 0; c < 16; ++c) expect_exact_coverage({point(a), point(b), point(c)});
    }
  }
}

TEST_P(Innocent, CoversNeedlesAndTheWholeFrame) {
  frame.width = 200, frame.height = 7;
  for (int length = 1; length < 199 && !HasFailure(); ++length) {
    expect_exact_coverage({vertex(0, 3), vertex(length, 4), vertex(length, 3)});
    expect_exact_coverage({vertex(length, 0), vertex(0, 6), vertex(0, 5)});
  }
  expect_exact_coverage({vertex(0, 0), vertex(199, 0), vertex(199, 6)});
}

TEST_P(Innocent, InterpolatesColours) {
  Random random(3);
  for (const Shape shape : shapes()) {
    for (int i = 0; i < 200 && !HasFailure(); ++i) {
      Corners corners = random_polygon(random, shape, 0, frame.width - 1, 0, frame.height - 1);
      constexpr Attribute k_channels[] = {Attribute::r, Attribute::g, Attribute::b};
      for (const Attribute channel : k_channels) {
        shape == Shape::triangle ? scatter(random, corners, channel, 255)
                                 : make_planar(random, corners, channel, 255);
      }
      const PluginPicture picture = driver.draw(frame, std::vector{plugin_polygon(corners)});
      const Coverage covered = moved_coverage(corners, k_lb, frame.width, frame.height);
      for (std::size_t k = 0; k < covered.size() && !HasFailure(); ++k) {
        if (covered[k] == 0) continue;
        const int x = static_cast<int>(k) % frame.width, y = static_cast<int>(k) / frame.width;
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const auto exact = ExactAffine::through(corners, k_channels[channel]);
          ASSERT_TRUE(exact.has_value());
          ASSERT_LT(std::abs(exact->error(picture.at(x, y)[channel], x, y)), 1.001)
              << text_of(corners) << " at " << x << " " << y;
        }
      }
    }
  }
}

// A colour that all corners have in common stays as it is.
TEST_P(Innocent, KeepsFlatColours) {
  Random random(4);
  for (int i = 0; i < 256 && !HasFailure(); ++i) {
    Corners corners = random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1);
    paint(corners, i, 255 - i, 17);
    const PluginPicture picture = driver.draw(frame, std::vector{plugin_polygon(corners)});
    const Coverage covered = moved_coverage(corners, k_lb, frame.width, frame.height);
    for (std::size_t k = 0; k < covered.size(); ++k) {
      if (covered[k] == 0) continue;
      ASSERT_EQ(picture.rgb[3 * k], i);
      ASSERT_EQ(picture.rgb[3 * k + 1], 255 - i);
      ASSERT_EQ(picture.rgb[3 * k + 2], 17);
    }
  }
}

TEST_P(Innocent, InterpolatesDepths) {
  Random random(5);
  for (const std::int32_t z_far : {511, 65535, (1 << 30) - 1}) {
    frame.z_far = z_far;
    for (int i = 0; i < 6 && !HasFailure(); ++i) {
      Corners corners = random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1);
      scatter(random, corners, Attribute::z, z_far);
      const auto exact = ExactAffine::through(corners, Attribute::z);
      if (!exact) continue;
      const Coverage covered = moved_coverage(corners, k_lb, frame.width, frame.height);
      std::vector<Sample> samples;
      for (std::size_t k = 0; k < covered.size(); ++k) {
        if (covered[k] != 0)
          samples.push_back({static_cast<int>(k) % frame.width, static_cast<int>(k) / frame.width});
      }
      const auto depths = measured_depth(driver, frame, {plugin_polygon(corners)}, samples);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        // Between the farthest probe that shows and the next: whichever way ties go, one of the two.
        const double error = exact->error(depths[k], samples[k].x, samples[k].y);
        ASSERT_GT(error, -2.001) << text_of(corners);
        ASSERT_LT(error, 1.001) << text_of(corners);
      }
    }
  }
}

TEST_P(Innocent, ShowsTheNearest) {
  Random random(6);
  frame.z_far = 100000;
  for (int i = 0; i < 60 && !HasFailure(); ++i) {
    VisibilityScene scene;
    for (int k = 0; k < 6; ++k) {
      Corners corners = random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1);
      scatter(random, corners, Attribute::z, frame.z_far);
      scene.add(corners);
    }
    scene.expect_seen(driver.draw(frame, scene.polygons()), frame, false, "scene " + std::to_string(i));
  }
}

// What lies on the far plane shows, and of two equal depths the same one wins everywhere.
TEST_P(Innocent, DecidesTheFarPlaneAndTies) {
  const Corners below = rectangle(0, 0, 20, 15, frame.z_far, 10, 10, 10);
  const Corners above = rectangle(0, 0, 20, 15, frame.z_far, 200, 200, 200);
  std::vector<PluginPolygon> scene;
  for (const Corners& c : {below, above}) {
    scene.push_back(plugin_polygon({c[0], c[1], c[2]}));
    scene.push_back(plugin_polygon({c[0], c[2], c[3]}));
  }
  const PluginPicture picture = driver.draw(frame, scene);
  const int first = picture.at(0, 0)[0];
  EXPECT_TRUE(first == 10 || first == 200);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x)
      EXPECT_EQ(picture.at(x, y)[0], x < 20 && y < 15 ? first : 0) << x << " " << y;
  }
}

}  // namespace
}  // namespace farop::test
