// SPDX-License-Identifier: GPL-3.0-or-later
// The files that a student starts from. (The z-buffers also run through rasterizer_test.cpp.)
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "plugins/plugin_cases.h"
#include "plugins/rasterizers.h"

namespace farop::test {
namespace {

TEST(FirstFiles, ZBuffersStayBelowFiftyLines) {
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FAROP_SOURCE_DIR "/docs/rasterizers")) {
    if (entry.path().stem() != "zbuffer") continue;
    ++seen;
    std::ifstream file(entry.path());
    int lines = 0;
    for (std::string line; std::getline(file, line); ++lines) {
      EXPECT_LE(line.size(), 120u) << entry.path() << ":" << lines + 1;
    }
    EXPECT_LT(lines, 50) << entry.path();
  }
  EXPECT_EQ(seen, 6);  // C, C++, Rust, Zig, Python, Fortran
}

TEST(FirstFiles, DotsDrawOnePixelPerCorner) {
  const std::vector<TestedRasterizer> rasterizers = {FAROP_DOTS_RASTERIZERS};
  if (rasterizers.empty()) GTEST_SKIP() << "none of their compilers is here";
  for (const TestedRasterizer& rasterizer : rasterizers) {
    SCOPED_TRACE(rasterizer.name);
    PluginDriver driver(rasterizer.library);
    EXPECT_EQ(driver.table().name, rasterizer.name);
    for (const int bits : {0, 3}) {
      PluginFrame frame;
      frame.width = 21, frame.height = 9, frame.subpixel_bits = bits;
      const Corners corners = {vertex(0, 0, 0, 1, 2, 3), vertex(20 << bits, 0, 0, 255, 128, 127),
                               vertex(20 << bits, 8 << bits, 0, 7, 8, 9),
                               vertex(5 << bits, 4 << bits, 0, 200, 0, 1)};
      for (int turn = 0; turn < 2; ++turn) {
        const PluginPicture picture = driver.draw(frame, std::vector{plugin_polygon(corners)});
        for (int y = 0; y < frame.height; ++y) {
          for (int x = 0; x < frame.width; ++x) {
            std::array<std::uint8_t, 3> expected = frame.background;
            for (const ScreenVertex& v : corners) {
              if (v.x >> bits == x && v.y >> bits == y) {
                expected = {static_cast<std::uint8_t>(v.r), static_cast<std::uint8_t>(v.g),
                            static_cast<std::uint8_t>(v.b)};
              }
            }
            EXPECT_EQ(picture.at(x, y), expected) << x << " " << y;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace farop::test
