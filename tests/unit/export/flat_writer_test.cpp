// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/flat_writer.h"

#include <gtest/gtest.h>

#include "captured_output.h"
#include "flat_frames.h"
#include "test_files.h"

namespace farop::test {
namespace {

/// The two polygons of the 1997 paper's example, colours within 0..CRES-1.
std::vector<FlatPolygon> paper_polygons() {
  return {{{{40, 100, 89, 30, 127, 30}, {50, 80, 89, 30, 127, 30}, {60, 50, 89, 30, 127, 30}}},
          {{{40, 40, 89, 30, 127, 30},
            {50, 110, 89, 30, 127, 30},
            {60, 50, 89, 30, 127, 30},
            {55, 60, 89, 30, 127, 30}}}};
}

TEST(FlatWriter, WritesThePaperExampleByteForByte) {
  const TemporaryFolder folder;
  write_flat(folder / "paper.scr", {{512, 512, 512, 128}}, paper_polygons());
  EXPECT_EQ(file_bytes(folder / "paper.scr"),
            "512 512 512 128\n2         \n1\n"
            "3 100 50\n40 100 89 30 127 30\n50 80 89 30 127 30\n60 50 89 30 127 30\n1\n"
            "4 110 40\n40 40 89 30 127 30\n50 110 89 30 127 30\n60 50 89 30 127 30\n55 60 89 30 127 30\n1\n"
            "127\n");
}

TEST(FlatWriter, WritesAFrameWithoutPolygons) {
  const TemporaryFolder folder;
  write_flat(folder / "empty.scr", {{4, 3, 2, 2}}, {});
  EXPECT_EQ(file_bytes(folder / "empty.scr"), "4 3 2 2\n0         \n1\n127\n");
}

TEST(FlatWriter, NamesSubpixelBitsAsAFifthNumberAndUsesTheirUnits) {
  const TemporaryFolder folder;
  write_flat(folder / "fine.scr", {{512, 512, 65536, 256}, 4},
             {{{{0, 8176, 65535, 0, 0, 255}, {8, 7, 6, 5, 4, 3}, {1, 2, 3}}}});
  EXPECT_EQ(file_bytes(folder / "fine.scr"),
            "512 512 65536 256 4\n1         \n1\n"
            "3 8176 2\n0 8176 65535 0 0 255\n8 7 6 5 4 3\n1 2 3 0 0 0\n1\n127\n");
}

TEST(FlatWriter, WritesTheLargestNumbersOfTheFormat) {
  const TemporaryFolder folder;
  const int most = 32766 << 8;
  write_flat(folder / "large.scr", {{32767, 32767, std::int64_t{1} << 30, 65536}, 8},
             {{{{most, most, (1 << 30) - 1, 65535, 65535, 65535},
                {2047, 2048, 2049, 9, 10, 99},
                {100, 999, 1000}}}});
  EXPECT_EQ(file_bytes(folder / "large.scr"),
            "32767 32767 1073741824 65536 8\n1         \n1\n"
            "3 8388096 999\n8388096 8388096 1073741823 65535 65535 65535\n2047 2048 2049 9 10 99\n100 999 "
            "1000 0 0 0\n"
            "1\n127\n");
}

TEST(FlatWriter, KeepsTheLargerNumberInFrontWhenRowsCountFromTheTop) {
  const TemporaryFolder folder;
  ScreenFrame frame{{64, 64, 16, 16}};
  frame.y_down = true;
  write_flat(folder / "down.scr", frame, {{{{0, 3}, {5, 20}, {9, 9}}}});
  EXPECT_EQ(file_bytes(folder / "down.scr"),
            "64 64 16 16\n1         \n1\n3 20 3\n0 3 0 0 0 0\n5 20 0 0 0 0\n9 9 0 0 0 0\n1\n127\n");
}

TEST(FlatWriter, CountsWhatItWrites) {
  const TemporaryFolder folder;
  OutputFile file(folder / "counted.scr");
  FlatWriter writer(file);
  writer.begin_frame({});
  ScreenPolygonBatch batch;
  batch.vertices.resize(3);
  batch.polygons.assign(7, {0, 3});
  writer.polygons(batch);
  writer.polygons(batch);
  writer.end_frame();
  EXPECT_EQ(writer.polygon_count(), 14u);
}

TEST(FlatWriter, GivesFilesPipesAndStandardOutputTheSameBytesAndLeavesNoTemporaryFile) {
  const TemporaryFolder folder;
  const TemporaryFolder temporary;
  const EnvironmentVariable tmpdir("TMPDIR", temporary.path().string());
  std::mt19937 random(1);
  const ScreenFrame frame{{1024, 768, 65536, 256}};
  const auto polygons = random_polygons(frame, 5000, random);  // more than one block
  const auto write = [&](const std::string& path) { write_flat(path, frame, polygons); };
  write(folder / "a.scr");
  const std::string expected = file_bytes(folder / "a.scr");
  ASSERT_GT(expected.size(), std::size_t{2} << 18);
  EXPECT_TRUE(through_pipe(folder, "pipe.scr", write) == expected);
  EXPECT_TRUE(through_stdout(folder, write) == expected);
  EXPECT_TRUE(temporary.names().empty());
  EXPECT_EQ(folder.names(), std::set<std::string>{"a.scr"});
}

TEST(FlatWriter, ReportsAFullDeviceAsAFailureOfTheSurroundings) {
  const Error error = error_of([] { write_flat("/dev/full", {}, {}); });
  EXPECT_EQ(error.status(), ExitStatus::surroundings);
  EXPECT_STREQ(error.what(), "/dev/full: cannot write: No space left on device");
}

TEST(FlatWriter, LeavesTheOlderFileAloneWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  write_bytes(folder / "old.scr", "older file");
  std::mt19937 random(2);
  const auto polygons = random_polygons({}, 3000, random);
  {
    const FileSizeLimit limit(100000);
    EXPECT_EQ(error_of([&] { write_flat(folder / "old.scr", {}, polygons); }).status(),
              ExitStatus::surroundings);
  }
  EXPECT_EQ(file_bytes(folder / "old.scr"), "older file");
  EXPECT_EQ(folder.names(), std::set<std::string>{"old.scr"});
}

TEST(FlatWriter, SaysThatTheTemporaryFileOfAPipeDoesNotFit) {
  const TemporaryFolder temporary;
  const EnvironmentVariable tmpdir("TMPDIR", temporary.path().string());
  std::mt19937 random(2);
  const auto polygons = random_polygons({}, 3000, random);
  const FileSizeLimit limit(100000);
  const Error error = error_of([&] { write_flat("/dev/null", {}, polygons); });
  EXPECT_EQ(error.status(), ExitStatus::surroundings);
  EXPECT_NE(std::string(error.what()).find("cannot write a temporary file"), std::string::npos)
      << error.what();
  EXPECT_NE(error.hint().find("TMPDIR"), std::string::npos);
}

TEST(FlatWriter, RefusesFramesWithAHalfPixelBorder) {
  const TemporaryFolder folder;
  ScreenFrame frame;
  frame.half_pixel_border = true;
  EXPECT_EQ(error_of([&] { write_flat(folder / "x.scr", frame, {}); }).status(), ExitStatus::internal);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace farop::test
