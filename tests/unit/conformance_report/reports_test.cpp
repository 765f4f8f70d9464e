// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "conformance/coverage.h"
#include "conformance_report/html_report.h"
#include "conformance_report/row_story.h"
#include "conformance_report/text_reports.h"
#include "sample_result.h"

namespace farop::conformance_report {
namespace {

using conformance::CheckResult;
using Json = nlohmann::json;

const Catalogue k_english(Language::english);
const std::string k_folder = FAROP_SOURCE_DIR "/tests/unit/conformance_report/";

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

bool has_control_characters(const std::string& text) {
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r') return true;
  }
  return false;
}

CheckResult thousand_findings() {
  CheckResult r = sample_result();
  const conformance::Finding first = r.findings.front();
  r.findings.assign(1000, first);
  return r;
}

/// Exit status of validate.py, which needs python3-jsonschema or xmllint; 77: that is missing.
int validate(const std::string& what, const std::string& text) {
  const std::string file = testing::TempDir() + "report_test." + what;
  std::ofstream(file, std::ios::binary) << text;
  const std::string command = "python3 " + k_folder + "validate.py " + what + " " + file + " " +
                              (what == "json" ? FAROP_SOURCE_DIR "/src/conformance_report/check.schema.json"
                                              : k_folder + "junit.xsd");
  const int status = std::system(command.c_str());
  std::filesystem::remove(file);
  return WEXITSTATUS(status);
}

TEST(Json, FollowsItsSchema) {
  for (const CheckResult& r : {sample_result(), CheckResult{}, thousand_findings()}) {
    const int status = validate("json", to_json(r));
    if (status == 77) GTEST_SKIP() << "python3-jsonschema is missing";
    EXPECT_EQ(status, 0);
  }
}

TEST(Json, IsTheSameTwiceAndKeepsNoControlCharacters) {
  EXPECT_EQ(to_json(sample_result()), to_json(sample_result()));
  const Json json = Json::parse(to_json(sample_result()));
  EXPECT_EQ(json["plugin"]["name"], "<script>alert(1)</script>");
  EXPECT_EQ(json["plugin"]["argument"], "./a?.so");
  EXPECT_EQ(json["findings"][0]["example"]["pixels"][0]["values"][0]["numerator"], 1207);
  EXPECT_EQ(json["findings"][1]["at_polygon"], 3);
}

TEST(JsonLine, IsOneLineWithTheCorpusHash) {
  const std::string line = to_json_line(sample_result().cases[3], "abc");
  EXPECT_EQ(occurrences(line, "\n"), 1u);
  EXPECT_EQ(line.back(), '\n');
  const Json json = Json::parse(line);
  EXPECT_EQ(json["corpus"], "abc");
  EXPECT_EQ(json["status"], "skipped");
}

TEST(JUnit, FollowsItsSchema) {
  for (const CheckResult& r : {sample_result(), CheckResult{}}) {
    const int status = validate("junit", to_junit(r));
    if (status == 77) GTEST_SKIP() << "xmllint is missing";
    EXPECT_EQ(status, 0);
  }
}

TEST(JUnit, TellsFailuresFromErrors) {
  const std::string xml = to_junit(sample_result());
  EXPECT_NE(xml.find("<error type=\"crash.segv\""), std::string::npos);
  EXPECT_NE(
      xml.find("<failure type=\"cov.missing\" message=\"2 pixels of &lt;1&gt; polygon Look &amp; see.\""),
      std::string::npos);
  EXPECT_NE(xml.find("name=\"smoke\" tests=\"2\" failures=\"0\" errors=\"1\" skipped=\"0\""),
            std::string::npos);
  EXPECT_FALSE(has_control_characters(xml));
}

TEST(Tap, HasItsPlanItsSkipAndEscapedNames) {
  const std::string tap = to_tap(sample_result());
  EXPECT_TRUE(
      tap.starts_with("TAP version 13\n1..4\nok 1 - smoke/empty\\#0@1\nnot ok 2 - smoke/quad\\#0@1\n"));
  EXPECT_NE(tap.find("ok 4 - cov/size\\#0@1 # SKIP =1+1 ? \"too\" large\n"), std::string::npos);
  EXPECT_EQ(to_tap(CheckResult{}), "TAP version 13\n1..0\n");
}

TEST(Csv, QuotesAndDisarmsFormulas) {
  const std::string csv = to_csv(sample_result());
  EXPECT_EQ(occurrences(csv, "\r\n"), 5u);
  EXPECT_NE(csv.find("\"'=1+1 ? \"\"too\"\" large\""), std::string::npos);
}

TEST(Gradescope, GivesTenPointsAFamilyInProportion) {
  const Json json = Json::parse(to_gradescope(sample_result(), k_english));
  ASSERT_EQ(json["tests"].size(), 2u);
  EXPECT_EQ(json["tests"][0]["score"], 5.0);
  EXPECT_EQ(json["tests"][1]["score"], 0.0);
  EXPECT_EQ(json["tests"][1]["status"], "failed");
  EXPECT_FALSE(json.contains("score"));
  EXPECT_EQ(Json::parse(to_gradescope(CheckResult{}, k_english))["score"], 0);
  EXPECT_EQ(Json::parse(gradescope_unfinished(k_english))["score"], 0);
}

TEST(Html, KeepsAllTextOfTheRasterizerText) {
  const std::string html = to_html(sample_result(), k_english);
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<b>bold"), std::string::npos);
  EXPECT_EQ(occurrences(html, "<script"), 2u);
  EXPECT_EQ(occurrences(html, "</script"), 2u);
  EXPECT_FALSE(has_control_characters(html));
}

TEST(Html, ShowsTheCrossingsAsFractionsAndTheMarks) {
  const std::string html = to_html(sample_result(), k_english);
  EXPECT_NE(html.find("x = 11&#x2F;7 = 1.57"), std::string::npos);  // (1,1)-(3,8) at y = 3
  EXPECT_EQ(occurrences(html, "class=\"missing\""), 1u);
  EXPECT_EQ(occurrences(html, "class=\"extra\""), 1u);
  EXPECT_EQ(occurrences(html, "src=\"data:image/png;base64,"), 3u);
}

TEST(Html, IsWholeWhenEmptyAndBoundedWhenThereIsTooMuch) {
  EXPECT_NE(to_html(CheckResult{}, k_english).find("Nothing was found."), std::string::npos);
  CheckResult r = thousand_findings();
  for (conformance::Finding& f : r.findings) {
    conformance::Example& e = f.examples.front();
    e.frame.x = e.frame.y = 64, e.expected = {64, 64, std::vector<std::uint8_t>(3 * 64 * 64), {}};
    std::uint32_t noise = 1;
    for (std::uint8_t& b : e.expected.rgb)
      b = static_cast<std::uint8_t>((noise = noise * 1664525u + 1013904223u) >> 24u);
    e.got = e.expected, e.owners.clear();
  }
  const std::string html = to_html(r, k_english);
  EXPECT_LT(html.size(), 10u << 20u);
  EXPECT_NE(html.find("pictures are left out"), std::string::npos);
  EXPECT_NE(html.find("finding-1000"), std::string::npos);
}

TEST(RowStory, CountsParityLikeTheOracle) {
  std::uint32_t noise = 7;
  const auto random = [&] {
    return static_cast<std::int32_t>(((noise = noise * 1664525u + 1013904223u) >> 16u) % 16u);
  };
  for (int round = 0; round < 500; ++round) {
    std::vector<ScreenVertex> polygon(3 + round % 4);
    for (ScreenVertex& v : polygon) v.x = random(), v.y = random();
    const conformance::Window window{0, 0, 16, 16};
    const conformance::Bitmap masks = conformance::coverage_masks(polygon, window);
    for (int y = 0; y < 16; ++y) {
      const auto row = crossings(polygon, y);
      for (int x = 0; x < 16; ++x) {
        const bool inside = (masks.get(x, y) & conformance::rule_bit(conformance::ConsistentRule::lb)) != 0;
        EXPECT_EQ(crossings_up_to(row, x) % 2 == 1, inside) << round << ": " << x << ' ' << y;
      }
    }
  }
}

TEST(RowStory, DecidesBySidesAsByCrossings) {
  for (int x = -3; x <= 12; ++x) {
    const std::vector<ScreenVertex> polygon = {
        {-2, -5, 0, 0, 0, 0, 0}, {9, 4, 0, 0, 0, 0, 0}, {1, 8, 0, 0, 0, 0, 0}};
    for (int y = -5; y < 8; ++y) {
      for (const Crossing& c : crossings(polygon, y))
        EXPECT_EQ(edge_sum(c, x, y).value >= 0, c.numerator <= x * c.denominator) << x << ' ' << y;
    }
  }
  const Crossing edge{0, 1, {-1, -3, 0, 0, 0, 0, 0}, {-4, 2, 0, 0, 0, 0, 0}};
  EXPECT_EQ(edge_sum(edge, -5, 1).text,
            "(-5 \u2212 (\u22121))\u00B75 \u2212 (1 \u2212 (\u22123))\u00B7(\u22123) = \u22128");
}

TEST(RowStory, WritesFractionsInLowestTerms) {
  EXPECT_EQ(fraction(12662, 40), "6331/20 = 316.55");
  EXPECT_EQ(fraction(80, 40), "2");
  EXPECT_EQ(fraction(-3, 6), "-1/2 = -0.50");
}

}  // namespace
}  // namespace farop::conformance_report
