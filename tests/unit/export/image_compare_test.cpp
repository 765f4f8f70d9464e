// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/image_compare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <regex>

#include "core/framebuffer.h"
#include "export/image_reader.h"
#include "export/image_writer.h"
#include "test_files.h"

namespace farop::test {
namespace {

Framebuffer grey_picture(int width, int height, std::uint8_t level) {
  Framebuffer picture;
  picture.width = width, picture.height = height;
  picture.rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), level);
  return picture;
}

/// 10 x 10 pixels of level 100; `b` differs by 10 in the green of (5, 8) and by 40 in the blue of (7, 2), y
/// up.
class CompareImages : public ::testing::Test {
 protected:
  CompareImages() {
    Framebuffer picture = grey_picture(10, 10, 100);
    write_image(a, picture);
    picture.rgb[3 * picture.pixel(5, 8) + 1] = 110;
    picture.rgb[3 * picture.pixel(7, 2) + 2] = 140;
    write_image(b, picture);
  }

  CompareVerdict verdict(const CompareThresholds& thresholds) const {
    return compare_images(a, b, thresholds).verdict;
  }

  TemporaryFolder folder;
  std::string a = folder / "a.png", b = folder / "b.png";
};

CompareThresholds thresholds(double fail, double fail_percent = 0, double hard_fail = INFINITY,
                             double warn = 1e-6, double warn_percent = 0, double hard_warn = INFINITY) {
  return {fail, fail_percent, hard_fail, warn, warn_percent, hard_warn};
}

TEST_F(CompareImages, GivesTheNumbersComputedByHand) {
  const CompareResult result = compare_images(a, b, thresholds(0.1));
  EXPECT_EQ(result.width, 10);
  EXPECT_EQ(result.height, 10);
  EXPECT_EQ(result.channels, 3);
  EXPECT_NEAR(result.max_error, 40 / 255.0, 1e-6);
  EXPECT_EQ(result.max_x, 7);
  EXPECT_EQ(result.max_row, 7);  // row 2 from the bottom of ten
  EXPECT_EQ(result.max_channel, "B");
  EXPECT_NEAR(result.mean_error, (10 + 40) / 255.0 / 300, 1e-8);
  const double rms = std::sqrt((10.0 * 10 + 40 * 40) / (255 * 255) / 300);
  EXPECT_NEAR(result.rms_error, rms, 1e-7);
  EXPECT_NEAR(result.psnr, 20 * std::log10(1 / rms), 1e-4);
  EXPECT_EQ(result.fail_pixels, 1u);
  EXPECT_EQ(result.warn_pixels, 2u);
  EXPECT_EQ(result.verdict, CompareVerdict::fail);
}

TEST_F(CompareImages, FindsAPictureEqualToItself) {
  const CompareResult result = compare_images(a, a, {}, folder / "diff.png");
  EXPECT_EQ(result.verdict, CompareVerdict::ok);
  EXPECT_EQ(result.max_error, 0);
  EXPECT_EQ(result.max_channel, "");
  EXPECT_TRUE(std::isinf(result.psnr));
  EXPECT_EQ(result.difference_scale, 1);
  for (const float v : read_image(folder / "diff.png").values) ASSERT_EQ(v, 0);
}

TEST_F(CompareImages, DecidesByThresholdsAsDocumentedForIdiff) {
  constexpr auto k_ok = CompareVerdict::ok, k_warn = CompareVerdict::warn, k_fail = CompareVerdict::fail;
  EXPECT_EQ(verdict({}), k_fail);
  EXPECT_EQ(verdict(thresholds(0.1)), k_fail);
  EXPECT_EQ(verdict(thresholds(1e-6, 2)), k_warn);  // 2 of 100 pixels may fail
  EXPECT_EQ(verdict(thresholds(1e-6, 1.99)), k_fail);
  EXPECT_EQ(verdict(thresholds(0.1, 1)), k_warn);
  EXPECT_EQ(verdict(thresholds(0.2)), k_warn);
  EXPECT_EQ(verdict(thresholds(0.2, 0, INFINITY, 0.2)), k_ok);
  EXPECT_EQ(verdict(thresholds(0.2, 0, INFINITY, 0.1)), k_warn);
  EXPECT_EQ(verdict(thresholds(0.2, 0, INFINITY, 0.1, 1)), k_ok);
  EXPECT_EQ(verdict(thresholds(0.2, 0, INFINITY, 1e-6, 1)), k_warn);
  EXPECT_EQ(verdict(thresholds(1, 100, 0.15, 1)), k_fail);  // any one pixel
  EXPECT_EQ(verdict(thresholds(1, 100, 0.16, 1)), k_ok);
  EXPECT_EQ(verdict(thresholds(1, 0, INFINITY, 1, 100, 0.15)), k_warn);
  EXPECT_EQ(verdict(thresholds(1, 0, INFINITY, 1, 100, 0.16)), k_ok);
}

