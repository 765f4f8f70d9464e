// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/image_writer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <thread>

#include "captured_output.h"
#include "export/image_reader.h"
#include "test_files.h"

namespace farop::test {
namespace {

/// Every row and column different, so that a picture that is turned, mirrored or shifted cannot pass.
Framebuffer random_picture(int width, int height) {
  std::mt19937 random(1);
  Framebuffer picture;
  picture.width = width, picture.height = height;
  picture.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::uint8_t& c : picture.rgb) c = static_cast<std::uint8_t>(random());
  return picture;
}

std::uint8_t component(const Framebuffer& picture, int x, int y, int channel) {
  return picture.rgb[3 * picture.pixel(x, y) + static_cast<std::size_t>(channel)];
}

const std::vector<std::string> k_lossless{"ppm", "pnm", "png", "exr", "tif", "tiff", "bmp", "tga", "dpx"};

class LosslessImage : public ::testing::TestWithParam<std::string> {};

TEST_P(LosslessImage, HoldsTheValuesAsTheyAreTopRowFirst) {
  const TemporaryFolder folder;
  const Framebuffer picture = random_picture(37, 23);
  const std::string path = folder / ("picture." + GetParam());
  write_image(path, picture);
  const Image read = read_image(path);
  ASSERT_EQ(read.width, 37);
  ASSERT_EQ(read.height, 23);
  ASSERT_EQ(read.channels.size(), 3u);
  for (int row = 0; row < 23; ++row) {
    for (int x = 0; x < 37; ++x) {
      for (int c = 0; c < 3; ++c) {
        // The nearest float or the one beside it: OpenImageIO multiplies by 1/255.
        ASSERT_FLOAT_EQ(read.value(x, row, c), static_cast<float>(component(picture, x, 22 - row, c) / 255.0))
            << x << ' ' << row << ' ' << c;
      }
    }
  }
  EXPECT_EQ(folder.names(), std::set<std::string>{"picture." + GetParam()});
}

TEST_P(LosslessImage, WritesASinglePixel) {
  const TemporaryFolder folder;
  const std::string path = folder / ("dot." + GetParam());
  Framebuffer picture = random_picture(1, 1);
  picture.rgb = {1, 128, 255};
  write_image(path, picture);
  const Image read = read_image(path);
  ASSERT_EQ(read.values.size(), 3u);
  EXPECT_FLOAT_EQ(read.values[0] * 255, 1);
  EXPECT_FLOAT_EQ(read.values[1] * 255, 128);
  EXPECT_FLOAT_EQ(read.values[2] * 255, 255);
}

INSTANTIATE_TEST_SUITE_P(, LosslessImage, ::testing::ValuesIn(k_lossless),
                         [](const auto& tested) { return tested.param; });

std::string expected_ppm(const Framebuffer& picture) {
  std::string bytes =
      "P6\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n";
  for (int y = picture.height - 1; y >= 0; --y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) bytes += static_cast<char>(component(picture, x, y, c));
    }
  }
  return bytes;
}

TEST(ImageWriter, WritesPpmByteForByteInAllWays) {
  const TemporaryFolder folder;
  const Framebuffer picture = random_picture(700, 600);  // more than one block
  const std::string expected = expected_ppm(picture);
  write_image(folder / "a.ppm", picture);
  EXPECT_TRUE(file_bytes(folder / "a.ppm") == expected);
  const auto write = [&](const std::string& path) { write_image(path, picture); };
  EXPECT_TRUE(through_stdout(folder, write) == expected);
  EXPECT_TRUE(through_pipe(folder, "pipe", write) == expected);
  EXPECT_TRUE(through_pipe(folder, "pipe.png", write) == expected);  // a pipe gets PPM whatever its name
}

TEST(ImageWriter, TakesExtensionsInCapitals) {
  const TemporaryFolder folder;
  const Framebuffer picture = random_picture(8, 8);
  write_image(folder / "A.PPM", picture);
  EXPECT_EQ(file_bytes(folder / "A.PPM"), expected_ppm(picture));
  write_image(folder / "A.PNG", picture);
  EXPECT_EQ(file_bytes(folder / "A.PNG").substr(1, 3), "PNG");
}

TEST(ImageWriter, PutsOnlyPixelsIntoAPng) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", random_picture(30, 20));
  const std::string png = file_bytes(folder / "a.png");
  std::set<std::string> chunks;
  for (std::size_t at = 8; at + 8 <= png.size();) {
    const auto byte = [&](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(png[at + i]));
    };
    chunks.insert(png.substr(at + 4, 4));
    at += 12 + (byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3));
  }
  // No gAMA, sRGB or iCCP, which would have viewers change the values; no tIME, no tEXt.
  chunks.erase("oFFs");  // the picture's place on a page: 0, 0
  EXPECT_EQ(chunks, (std::set<std::string>{"IHDR", "IDAT", "IEND"}));
}

