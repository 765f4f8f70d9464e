// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/perf_picture.h"

#include <gtest/gtest.h>

#include <limits>

namespace farop::conformance_report {
namespace {

conformance::PerfResult growth() {
  return {"fill", {1, 10, 100}, {1e-6, 1e-5, 1e-4}, {1e-5, 1e-5, 1e-5}, 1, 0.9, 1.1, 2, 1.5, 2.5};
}

TEST(PerfPicture, DrawsALineOfSlopeOneFromCornerToCorner) {
  const std::string svg = perf_svg(growth(), "time");
  EXPECT_NE(svg.find("<polyline class=\"mine\" points=\"0.00,60.00 50.00,30.00 100.00,0.00 \"/>"),
            std::string::npos)
      << svg;
  EXPECT_NE(svg.find("<polyline class=\"reference\" points=\"0.00,30.00 50.00,30.00 100.00,30.00 \"/>"),
            std::string::npos)
      << svg;
}

TEST(PerfPicture, LeavesOutWhatHasNoLogarithm) {
  conformance::PerfResult perf = growth();
  perf.seconds = {0, -1, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(perf_svg(perf, "time"), "");
  EXPECT_EQ(perf_svg({}, "time"), "");
  perf.seconds = {1, 1, 1};
  perf.sizes = {5, 5, 5};
  EXPECT_EQ(perf_svg(perf, "time").find("nan"), std::string::npos);
}

}  // namespace
}  // namespace farop::conformance_report