TEST_F(CompareImages, WritesTheDifferenceScaledToWhite) {
  const CompareResult result = compare_images(a, b, {}, folder / "diff.ppm");
  EXPECT_NEAR(result.difference_scale, 255 / 40.0, 1e-4);
  const Image difference = read_image(folder / "diff.ppm");
  ASSERT_EQ(difference.width, 10);
  ASSERT_EQ(difference.height, 10);
  for (int row = 0; row < 10; ++row) {
    for (int x = 0; x < 10; ++x) {
      for (int c = 0; c < 3; ++c) {
        float expected = 0;
        if (x == 7 && row == 7 && c == 2) expected = 255;
        if (x == 5 && row == 1 && c == 1) expected = 64;  // 10/40 of 255, rounded
        ASSERT_FLOAT_EQ(255 * difference.value(x, row, c), expected) << x << ' ' << row << ' ' << c;
      }
    }
  }
}

TEST_F(CompareImages, ShowsDifferencesOfOneChannelInGrey) {
  Framebuffer picture;
  picture.width = 2, picture.height = 1;
  picture.depth = {10, 20};
  write_depth(folder / "z1.exr", picture);
  picture.depth = {10, 24};
  write_depth(folder / "z2.exr", picture);
  const CompareResult result = compare_images(folder / "z1.exr", folder / "z2.exr", {}, folder / "diff.ppm");
  EXPECT_EQ(result.max_error, 4);
  EXPECT_EQ(result.max_x, 1);
  EXPECT_EQ(result.max_channel, "Z");
  EXPECT_EQ(result.difference_scale, 0.25);
  EXPECT_EQ(file_bytes(folder / "diff.ppm"), std::string("P6\n2 1\n255\n\0\0\0\xFF\xFF\xFF", 17));
}

TEST_F(CompareImages, ComparesAcrossFormats) {
  Framebuffer picture = grey_picture(256, 1, 0);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = static_cast<std::uint8_t>(i / 3);
  write_image(folder / "ramp.png", picture);
  write_image(folder / "ramp.exr", picture);
  write_image(folder / "ramp.ppm", picture);
  EXPECT_EQ(compare_images(folder / "ramp.png", folder / "ramp.exr", {}).verdict, CompareVerdict::ok);
  EXPECT_EQ(compare_images(folder / "ramp.png", folder / "ramp.ppm", {}).max_error, 0);
}

TEST_F(CompareImages, FailsOnAValueThatIsNoNumberInOnePictureOnly) {
  Framebuffer picture;
  picture.width = 2, picture.height = 1;
  picture.depth = {10, 20};
  write_depth(folder / "z.exr", picture);
  picture.depth = {10, std::numeric_limits<float>::quiet_NaN()};
  write_depth(folder / "nan.exr", picture);
  EXPECT_EQ(
      compare_images(folder / "z.exr", folder / "nan.exr", thresholds(1000), folder / "diff.ppm").verdict,
      CompareVerdict::fail);
  EXPECT_EQ(file_bytes(folder / "diff.ppm"), std::string("P6\n2 1\n255\n\0\0\0\xFF\xFF\xFF", 17));
  EXPECT_EQ(compare_images(folder / "nan.exr", folder / "nan.exr", {}).verdict, CompareVerdict::ok);
}

TEST_F(CompareImages, NamesBothSizesWhenTheyDiffer) {
  write_image(folder / "c.png", grey_picture(10, 9, 100));
  Error error = error_of([&] { compare_images(a, folder / "c.png", {}); });
  EXPECT_EQ(error.status(), ExitStatus::input);
  EXPECT_EQ(error.what(),
            fmt::format("pictures differ in size: {} has 10 x 10 pixels of 3 channels, {} has 10 x 9 "
                        "pixels of 3 channels",
                        a, folder / "c.png"));
  Framebuffer depth = grey_picture(10, 10, 0);
  depth.depth.assign(100, 1);
  write_depth(folder / "z.exr", depth);
  error = error_of([&] { compare_images(a, folder / "z.exr", {}); });
  EXPECT_EQ(error.status(), ExitStatus::input);
  EXPECT_NE(std::string(error.what()).find("of 1 channel"), std::string::npos) << error.what();
}

