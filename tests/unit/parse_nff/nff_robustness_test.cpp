// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged texts end in a scene or in exactly one error, whatever the damage.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "nff_text.h"

namespace farop {
namespace {

const std::string k_scenes[] = {
    "b 0.078 0.361 0.753\n"
    "v\nfrom -1.1 -2.1 2.6\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 512 512\n"
    "l 2 4 4\nl -2 4 3 1 0.5 0.5\n"
    "f 1 0.85 0.7 0.3 0.6 3.0827 0 0\n"
    "p 4\n2 2 0\n-2 2 0\n-2 -2 0\n2 -2 0\n"
    "f 1 0.605523 0.408284 0.2 0 100000 0.8 1.1\n"
    "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1 # corner\n0 1 0 0 0 1\n",
    "# curved things\r\nv from 0 0 5 at 0 0 0 up 0 1 0 angle 30 hither 0 resolution 64 32 yon 9\r\n"
    "s 0 0 0 1\r\ns 1 0 0 -0.5\r\n\r\nc 0 0 0 1 0 0 1 0\r\nc\r\n0 0 0 -1\r\n0 0 2 -1\r\n"
    "f 1 1 1 0.5 0.5 10 1 1.5\r\nc 0 0 0 0.25\r\n1 1 1 0.25\r\ns 1e-3 +2 3. .5\r\n",
    "fm 0 0 0 1 0.5 0 0.1 0.2 0.3 10 0 1\nla sun 1 2 3 1 1 1\nk camera {\n 0 { 1 2 3 }\n}\n"
    "tt wood 0 0 0 0 0  1 0 0 1 0  0 1 0 0 1\nttp wood 0 0 0 0 0 1 0 0  1 0 0 0 0 1 1 0  0 1 0 0 0 1 0 1\n"
    "tpa 1\n0 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\ntpp 3\n0 0 0 0 0 1 0 0 1 0 0 0 0 1 1 0 0 1 0 0 0 1 0 1\n"
    "am 1 1 1\ntess 3\ntexture wood.tga 1\nf 1 1 1 0.5 0 1 0 1 wood.tga % comment\nbegin_hierarchy\ns 0 0 0 "
    "1\nend_hierarchy\n"};

TEST(NffRobustness, TheUndamagedScenesAreSound) {
  for (const std::string& text : k_scenes) {
    const ParsedText parsed = parse_text(text);
    ASSERT_TRUE(parsed.scene) << parsed.report(parsed.reports.size() - 1);
  }
}

TEST(NffRobustness, EveryPrefixEndsInASceneOrOneError) {
  for (const std::string& text : k_scenes) {
    for (std::size_t n = 0; n <= text.size(); ++n) {
      const std::string prefix = text.substr(0, n);
      ASSERT_TRUE(ends_in_scene_or_one_error(parse_text(prefix))) << prefix;
    }
  }
}

TEST(NffRobustness, EverySuffixEndsInASceneOrOneError) {
  for (const std::string& text : k_scenes) {
    for (std::size_t n = 0; n <= text.size(); ++n) {
      const std::string suffix = text.substr(n);
      ASSERT_TRUE(ends_in_scene_or_one_error(parse_text(suffix))) << suffix;
    }
  }
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part + separator);
  return parts;
}

TEST(NffRobustness, EveryDeletionOfALineEndsInASceneOrOneError) {
  for (const std::string& text : k_scenes) {
    const std::vector<std::string> lines = split(text, '\n');
    for (std::size_t gone = 0; gone < lines.size(); ++gone) {
      std::string rest;
      for (std::size_t i = 0; i < lines.size(); ++i) rest += i == gone ? "" : lines[i];
      ASSERT_TRUE(ends_in_scene_or_one_error(parse_text(rest))) << rest;
    }
  }
}

// A polygon that lost or gained a vertex must never be read as another scene.
TEST(NffRobustness, EveryDeletionOfAVertexLineIsAnError) {
  const std::vector<std::string> lines = split(k_scenes[0], '\n');
  std::size_t tried = 0;
  for (std::size_t gone = 0; gone < lines.size(); ++gone) {
    const char first = lines[gone].front();
    if (first != '-' && (first < '0' || first > '9')) continue;
    std::string rest;
    std::string doubled;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      rest += i == gone ? "" : lines[i];
      doubled += i == gone ? lines[i] + lines[i] : lines[i];
    }
    EXPECT_FALSE(parse_text(rest).scene) << rest;
    EXPECT_FALSE(parse_text(doubled).scene) << doubled;
    ++tried;
  }
  EXPECT_EQ(tried, 7u);
}

