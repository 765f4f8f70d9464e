// SPDX-License-Identifier: GPL-3.0-or-later
// What only scanline_fill promises: exact values, rounded once, and a trace of the table of the lecture.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "plugins/plugin_cases.h"

namespace farop::test {
namespace {

/// round(v) with halves rounded up.
std::int64_t nearest(const reference::Rational& v) {
  return static_cast<std::int64_t>(floor_div<Int128>(2 * v.numerator + v.denominator, 2 * v.denominator));
}

TEST(ScanlineFill, RoundsTheExactColourToNearest) {
  Random random(41);
  PluginDriver driver(FAROP_SCANLINE_FILL);
  for (int i = 0; i < 400; ++i) {
    PluginFrame frame;
    frame.width = i % 3 == 0 ? 700 : 40, frame.height = i % 5 == 0 ? 300 : 30;
    Corners corners = random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1);
    for (const Attribute attribute : k_attributes) scatter(random, corners, attribute, 255);
    const auto red = exact_attribute(corners, Attribute::r), blue = exact_attribute(corners, Attribute::b);
    const PluginPicture picture = driver.draw(frame, std::vector{plugin_polygon(corners)});
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        if (!reference::covers(corners, 0, x, y)) continue;
        ASSERT_EQ(picture.at(x, y)[0], nearest(red->at(0, x, y))) << i << " at " << x << " " << y;
        ASSERT_EQ(picture.at(x, y)[2], nearest(blue->at(0, x, y))) << i << " at " << x << " " << y;
      }
    }
  }
}

TEST(ScanlineFill, RoundsTheExactDepthToNearestAtEveryResolution) {
  Random random(42);
  PluginDriver driver(FAROP_SCANLINE_FILL);
  for (const std::int32_t z_far : {511, 65535, (1 << 24) - 1, (1 << 30) - 1}) {
    for (int i = 0; i < 40; ++i) {
      PluginFrame frame;
      frame.width = i == 0 ? 32767 : 20, frame.height = i == 1 ? 32767 : 20;
      frame.z_far = z_far;
      Corners corners = random_polygon(random, Shape::triangle, 0, frame.width - 1, 0, frame.height - 1);
      scatter(random, corners, Attribute::z, z_far);
      if (i % 4 < 2) corners[0].z = 0, corners[1].z = z_far;
      std::vector<Sample> samples;
      for (int k = 0; k < frame.width * frame.height; k += frame.width == frame.height ? 1 : 1009) {
        const Sample sample = {k % frame.width, k / frame.width};
        if (reference::covers(corners, 0, sample.x, sample.y)) samples.push_back(sample);
      }
      const auto exact = exact_attribute(corners, Attribute::z);
      const auto shows = measured_depth(driver, frame, {plugin_polygon(corners)}, samples);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        ASSERT_EQ(shows[k] + 1, nearest(exact->at(0, samples[k].x, samples[k].y)));
      }
    }
  }
}

/// The example of the slides: "0 2 4 6 1" for the left edge, crossings 1.14 and 8.5 on line 5.
TEST(ScanlineFill, TracesThePolygonOfTheLecture) {
  PluginDriver driver(FAROP_SCANLINE_FILL, {{"trace", "yes"}});
  driver.draw({}, std::vector{plugin_polygon(
                      {vertex(0, 1), vertex(2, 8), vertex(4, 6), vertex(7, 8), vertex(9, 4), vertex(6, 1)})});
  EXPECT_EQ(driver.logs, (std::vector<std::string>{
                             "y 1: x from 0 + 0/7 to 6 + 0/3, pixels 0..5",
                             "y 2: x from 0 + 2/7 to 7 + 0/3, pixels 1..6",
                             "y 3: x from 0 + 4/7 to 8 + 0/3, pixels 1..7",
                             "y 4: x from 0 + 6/7 to 9 + 0/4, pixels 1..8",
                             "y 5: x from 1 + 1/7 to 8 + 2/4, pixels 2..8",
                             "y 6: x from 1 + 3/7 to 4 + 0/2, pixels 2..3",
                             "y 6: x from 4 + 0/2 to 8 + 0/4, pixels 4..7",
                             "y 7: x from 1 + 5/7 to 3 + 0/2, pixels 2..2",
                             "y 7: x from 5 + 1/2 to 7 + 2/4, pixels 6..7",
                         }));
}

TEST(ScanlineFill, IsSilentUnlessAsked) {
  PluginDriver driver(FAROP_SCANLINE_FILL, {{"trace", "no"}});
  driver.draw({}, std::vector{plugin_polygon({vertex(0, 1), vertex(20, 8), vertex(4, 60)})});
  EXPECT_TRUE(driver.logs.empty());
}

}  // namespace
}  // namespace farop::test