TEST_F(CompareImages, RefusesWhatIsNoPictureAndADifferenceItCannotWrite) {
  write_bytes(folder / "text.png", "no picture\n");
  EXPECT_EQ(error_of([&] { compare_images(a, folder / "text.png", {}); }).status(), ExitStatus::input);
  EXPECT_EQ(error_of([&] { compare_images(folder / "none.png", a, {}); }).status(), ExitStatus::input);
  EXPECT_EQ(error_of([&] { compare_images(a, b, {}, folder / "diff.doc"); }).status(), ExitStatus::usage);
}

TEST_F(CompareImages, NoticesThatAFileWasReplaced) {
  EXPECT_EQ(compare_images(a, b, {}).verdict, CompareVerdict::fail);
  std::filesystem::copy_file(a, b, std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(compare_images(a, b, {}).verdict, CompareVerdict::ok);
}

struct IdiffRun {
  int status = -1;
  std::string output;
};

IdiffRun run_idiff(const std::string& arguments) {
  IdiffRun run;
  std::FILE* pipe = ::popen(("idiff -v " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return run;
  char block[512];
  while (const std::size_t got = std::fread(block, 1, sizeof block, pipe)) run.output.append(block, got);
  run.status = WEXITSTATUS(::pclose(pipe));
  return run;
}

double number_behind(const std::string& text, const std::string& label) {
  const std::size_t at = text.find(label);
  if (at == std::string::npos) return NAN;
  return std::strtod(text.c_str() + at + label.size(), nullptr);
}

TEST_F(CompareImages, AgreesWithIdiff) {
  if (std::system("idiff --help > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "idiff (openimageio-tools) is not installed";
  struct Case {
    const char* arguments;
    CompareThresholds thresholds;
  };
  // In all of them some pixel is over -fail: without any, idiff 2.4 looks at no other threshold.
  const Case cases[] = {
      {"", {}},
      {"-fail 0.1", thresholds(0.1)},
      {"-failpercent 2", thresholds(1e-6, 2)},
      {"-failpercent 1.99", thresholds(1e-6, 1.99)},
      {"-fail 0.1 -failpercent 1", thresholds(0.1, 1)},
      {"-failpercent 5 -hardfail 0.1", thresholds(1e-6, 5, 0.1)},
      {"-failpercent 5 -hardfail 0.2", thresholds(1e-6, 5, 0.2)},
      {"-failpercent 5 -warn 0.2", thresholds(1e-6, 5, INFINITY, 0.2)},
      {"-failpercent 5 -warn 0.1", thresholds(1e-6, 5, INFINITY, 0.1)},
      {"-failpercent 5 -warn 0.1 -warnpercent 1", thresholds(1e-6, 5, INFINITY, 0.1, 1)},
      {"-failpercent 5 -warnpercent 5 -hardwarn 0.1", thresholds(1e-6, 5, INFINITY, 1e-6, 5, 0.1)},
  };
  for (const Case& c : cases) {
    const IdiffRun idiff = run_idiff(fmt::format("{} '{}' '{}'", c.arguments, a, b));
    const CompareResult ours = compare_images(a, b, c.thresholds);
    EXPECT_EQ(static_cast<int>(ours.verdict), idiff.status) << c.arguments << '\n' << idiff.output;
    EXPECT_NEAR(ours.mean_error, number_behind(idiff.output, "Mean error = "), 1e-8);
    EXPECT_NEAR(ours.rms_error, number_behind(idiff.output, "RMS error = "), 1e-7);
    EXPECT_NEAR(ours.psnr, number_behind(idiff.output, "Peak SNR = "), 1e-4);
    EXPECT_NEAR(ours.max_error, number_behind(idiff.output, "Max error  = "), 1e-6);
    EXPECT_NE(idiff.output.find(fmt::format("@ ({}, {}, {})", ours.max_x, ours.max_row, ours.max_channel)),
              std::string::npos)
        << idiff.output;
    EXPECT_NE(idiff.output.find(fmt::format("{} pixels ({}%) over {:g}\n", ours.fail_pixels, ours.fail_pixels,
                                            c.thresholds.fail)),
              std::string::npos)
        << idiff.output;
  }
}

}  // namespace
}  // namespace farop::test
