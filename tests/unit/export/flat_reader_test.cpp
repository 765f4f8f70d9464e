// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/flat_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "flat_frames.h"
#include "test_files.h"

namespace farop::test {
namespace {

/// The 1997 paper's example as printed: clockwise, colours up to CRES.
const std::string k_paper =
    "512 512 512 128\n2\n1\n"
    "3 100 50\n40 100 89 30 128 30\n50 80 89 30 128 30\n60 50 89 30 128 30\n1\n"
    "4 110 40\n40 40 89 30 128 30\n50 110 89 30 128 30\n60 50 89 30 128 30\n55 60 89 30 128 30\n1\n127\n";

std::string one_polygon(const std::string& head, const std::string& vertices) {
  return "64 64 256 16\n1\n1\n" + head + "\n" + vertices + "1\n127\n";
}

std::string text_of(const std::vector<Diagnostic>& errors) {
  std::string text;
  for (const Diagnostic& d : errors) text += to_text(d);
  return text;
}

TEST(FlatReader, ReadsThePaperExampleAsPrinted) {
  const FlatResult result = read_flat_text(k_paper);
  ASSERT_TRUE(result.ok) << text_of(result.errors);
  EXPECT_TRUE(result.errors.empty());
  EXPECT_TRUE(result.frame.ended);
  EXPECT_EQ(result.frame.frame.resolution, (Resolution{512, 512, 512, 128}));
  EXPECT_EQ(result.frame.frame.subpixel_bits, 0);
  EXPECT_FALSE(result.frame.frame.half_pixel_border);
  ASSERT_EQ(result.frame.all.size(), 2u);
  EXPECT_EQ(result.frame.with_material, 0);
  // A component equal to CRES is drawn as CRES - 1.
  const std::vector<ScreenVertex> first{
      {40, 100, 89, 30, 127, 30}, {50, 80, 89, 30, 127, 30}, {60, 50, 89, 30, 127, 30}};
  EXPECT_EQ(result.frame.all[0].vertices, first);
  EXPECT_EQ(result.frame.all[1].vertices.size(), 4u);
  EXPECT_TRUE(result.frame.all[0].back_facing);
  EXPECT_TRUE(result.frame.all[1].back_facing);
}

TEST(FlatReader, FlagsOnlyClockwisePolygons) {
  const auto facing = [](const std::string& vertices, bool y_down) {
    const FlatResult result = read_flat_text(one_polygon("3 20 10", vertices), y_down);
    EXPECT_TRUE(result.ok) << text_of(result.errors);
    return result.frame.all.at(0).back_facing;
  };
  const std::string counter_clockwise = "10 10 0 0 0 0\n20 10 0 0 0 0\n10 20 0 0 0 0\n";
  const std::string clockwise = "10 10 0 0 0 0\n10 20 0 0 0 0\n20 10 0 0 0 0\n";
  const std::string without_area = "10 10 0 0 0 0\n20 20 0 0 0 0\n15 15 0 0 0 0\n";
  EXPECT_FALSE(facing(counter_clockwise, false));
  EXPECT_TRUE(facing(clockwise, false));
  EXPECT_FALSE(facing(without_area, false));
  // Rows that count from the top mirror the picture, and with it the sense of rotation.
  EXPECT_TRUE(facing(counter_clockwise, true));
  EXPECT_FALSE(facing(clockwise, true));
  EXPECT_FALSE(facing(without_area, true));
}

TEST(FlatReader, JudgesTheSenseOfAPolygonWhoseAreaExceeds64Bits) {
  // 70,000 times clockwise round the largest frame: twice the area is 70,000 * 2^47, beyond 2^63.
  constexpr int k_turns = 70000;
  std::string text = fmt::format("32767 32767 2 2 8\n1\n1\n{} 8388096 0\n", 4 * k_turns);
  for (int i = 0; i < k_turns; ++i) {
    text += "0 0 0 0 0 0\n0 8388096 0 0 0 0\n8388096 8388096 0 0 0 0\n8388096 0 0 0 0 0\n";
  }
  const FlatResult result = read_flat_text(text + "1\n127\n");
  ASSERT_TRUE(result.ok) << text_of(result.errors);
  EXPECT_TRUE(result.frame.all.at(0).back_facing);
}

TEST(FlatReader, TurnsRowsThatCountFromTheTopUpright) {
  const std::string text =
      "64 48 256 16 2\n1\n1\n3 188 8\n4 8 0 0 0 0\n8 12 0 0 0 0\n0 188 0 0 0 0\n1\n127\n";
  const FlatResult result = read_flat_text(text, true);
  ASSERT_TRUE(result.ok) << text_of(result.errors);
  EXPECT_FALSE(result.frame.frame.y_down);
  const std::vector<ScreenVertex> expected{{4, 180}, {8, 176}, {0, 0}};  // (48 - 1) * 4 = 188
  EXPECT_EQ(result.frame.all.at(0).vertices, expected);
}

TEST(FlatReader, AllowsBlankLinesBlanksCommentsAndAnyLineEnd) {
  const std::string text =
      "\xEF\xBB\xBF# a comment\r\n  64\t64  256 16   # the resolution\r\n\r\n1         \r1#separator\n\n"
      " 3 20 10 \n0010 10 0 0 0 0\n# between\n20 10 0 0 0 0\r\n10 20 0 0 0 0\n\n\n1\n127 # the end\n\n# "
      "really\n";
  const FlatResult result = read_flat_text(text);
  EXPECT_TRUE(result.ok) << text_of(result.errors);
  EXPECT_EQ(result.frame.all.size(), 1u);
}

TEST(FlatReader, AcceptsAFileWithoutAFinalLineEnd) {
  EXPECT_TRUE(read_flat_text("4 3 2 2\n0\n1\n127").ok);
}

TEST(FlatReader, AcceptsTheLimitsOfTheFormatAndNothingBeyond) {
  const auto accepts = [](const std::string& line) { return read_flat_text(line + "\n0\n1\n127\n").ok; };
  EXPECT_TRUE(accepts("1 1 2 2"));
  EXPECT_TRUE(accepts("32767 32767 1073741824 65536 8"));
  EXPECT_TRUE(accepts("1 1 2 2 1"));
  for (const char* line :
       {"0 1 2 2", "1 0 2 2", "1 1 1 2", "1 1 2 1", "32768 1 2 2", "1 32768 2 2", "1 1 1073741825 2",
        "1 1 2 65537", "1 1 2 2 0", "1 1 2 2 9", "-1 1 2 2", "1 1 2", "1 1 2 2 1 1"}) {
    EXPECT_FALSE(accepts(line)) << line;
  }
}

TEST(FlatReader, HandsPolygonsOverInBatchesInFileOrder) {
  std::string text = "64 64 65536 16\n10000\n1\n";
  for (int i = 0; i < 10000; ++i)
    text += fmt::format("3 0 0\n0 0 {} 0 0 0\n0 0 0 0 0 0\n0 0 0 0 0 0\n1\n", i);
  const FlatResult result = read_flat_text(text + "127\n");
  ASSERT_TRUE(result.ok) << text_of(result.errors);
  ASSERT_EQ(result.frame.all.size(), 10000u);
  EXPECT_GT(result.frame.batches, 5);
  EXPECT_LT(result.frame.batches, 20);
  for (int i = 0; i < 10000; ++i) ASSERT_EQ(result.frame.all[static_cast<std::size_t>(i)].vertices[0].z, i);
}

TEST(FlatReader, TellsItsProgressInBytes) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.scr", k_paper);
  WordReader words(folder / "a.scr");
  DiagnosticList diagnostics;
  RecordedFrame frame;
  std::uint64_t total = 0;
  FlatReadOptions options;
  options.progress = [&](std::uint64_t, std::uint64_t all) { total = all; };
  EXPECT_TRUE(read_flat(words, diagnostics, frame, options));
  EXPECT_EQ(total, k_paper.size());
}

TEST(FlatReader, DoesNotReserveMemoryForAnnouncedVertices) {
  const FlatResult result = read_flat_text("64 64 256 16\n9999999999\n1\n1073741823 0 0\n0 0 0 0 0 0\n");
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].message, "the file ends, expected vertex 2 of 1073741823 (x y z R G B)");
}