TEST(ImageWriter, WritesEqualPicturesAsEqualFilesAtAnyTime) {
  const TemporaryFolder folder;
  Framebuffer picture = random_picture(30, 20);
  picture.depth.assign(600, 7);
  const std::vector<std::string> names{"a.ppm", "a.png", "a.exr",  "a.tif", "a.jpg",
                                       "a.bmp", "a.tga", "a.webp", "a.hdr"};
  const auto write_all = [&] {
    std::map<std::string, std::string> files;
    for (const std::string& name : names) {
      write_image(folder / name, picture);
      files[name] = file_bytes(folder / name);
    }
    for (const char* name : {"z.exr", "z.tif"}) {
      write_depth(folder / name, picture);
      files[name] = file_bytes(folder / name);
    }
    return files;
  };
  const auto first = write_all();
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // file formats count seconds
  const auto second = write_all();
  for (const auto& [name, bytes] : first) EXPECT_TRUE(bytes == second.at(name)) << name;
}

class LossyImage : public ::testing::TestWithParam<std::string> {};

TEST_P(LossyImage, KeepsColoursNearlyAndPixelByPixelTopRowFirst) {
  const TemporaryFolder folder;
  Framebuffer picture = random_picture(24, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 24; ++x) {
      std::uint8_t* rgb = &picture.rgb[3 * picture.pixel(x, y)];
      rgb[0] = x < 8 ? 255 : 0, rgb[1] = y < 8 ? 255 : 0, rgb[2] = 0;
    }
  }
  const std::string path = folder / ("a." + GetParam());
  write_image(path, picture);
  const Image read = read_image(path);
  ASSERT_EQ(read.width, 24);
  ASSERT_EQ(read.height, 16);
  for (int row = 0; row < 16; ++row) {
    for (int x = 0; x < 24; ++x) {
      // 3 of 255 for the rounding of the formats' own colour spaces. WebP halves the resolution of colours,
      // so it is judged inside the blocks only.
      if (GetParam() == "webp" && (x % 8 == 0 || x % 8 == 7 || row % 8 == 0 || row % 8 == 7)) continue;
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(255 * read.value(x, row, c), component(picture, x, 15 - row, c), 3) << x << ' ' << row;
      }
    }
  }
}

