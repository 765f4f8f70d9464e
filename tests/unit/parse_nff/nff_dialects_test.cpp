// SPDX-License-Identifier: GPL-3.0-or-later
// Every dialect word that is read or skipped, with the standard text that means the same. Those that are
// errors are in the corpus of malformed files.
#include <gtest/gtest.h>

#include <ostream>

#include "nff_text.h"

namespace farop {
namespace {

struct Dialect {
  const char* name;
  std::string text;
  std::string standard;  ///< the same scene in the words of the format
  std::vector<std::string> warnings;
};

// What GoogleTest shows of a case.
std::ostream& operator<<(std::ostream& out, const Dialect& dialect) {
  return out << dialect.text;
}

constexpr const char* k_white = "f 1 1 1 1 0 0 0 1\n";
constexpr const char* k_triangle = "p 3\n0 0 0\n1 0 0\n0 1 0\n";
constexpr const char* k_patch = "pp 3\n0 0 0 0 0 1\n1 0 0 0 1 0\n0 1 0 1 0 0\n";

std::vector<Dialect> dialects() {
  const std::string white = k_white;
  const std::string ball = "s 0 0 0 1\n";
  const std::string fill_needs = "'f' takes 8 numbers (r g b Kd Ks shine T index-of-refraction), found ";
  const std::string defaults = "; defaults are used for the rest";
  return {
      {"light_with_color", "l 1 2 3 0.1 0.2 0.3\n", "l 1 2 3 0.1 0.2 0.3\n", {}},
      {"light_with_intensity",
       "l 1 2 3 0.5 0.5 1 2\n",
       "l 1 2 3 0.25 0.5 1\n",
       {"1:1: 'l' with 7 numbers is not in the NFF format; read as x y z intensity r g b"}},
      {"fill_with_7_numbers",
       "f 1 0.5 0 0.3 0.6 9 0.5\n" + ball,
       "f 1 0.5 0 0.3 0.6 9 0.5 1\n" + ball,
       {"1:1: " + fill_needs + "7" + defaults}},
      {"fill_with_6_numbers",
       "f 1 0.5 0 0.3 0.6 9\n" + ball,
       "f 1 0.5 0 0.3 0.6 9 0 1\n" + ball,
       {"1:1: " + fill_needs + "6" + defaults}},
      {"fill_with_5_numbers",
       "f 1 0.5 0 0.3 0.6\n" + ball,
       "f 1 0.5 0 0.3 0.6 0 0 1\n" + ball,
       {"1:1: " + fill_needs + "5" + defaults}},
      {"fill_with_4_numbers",
       "f 1 0.5 0 0.3\n" + ball,
       "f 1 0.5 0 0.3 0 0 0 1\n" + ball,
       {"1:1: " + fill_needs + "4" + defaults}},
      {"fill_with_3_numbers",
       "f 1 0.5 0\n" + ball,
       "f 1 0.5 0 1 0 0 0 1\n" + ball,
       {"1:1: " + fill_needs + "3" + defaults}},
      {"fill_with_texture",
       "f 1 1 1 1 0 0 0 1 wood.tga 4 x\n" + ball,
       white + ball,
       {"1:19: text behind the numbers of 'f' is skipped to the end of the line"}},
      {"fill_with_texture_and_missing_numbers",
       "f 1 1 1 wood.tga\n" + ball,
       white + ball,
       {"1:1: " + fill_needs + "3" + defaults,
        "1:9: text behind the numbers of 'f' is skipped to the end of the line"}},
      {"fill_with_texture_on_the_last_of_its_lines",
       "f 1 1 1\n1 0 0 0 1 wood.tga 5\n" + ball,
       white + ball,
       {"2:11: text behind the numbers of 'f' is skipped to the end of the line"}},
      {"fill_and_object_on_one_line", "f 1 1 1 1 0 0 0 1 s 0 0 0 1\n", white + ball, {}},
      {"bart_fill",
       "fm 0.1 0.1 0.1 0.5 0.6 0.7 0.2 0.4 0.3 12 0.25 1.5\n" + ball,
       "f 0.5 0.6 0.7 1 0.4 12 0.25 1.5\n" + ball,
       {"1:1: 'fm' is not in the NFF format; colour = diffuse, Ks = largest specular component"}},
      {"alias_fill",
       "fp 1 0.5 0.2 0.3 0.4 5 0.6 1.7\n" + ball,
       "f 1 0.5 0.2 0.3 0.4 5 0.6 1.7\n" + ball,
       {"1:1: 'fp' is not in the NFF format; read as 'f'"}},
      {"light_fill",
       "fl 1 0.5 0.2\n" + ball,
       "f 1 0.5 0.2 1 0 0 0 1\n" + ball,
       {"1:1: 'fl' is not in the NFF format; read as 'f' with this colour and defaults"}},
      {"lambert_fill",
       "flam 1 0.5 0.2\n" + ball,
       "f 1 0.5 0.2 1 0 0 0 1\n" + ball,
       {"1:1: 'flam' is not in the NFF format; read as 'f' with this colour and defaults"}},
      {"ambient_light",
       "am 0.5 0.5 0.5\n" + white + ball,
       white + ball,
       {"1:1: 'am' is not in the NFF format; skipped"}},
      {"animation_parameters",
       "a 0 10 25\n" + white + ball,
       white + ball,
       {"1:1: 'a' is not in the NFF format; skipped"}},
      {"named_light",
       "la sun 1 2 3\n",
       "l 1 2 3\n",
       {"1:1: 'la' is not in the NFF format; read as 'l', the light stands still"}},
      {"named_light_with_color",
       "la 5 1 2 3 0.1 0.2 0.3\n",
       "l 1 2 3 0.1 0.2 0.3\n",
       {"1:1: 'la' is not in the NFF format; read as 'l', the light stands still"}},
      {"named_light_with_a_keyword_for_a_name",
       "la p 1 2 3\n",
       "l 1 2 3\n",
       {"1:1: 'la' is not in the NFF format; read as 'l', the light stands still"}},
      {"key_frames",
       "k hero {\nnumtranslations 1\n{ 0 { p 3 } }\nx y {\n} }\n" + white + ball,
       white + ball,
       {"1:1: 'k' is not in the NFF format; key frames are skipped"}},
      {"textured_triangle",
       white + "tt wood.ppm\n0 0 0 0.1 0.2\n1 0 0 0.3 0.4\n0 1 0 0.5 0.6\n",
       white + k_triangle,
       {"2:1: 'tt' is not in the NFF format; read as 'p 3', the texture is dropped"}},
      {"textured_triangle_with_normals",
       white + "ttp wood.ppm\n0 0 0 0 0 1 0.1 0.2\n1 0 0 0 1 0 0.3 0.4\n0 1 0 1 0 0 0.5 0.6\n",
       white + k_patch,
       {"2:1: 'ttp' is not in the NFF format; read as 'pp 3', the texture is dropped"}},
      {"animated_triangle",
       white +
           "tpa 2\n0.5\n0 0 0 0 0 1\n1 0 0 0 1 0\n0 1 0 1 0 0\n1.5\n9 9 9 9 9 9\n9 9 9 9 9 9\n9 9 9 9 9 9\n",
       white + k_patch,
       {"2:1: 'tpa' is not in the NFF format; the first key is read as 'pp 3'"}},
      {"detail_level", "d 2\n" + white + ball, white + ball, {"1:1: 'd' is not in the NFF format; skipped"}},
      {"percent_comment", "% comment s 1 1 1 1\n" + white + "s 0 % x\n0 0 1\n%", white + ball, {}},
      {"textured_patch",
       white + "tpp 3\n0 0 0 0 0 1 0.1\n0.2\n1 0 0 0 1 0 0.3 0.4 0 1 0 1 0 0 0.5 0.6\n",
       white + k_patch,
       {"2:1: 'tpp' is not in the NFF format; read as 'pp', texture coordinates are dropped"}},
      {"tessellation_level",
       "tess 4\n" + white + ball,
       white + ball,
       {"1:1: 'tess' is not in the NFF format; skipped"}},
      {"shader",
       "shader phong 3 x p 3\n" + white + ball,
       white + ball,
       {"1:1: 'shader' is not in the NFF format; skipped to the end of the line"}},
      {"texture",
       white + "texture wood.tga\n" + ball,
       white + ball,
       {"2:1: 'texture' is not in the NFF format; skipped to the end of the line"}},
      {"texture_without_anything",
       white + "texture\n" + ball,
       white + ball,
       {"2:1: 'texture' is not in the NFF format; skipped to the end of the line"}},
      {"hierarchy",
       white + "begin_hierarchy\n" + ball + "end_hierarchy\n",
       white + ball,
       {"2:1: 'begin_hierarchy' is not in the NFF format; skipped, the contents are kept",
        "4:1: 'end_hierarchy' is not in the NFF format; skipped, the contents are kept"}},
  };
}

class NffDialects : public testing::TestWithParam<Dialect> {};

TEST_P(NffDialects, AreReadAsTheStandardTextThatMeansTheSame) {
  const ParsedText dialect = parse_text(GetParam().text);
  const ParsedText standard = parse_text(GetParam().standard);
  ASSERT_TRUE(standard.scene && standard.reports.empty());
  ASSERT_TRUE(dialect.scene) << dialect.report(dialect.reports.size() - 1);
  EXPECT_TRUE(same_content(*dialect.scene, *standard.scene));
  EXPECT_EQ(dialect.summary().polygons, standard.summary().polygons);
  EXPECT_EQ(dialect.summary().patches, standard.summary().patches);
}

TEST_P(NffDialects, AreMentionedInAWarning) {
  const ParsedText dialect = parse_text(GetParam().text);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < dialect.reports.size(); ++i) {
    EXPECT_EQ(dialect.reports[i].severity, Severity::warning);
    warnings.push_back(dialect.report(i));
  }
  EXPECT_EQ(warnings, GetParam().warnings);
}

INSTANTIATE_TEST_SUITE_P(Table, NffDialects, testing::ValuesIn(dialects()),
                         [](const auto& d) { return d.param.name; });

TEST(NffDialect, FillWithNineNumbersHasItsOwnAmbientCoefficient) {
  const ParsedText parsed = parse_text("f 1 1 1 1 0 0 0 1 0.55\ns 0 0 0 1\n");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "1:1: 'f' with 9 numbers is not in the NFF format; the last one is read as Ka");
  EXPECT_EQ(parsed.surface().material.ka, 0.55);
  // ... which ends with the next fill.
  EXPECT_EQ(parse_text("f 1 1 1 1 0 0 0 1 0.55\nf 1 1 1 1 0 0 0 1\ns 0 0 0 1\n").surface().material.ka, 0.30);
}

