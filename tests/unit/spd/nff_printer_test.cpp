// SPDX-License-Identifier: GPL-3.0-or-later
#include "spd/nff_printer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace farop::test {
namespace {

std::string polygon_text(const std::vector<V3d>& corners) {
  std::string text;
  const TextFunction out = [&text](std::string_view block) { text += block; };
  const ProgressFunction no_progress;
  NffPrinter printer({}, 1, out, no_progress);
  printer.polygon(corners);
  printer.finish();
  return text;
}

std::string as_c_prints(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

TEST(Numbers, ArePrintedAsCPrintsThem) {
  std::mt19937_64 random(20240611);
  std::vector<double> values = {0.0,          -0.0,       1.0,
                                -1.0,         0.1,        1e-4,
                                9.9999949e-5, 9.99999e-5, 123456.0,
                                999999.5,     1234567.0,  1e6,
                                0.0001234565, 2.5e-310,   -1.7976931348623157e308,
                                5e-324,       1.0 / 3,    0.30000000000000004,
                                100000.0};
  for (int i = 0; i < 100000; ++i) {
    const double any = std::bit_cast<double>(random());
    if (any - any == 0) values.push_back(any);
    values.push_back(static_cast<double>(random() % 8000000) / 1000.0 - 4000);
  }
  for (const double value : values)
    ASSERT_EQ(CornerLine({value, 1, -0.0}).text(), as_c_prints(value) + " 1 -0\n");
}

TEST(PolygonCleanUp, KeepsCornersThatAreApart) {
  EXPECT_EQ(polygon_text({{0, 0, 0}, {2e-6, 0, 0}, {0, 1, 0}}), "p 3\n0 0 0\n2e-06 0 0\n0 1 0\n");
}

TEST(PolygonCleanUp, DropsTheFirstOfTwoCloseCorners) {
  EXPECT_EQ(polygon_text({{0, 0, 0}, {1, 0, 0}, {1, 5e-7, 0}, {1, 1, 0}}), "p 3\n0 0 0\n1 5e-07 0\n1 1 0\n");
}

TEST(PolygonCleanUp, DropsTheLastCornerWhenItMeetsTheFirst) {
  EXPECT_EQ(polygon_text({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}}), "p 3\n0 0 0\n1 0 0\n1 1 0\n");
}

TEST(PolygonCleanUp, DropsWholeRunsOfCloseCorners) {
  EXPECT_EQ(polygon_text({{9, 9, 9}, {9, 9, 9}, {9, 9, 9}, {1, 0, 0}, {1, 1, 0}}),
            "p 3\n9 9 9\n1 0 0\n1 1 0\n");
}

TEST(PolygonCleanUp, PrintsNothingWhenFewerThanThreeCornersAreLeft) {
  EXPECT_EQ(polygon_text({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), "");
  EXPECT_EQ(polygon_text({{1, 1, 1}, {1, 1, 1}, {2, 1, 1}, {2, 1, 1}}), "");
  EXPECT_EQ(polygon_text({}), "");
}

}  // namespace
}  // namespace farop::test