TEST(FlatReader, ShowsWhereAndWhatWithTheRemedy) {
  const FlatResult result =
      read_flat_text(one_polygon("3 20 10", "10 10 0 0 0 0\n20 10 0 0 0.5 0\n10 20 0 0 0 0\n"));
  EXPECT_EQ(text_of(result.errors),
            "test.scr:6:11: error: found '0.5', expected G: an integer 0..16\n"
            "     6 | 20 10 0 0 0.5 0\n"
            "       |           ^~~\n"
            "  hint: plain decimal integers only; text may follow a '#'\n");
}

TEST(FlatReader, LetsFailuresOfTheSinkThrough) {
  class FullSink : public RecordedFrame {
    void end_frame() override { throw Error(ExitStatus::surroundings, "full"); }
  } sink;
  WordReader words(k_paper, "test.scr");
  DiagnosticList diagnostics;
  EXPECT_THROW(read_flat(words, diagnostics, sink), Error);
}

/// Not accepted: one error with a place and a message, and the frame is not ended.
void expect_one_error(const FlatResult& result, const std::string& text) {
  ASSERT_FALSE(result.ok) << text;
  ASSERT_EQ(result.errors.size(), 1u) << text;
  EXPECT_EQ(result.errors[0].severity, Severity::error);
  EXPECT_GT(result.errors[0].where.line, 0u) << text;
  EXPECT_GT(result.errors[0].where.column, 0u) << text;
  EXPECT_FALSE(result.errors[0].message.empty());
  EXPECT_FALSE(result.frame.ended);
}