TEST_P(LossyImage, KeepsASinglePixelNearly) {
  const TemporaryFolder folder;
  Framebuffer picture = random_picture(1, 1);
  picture.rgb = {200, 100, 50};
  write_image(folder / ("dot." + GetParam()), picture);
  const Image read = read_image(folder / ("dot." + GetParam()));
  ASSERT_EQ(read.width * read.height, 1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(255 * read.value(0, 0, c), component(picture, 0, 0, c), 3);
}

INSTANTIATE_TEST_SUITE_P(, LossyImage, ::testing::Values("jpg", "jpeg", "webp", "hdr", "gif"),
                         [](const auto& tested) { return tested.param; });

class Depth : public ::testing::TestWithParam<std::string> {};

TEST_P(Depth, HoldsTheIntegersAsFloatsTopRowFirst) {
  const TemporaryFolder folder;
  Framebuffer picture;
  picture.width = 3, picture.height = 2;
  picture.depth = {0, 1, 65535, 65536, 16777215, 1073741824};
  write_depth(folder / ("z." + GetParam()), picture);
  const Image read = read_image(folder / ("z." + GetParam()));
  EXPECT_EQ(read.values, (std::vector<float>{65536, 16777215, 1073741824, 0, 1, 65535}));
  ASSERT_EQ(read.channels.size(), 1u);
  if (GetParam() == "exr") {
    EXPECT_EQ(read.channels[0], "Z");  // TIFF has no channel names
  }
}

INSTANTIATE_TEST_SUITE_P(, Depth, ::testing::Values("exr", "tif", "tiff"),
                         [](const auto& tested) { return tested.param; });

TEST(ImageWriter, RefusesDepthsInFormatsWithoutFloats) {
  Framebuffer picture;
  picture.width = picture.height = 1;
  picture.depth = {1};
  for (const char* path : {"z.png", "z.ppm", "z", "-", "/dev/null"}) {
    const Error error = error_of([&] { write_depth(path, picture); });
    EXPECT_EQ(error.status(), ExitStatus::usage) << path;
    EXPECT_EQ(error_of([&] { check_depth_path(path); }).status(), ExitStatus::usage) << path;
    EXPECT_NE(error.hint().find(".exr"), std::string::npos);
  }
}

TEST(ImageWriter, RefusesExtensionsItCannotWriteAndNamesCommonOnes) {
  const TemporaryFolder folder;
  const Framebuffer picture = random_picture(4, 4);
  for (const char* name : {"a.doc", "a", "a.", ".ppm", "a.pgm", "a.pbm", "a.null", "a.nul", "a.term", "a.psd",
                           "a.jp2", "a.iff", "a.sgi"}) {
    const Error error = error_of([&] { write_image(folder / name, picture); });
    EXPECT_EQ(error.status(), ExitStatus::usage) << name;
    EXPECT_EQ(error_of([&] { check_image_path(folder / name); }).status(), ExitStatus::usage) << name;
    EXPECT_NE(error.hint().find(".png"), std::string::npos);
  }
  EXPECT_TRUE(folder.names().empty());
  for (const char* name : {"a.ppm", "a.png", "a.exr", "a.JPG", "-", "/dev/null"})
    EXPECT_NO_THROW(check_image_path(name));
}

TEST(ImageWriter, SaysThatAPictureIsTooLargeForItsFormat) {
  const TemporaryFolder folder;
  const Error error = error_of([&] { write_image(folder / "a.webp", random_picture(16384, 1)); });
  EXPECT_EQ(error.status(), ExitStatus::usage);
  EXPECT_NE(std::string(error.what()).find("16384 x 1 pixels cannot be written as webp"), std::string::npos)
      << error.what();
  EXPECT_TRUE(folder.names().empty());
}

class FailingImage : public ::testing::TestWithParam<std::string> {};

TEST_P(FailingImage, LeavesTheOlderFileAloneWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::string name = "old." + GetParam();
  write_bytes(folder / name, "older file");
  const Framebuffer picture = random_picture(200, 200);
  for (const rlim_t room : {0, 5000}) {
    const FileSizeLimit limit(room);
    const Error error = error_of([&] { write_image(folder / name, picture); });
    EXPECT_EQ(error.status(), ExitStatus::surroundings);
  }
  EXPECT_EQ(file_bytes(folder / name), "older file");
  EXPECT_EQ(folder.names(), std::set<std::string>{name});
}

TEST_P(FailingImage, FailsWhereTheTargetIsAFolderOrIsInNone) {
  const TemporaryFolder folder;
  const std::string name = "a." + GetParam();
  std::filesystem::create_directory(folder / name);
  const Framebuffer picture = random_picture(4, 4);
  EXPECT_EQ(error_of([&] { write_image(folder / name, picture); }).status(), ExitStatus::surroundings);
  EXPECT_EQ(error_of([&] { write_image(folder / ("none/" + name), picture); }).status(),
            ExitStatus::surroundings);
  EXPECT_EQ(folder.names(), std::set<std::string>{name});
}

INSTANTIATE_TEST_SUITE_P(, FailingImage, ::testing::Values("ppm", "png", "exr", "tif", "jpg", "bmp", "webp"),
                         [](const auto& tested) { return tested.param; });

TEST(ImageWriter, WritesDevicesInPlace) {
  const Framebuffer picture = random_picture(4, 4);
  EXPECT_NO_THROW(write_image("/dev/null", picture));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(error_of([&] { write_image("/dev/full", picture); }).status(), ExitStatus::surroundings);
}

TEST(ImageReader, ExplainsWhatItCannotRead) {
  const TemporaryFolder folder;
  write_bytes(folder / "text.png", "this is no picture\n");
  write_bytes(folder / "short.ppm", "P6\n10 10\n255\nabc");
  write_bytes(folder / "huge.ppm", "P6\n32767 32767\n255\n");
  write_bytes(folder / "beyond.ppm", "P6\n40000 2\n255\n" + std::string(std::size_t{3} * 40000 * 2, 'x'));
  write_bytes(folder / "empty.exr", "");
  std::filesystem::create_directory(folder / "folder.png");
  for (const char* name :
       {"missing.png", "text.png", "short.ppm", "huge.ppm", "beyond.ppm", "empty.exr", "folder.png"}) {
    const Error error = error_of([&] { read_image(folder / name); });
    EXPECT_EQ(error.status(), ExitStatus::input) << name;
    const std::string start = (folder / name) + ": cannot read the picture: ";
    EXPECT_EQ(std::string(error.what()).substr(0, start.size()), start);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find("no reason is given"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace farop::test