TEST(NffDialect, SkippedWordsWarnOnceAndAreCounted) {
  const ParsedText parsed = parse_text("tess 1\ntess 2\nam 1 1 1\ntess 3\n");
  ASSERT_EQ(parsed.reports.size(), 3u);
  EXPECT_EQ(parsed.report(0), "1:1: 'tess' is not in the NFF format; skipped");
  EXPECT_EQ(parsed.report(1), "3:1: 'am' is not in the NFF format; skipped");
  EXPECT_EQ(parsed.report(2),
            "4:1: 'tess' is not in the NFF format; skipped ... and 2 more of this kind, the last one here");
}

TEST(NffDialect, TextBehindAFillOnTheNextLineIsNoTexture) {
  const ParsedText parsed = parse_text("f 1 1 1 1 0 0 0 1\nwood.tga\n");
  EXPECT_FALSE(parsed.scene);
  EXPECT_EQ(parsed.report(0), "2:1: unknown keyword 'wood.tga'");
}

TEST(NffDialect, ShortTexturedPatchesAreSkippedLikeShortPatches) {
  const ParsedText parsed =
      parse_text("f 1 1 1 1 0 0 0 1\ntpp 2\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 0 0\ns 0 0 0 1\n");
  ASSERT_TRUE(parsed.scene);
  EXPECT_EQ(parsed.summary().patches, 0u);
  EXPECT_EQ(parsed.summary().spheres, 1u);
}

}  // namespace
}  // namespace farop