TEST(FlatReader, RejectsEveryTruePrefixWithOneError) {
  for (std::size_t length = 0; length + 1 < k_paper.size();
       ++length) {  // without the last line end it is complete
    const std::string prefix = k_paper.substr(0, length);
    expect_one_error(read_flat_text(prefix), prefix);
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line + "\n");
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

TEST(FlatReader, RejectsEveryLineDeletedAndEveryLineDoubledWithOneError) {
  const auto lines = lines_of(k_paper);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto changed = lines;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(i));
    expect_one_error(read_flat_text(joined(changed)), joined(changed));
    changed = lines;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(i), lines[i]);
    expect_one_error(read_flat_text(joined(changed)), joined(changed));
  }
}

TEST(FlatReader, RejectsEveryWordDeletedAndEveryWordDoubledWithOneError) {
  const auto lines = lines_of(k_paper);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::istringstream stream(lines[i]);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word + " ");
    if (words.size() < 2) continue;  // that would be a line deleted
    for (std::size_t w = 0; w < words.size(); ++w) {
      // CRES doubled is a number of sub-pixel bits, which 128 is too large for.
      for (const bool doubled : {false, true}) {
        auto changed_words = words;
        const auto at = changed_words.begin() + static_cast<std::ptrdiff_t>(w);
        doubled ? changed_words.insert(at, words[w]) : changed_words.erase(at);
        auto changed = lines;
        changed[i] = joined(changed_words) + "\n";
        expect_one_error(read_flat_text(joined(changed)), joined(changed));
      }
    }
  }
}

TEST(FlatReader, EndsRandomlyChangedFilesInAFrameOrInOneError) {
  std::mt19937 random(3);
  const std::string alphabet("0123456789 \n\r\t#-+.x\0\xFF\x80", 22);
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = k_paper;
    for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      const char c = alphabet[random() % alphabet.size()];
      switch (random() % 3) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1 + random() % 3, c);
          break;
        default:
          text.erase(at, 1 + random() % 5);
      }
    }
    const FlatResult result = read_flat_text(text, round % 2 == 0);
    ASSERT_EQ(result.errors.size(), result.ok ? 0u : 1u) << text;
    ASSERT_EQ(result.frame.ended, result.ok) << text;
    accepted += result.ok ? 1 : 0;
  }
  EXPECT_GT(accepted, 100);  // else the changes are too coarse to mean anything
  EXPECT_LT(accepted, 10000);
}

struct RoundTripCase {
  ScreenFrame frame;
  std::size_t polygons;
};