TEST(NffRobustness, EveryReplacementOfAWordEndsInASceneOrOneError) {
  const std::string words[] = {"p",          "pp",     "v",   "from",  "f",       "tpp",
                               "{",          "}",      "nan", "1e999", "-1",      "0",
                               "3",          "1e-999", "k",   "//",    "texture", "tpa",
                               "1000000000", "%",      "#",   "am",    "\xFF",    std::string("\0", 1)};
  for (const std::string& text : k_scenes) {
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t start = text.find_first_not_of(" \r\n", i);
      if (start == std::string::npos) break;
      i = std::min(text.find_first_of(" \r\n", start), text.size());
      places.emplace_back(start, i - start);
    }
    for (const auto& [start, length] : places) {
      for (const std::string& word : words) {
        std::string damaged = text;
        damaged.replace(start, length, word);
        ASSERT_TRUE(ends_in_scene_or_one_error(parse_text(damaged))) << damaged;
      }
    }
  }
}

TEST(NffRobustness, RandomDamageEndsInASceneOrOneError) {
  std::mt19937 random(20240611);
  const std::string_view alphabet = "0123456789.-+eEpvfslcb{}#%/\\ \n\r\t\"naix\x01\x7F\x80\xEF\xBB\xBF";
  for (int round = 0; round < 6000; ++round) {
    std::string text = k_scenes[round % std::size(k_scenes)];
    for (auto edits = 1 + random() % 8; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text[at] = alphabet[random() % alphabet.size()];
          break;
        case 2:
          text.insert(at, 1, alphabet[random() % alphabet.size()]);
          break;
        default:
          text.erase(at, 1 + random() % 20);
          break;
      }
      if (text.empty()) text = "p";
    }
    ASSERT_TRUE(ends_in_scene_or_one_error(parse_text(text))) << text;
  }
}

TEST(NffRobustness, DeepNestingInSkippedKeyFramesNeedsNoStack) {
  std::string text = "k name ";
  for (int i = 0; i < 2'000'000; ++i) text += "{ ";
  const ParsedText open = parse_text(text);
  EXPECT_FALSE(open.scene);
  for (int i = 0; i < 2'000'000; ++i) text += "} ";
  EXPECT_TRUE(parse_text(text).scene);
}

TEST(NffRobustness, LongLinesAndLongRunsOfNumbersAreNoTrouble) {
  std::string text = "f 1 1 1 1 0 0 0 1 p 100000";
  for (int i = 0; i < 100'000; ++i) text += fmt::format(" {} {} 0", i % 317, i / 317);
  const ParsedText parsed = parse_text(text);
  ASSERT_TRUE(parsed.scene);
  EXPECT_EQ((*parsed.surface().polygons.begin()).corners.size(), 100'000u);
  const ParsedText damaged = parse_text(text + " 7");
  ASSERT_EQ(damaged.count(Severity::error), 1u);
  EXPECT_LT(damaged.reports[0].excerpt.size(), 2000u);
}

TEST(NffRobustness, AHugeCountReservesNoMemory) {
  // 10^9 vertices would need 24 GB at once; the error must come from the end of the file.
  const ParsedText parsed = parse_text("f 1 1 1 1 0 0 0 1\np 1000000000\n0 0 0\n");
  ASSERT_EQ(parsed.count(Severity::error), 1u);
  EXPECT_EQ(parsed.reports[0].where.line, 2u);
  EXPECT_FALSE(parse_text("tpa 9223372036854775807\n0 0 0\n").scene);
}

}  // namespace
}  // namespace farop
