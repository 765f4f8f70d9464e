// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/ppm_reader.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "export/ppm_writer.h"
#include "test_files.h"

namespace farop {
namespace {

class Ppm : public testing::Test {
 protected:
  Framebuffer read(const std::string& bytes) {
    test::write_bytes(path_, bytes);
    return read_ppm(path_);
  }
  std::string message(const std::string& bytes) {
    try {
      read(bytes);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::input);
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(path_ + ": "));
      return what.substr(path_.size() + 2);
    }
    return "no error";
  }
  test::TemporaryFolder folder_;
  std::string path_ = folder_ / "picture.ppm";
};

TEST_F(Ppm, IsReadTopRowFirst) {
  const Framebuffer picture = read("P6\n# a comment\n2\t1 # another\n255\nabcdef");
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(std::string(picture.rgb.begin(), picture.rgb.end()), "abcdef");
  const Framebuffer column = read("P6 1 2 255 abcdef");
  EXPECT_EQ(std::string(column.rgb.begin(), column.rgb.end()), "defabc");
}

TEST_F(Ppm, ComesBackAsItWasWritten) {
  Framebuffer picture;
  picture.width = 3, picture.height = 5;
  for (int i = 0; i < 45; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(i * 37));
  write_ppm(path_, picture);
  const Framebuffer again = read_ppm(path_);
  EXPECT_EQ(again.width, 3);
  EXPECT_EQ(again.rgb, picture.rgb);
}

TEST_F(Ppm, IsScaledTo255LevelsFromAnyMaximum) {
  const auto bytes = [](const Framebuffer& picture) {
    return std::vector<int>(picture.rgb.begin(), picture.rgb.end());
  };
  EXPECT_EQ(bytes(read(std::string("P6 1 1 1 \0\1\1", 12))), (std::vector{0, 255, 255}));
  EXPECT_EQ(bytes(read(std::string("P6 1 1 127 \0\100\177", 14))), (std::vector{0, 129, 255}));
  // Two bytes, the higher one first: 0, 32768, 65535.
  EXPECT_EQ(bytes(read(std::string("P6 1 1 65535 \0\0\200\0\377\377", 19))), (std::vector{0, 128, 255}));
  EXPECT_EQ(bytes(read(std::string("P6 1 1 127 \377\0\0", 14))), (std::vector{255, 0, 0}))
      << "beyond the maximum";
}

TEST_F(Ppm, DepthsComeInOneByteOrTwo) {
  test::write_bytes(path_, std::string("P5 2 2 511 \0\1\0\2\1\0\1\377", 19));
  const DepthPicture depths = read_depth_pgm(path_);
  EXPECT_EQ(depths.maximum, 511);
  EXPECT_EQ(depths.z, (std::vector<std::uint16_t>{256, 511, 1, 2})) << "bottom row first";
  test::write_bytes(path_, std::string("P5 2 1 9 \3\4", 11));
  EXPECT_EQ(read_depth_pgm(path_).z, (std::vector<std::uint16_t>{3, 4}));
}

TEST_F(Ppm, IsRefusedWithWhatWasFoundAndExpected) {
  EXPECT_EQ(message(""), "begins with '', expected P6, a binary PPM");
  EXPECT_EQ(message("P3 1 1 255 1 2 3"), "begins with 'P3', expected P6, a binary PPM");
  EXPECT_EQ(message("P6 0 1 255 "), "has the width '0', expected 1..32767");
  EXPECT_EQ(message("P6 1 -1 255 "), "has the height '-1', expected 1..32767");
  EXPECT_EQ(message("P6 1 32768 255 "), "has the height '32768', expected 1..32767");
  EXPECT_EQ(message("P6 99999999999999999999 1 255 "),
            "has the width '99999999999999999', expected 1..32767");
  EXPECT_EQ(message("P6 1"), "has the height '', expected 1..32767");
  EXPECT_EQ(message("P6 1 1 65536 abcdef"), "has the maximum '65536', expected 1..65535");
  EXPECT_EQ(message("P6 1 1 65535 abc"), "has 3 bytes behind its header, expected 6: 6 a pixel");
  EXPECT_EQ(message("P5 1 1 255 a"), "begins with 'P5', expected P6, a binary PPM");
  EXPECT_EQ(message("P6 2 2 255 abc"), "has 3 bytes behind its header, expected 12: 3 a pixel");
  EXPECT_EQ(message("P6 1 1 255 abcd"), "has 4 bytes behind its header, expected 3: 3 a pixel");
  EXPECT_EQ(message("P6 32767 32767 255 "), "has 0 bytes behind its header, expected 3221028867: 3 a pixel");
}

}  // namespace
}  // namespace farop