class FlatRoundTrip : public ::testing::TestWithParam<RoundTripCase> {};

TEST_P(FlatRoundTrip, GivesBackTheSameVertices) {
  const TemporaryFolder folder;
  std::mt19937 random(4);
  const ScreenFrame& frame = GetParam().frame;
  const auto polygons = random_polygons(frame, GetParam().polygons, random);
  write_flat(folder / "a.scr", frame, polygons);
  WordReader words(folder / "a.scr");
  DiagnosticList diagnostics;
  RecordedFrame read;
  ASSERT_TRUE(read_flat(words, diagnostics, read)) << text_of(diagnostics.items);
  EXPECT_EQ(read.frame.resolution, frame.resolution);
  EXPECT_EQ(read.frame.subpixel_bits, frame.subpixel_bits);
  ASSERT_EQ(read.all.size(), polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i)
    ASSERT_EQ(read.all[i].vertices, polygons[i].vertices) << i;
}

INSTANTIATE_TEST_SUITE_P(, FlatRoundTrip,
                         ::testing::Values(RoundTripCase{{{512, 512, 512, 128}}, 3000},
                                           RoundTripCase{{{1024, 768, 65536, 256}, 1}, 3000},
                                           RoundTripCase{{{640, 480, 65536, 256}, 2}, 1000},
                                           RoundTripCase{{{640, 480, 1 << 24, 512}, 3}, 1000},
                                           RoundTripCase{{{100, 2000, 3, 3}, 4}, 1000},
                                           RoundTripCase{{{2000, 100, 1 << 16, 1000}, 5}, 1000},
                                           RoundTripCase{{{1, 32767, 2, 2}, 6}, 1000},
                                           RoundTripCase{{{32767, 1, 1 << 29, 32768}, 7}, 1000},
                                           RoundTripCase{{{32767, 32767, 1 << 30, 65536}, 8}, 3000},
                                           RoundTripCase{{{1, 1, 2, 2}}, 10},
                                           RoundTripCase{{{7, 5, 9, 4}}, 0}),
                         [](const auto& tested) {
                           const ScreenFrame& f = tested.param.frame;
                           return fmt::format("{}x{}x{}x{}_bits{}", f.resolution.x, f.resolution.y,
                                              f.resolution.z, f.resolution.color, f.subpixel_bits);
                         });

/// tests/corpus/flat/bad/NAME.scr, rejected with what NAME.txt says: LINE:COLUMN: message.
class BadFlatFile : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(BadFlatFile, IsRejectedWithTheExpectedMessage) {
  std::filesystem::path expectation = GetParam();
  expectation.replace_extension(".txt");
  WordReader words(GetParam().string());
  DiagnosticList diagnostics;
  RecordedFrame frame;
  EXPECT_FALSE(read_flat(words, diagnostics, frame));
  ASSERT_EQ(diagnostics.items.size(), 1u);
  const Diagnostic& d = diagnostics.items[0];
  EXPECT_EQ(fmt::format("{}:{}: {}\n", d.where.line, d.where.column, d.message),
            file_bytes(expectation.string()));
  EXPECT_EQ(d.where.file, GetParam().string());
  EXPECT_FALSE(d.hint.empty());
}

/// tests/corpus/flat/good/NAME.scr is accepted.
class GoodFlatFile : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(GoodFlatFile, IsAccepted) {
  WordReader words(GetParam().string());
  DiagnosticList diagnostics;
  RecordedFrame frame;
  EXPECT_TRUE(read_flat(words, diagnostics, frame)) << text_of(diagnostics.items);
}

std::vector<std::filesystem::path> corpus(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(FAROP_SOURCE_DIR "/tests/corpus/flat/" + folder)) {
    if (entry.path().extension() == ".scr") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string file_stem(const ::testing::TestParamInfo<std::filesystem::path>& tested) {
  return tested.param.stem().string();
}

INSTANTIATE_TEST_SUITE_P(, BadFlatFile, ::testing::ValuesIn(corpus("bad")), file_stem);
INSTANTIATE_TEST_SUITE_P(, GoodFlatFile, ::testing::ValuesIn(corpus("good")), file_stem);

}  // namespace
}  // namespace farop::test
