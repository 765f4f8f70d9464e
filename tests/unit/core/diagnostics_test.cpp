// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/diagnostics.h"

#include <gtest/gtest.h>

namespace farop {
namespace {

Diagnostic diagnostic(Severity severity, std::uint64_t line, std::uint64_t column) {
  Diagnostic d;
  d.severity = severity;
  d.where = {"gears.nff", line, column};
  d.message = "'pp' announces 3 vertices";
  return d;
}

TEST(DiagnosticText, NamesThePlaceAsFarAsItIsKnown) {
  EXPECT_EQ(to_text(diagnostic(Severity::error, 9, 4)), "gears.nff:9:4: error: 'pp' announces 3 vertices\n");
  EXPECT_EQ(to_text(diagnostic(Severity::warning, 9, 0)),
            "gears.nff:9: warning: 'pp' announces 3 vertices\n");
  EXPECT_EQ(to_text(diagnostic(Severity::note, 0, 0)), "gears.nff: note: 'pp' announces 3 vertices\n");
}

TEST(DiagnosticText, PointsAtTheWordAndGivesTheHint) {
  Diagnostic d = diagnostic(Severity::error, 9, 3);
  d.excerpt = "  pp 3";
  d.excerpt_column = 3;
  d.length = 2;
  d.hint = "add the missing vertices";
  EXPECT_EQ(to_text(d),
            "gears.nff:9:3: error: 'pp' announces 3 vertices\n"
            "     9 |   pp 3\n"
            "       |   ^~\n"
            "  hint: add the missing vertices\n");
}

TEST(DiagnosticText, PointsAtTheFirstColumn) {
  Diagnostic d = diagnostic(Severity::error, 1, 1);
  d.excerpt = "q 1";
  d.excerpt_column = 1;
  EXPECT_EQ(to_text(d), "gears.nff:1:1: error: 'pp' announces 3 vertices\n     1 | q 1\n       | ^\n");
}

TEST(DiagnosticText, HasNoPictureWithoutASourceLine) {
  Diagnostic d = diagnostic(Severity::error, 9, 3);
  d.excerpt = "short";
  d.excerpt_column = 17;
  EXPECT_EQ(to_text(d), "gears.nff:9:3: error: 'pp' announces 3 vertices\n");
}

TEST(DiagnosticText, ShowsControlAndForeignBytesAsDots) {
  Diagnostic d = diagnostic(Severity::error, 1, 5);
  d.excerpt = "a\tb\x1B[1m\xC3\xA4 q";
  d.excerpt_column = 10;
  EXPECT_EQ(to_text(d),
            "gears.nff:1:5: error: 'pp' announces 3 vertices\n     1 | a b.[1m.. q\n       |          ^\n");
}

TEST(DiagnosticText, CutsLongLinesAroundTheCaret) {
  Diagnostic d = diagnostic(Severity::error, 1, 501);
  d.excerpt = std::string(500, 'a') + "word" + std::string(500, 'b');
  d.excerpt_column = 501;
  d.length = 4;
  const std::string text = to_text(d);
  EXPECT_LT(text.size(), 300u);
  EXPECT_NE(text.find("aaaword"), std::string::npos);
  const std::size_t line = text.find("     1 | ");
  const std::size_t picture = text.find("       | ", line);
  EXPECT_EQ(text.find('^', picture) - picture, text.find("word", line) - line);
  EXPECT_NE(text.find("^~~~\n"), std::string::npos);
}

TEST(DiagnosticText, KeepsTheUnderlineWithinTheShownPart) {
  Diagnostic d = diagnostic(Severity::error, 1, 1);
  d.excerpt = std::string(300, 'x');
  d.excerpt_column = 1;
  d.length = 5000;
  EXPECT_NE(to_text(d).find("| ^" + std::string(99, '~') + "\n"), std::string::npos);
}

TEST(DiagnosticList, CountsBySeverity) {
  DiagnosticList list;
  list.report(diagnostic(Severity::warning, 1, 1));
  list.report(diagnostic(Severity::warning, 2, 1));
  list.report(diagnostic(Severity::error, 3, 1));
  EXPECT_EQ(list.count(Severity::warning), 2u);
  EXPECT_EQ(list.count(Severity::error), 1u);
  EXPECT_EQ(list.count(Severity::note), 0u);
}

TEST(Printable, KeepsTextAndReplacesTheRest) {
  const std::pair<std::string, std::string> cases[] = {
      {"", ""},
      {"plain text", "plain text"},
      {"a\tb\nc", "a?b?c"},
      {std::string("nul\0byte", 8), "nul?byte"},
      {"\x1B[31m", "?[31m"},
      {"\x7F", "?"},
      {"Stra\xC3\x9F"
       "e",
       "Stra\xC3\x9F"
       "e"},                                     // U+00DF
      {"\xE2\x82\xAC 5", "\xE2\x82\xAC 5"},      // U+20AC
      {"\xF0\x9F\x98\x80", "\xF0\x9F\x98\x80"},  // U+1F600
      {"\xC2\x85", "??"},                        // U+0085, a control character
      {"\xE2\x80\xAE"
       "abc",
       "???abc"},                    // U+202E, turns text round
      {"\xC0\xAF", "??"},            // overlong
      {"\xE0\x80\xAF", "???"},       // overlong
      {"\xED\xA0\x80", "???"},       // surrogate
      {"\xF4\x90\x80\x80", "????"},  // beyond U+10FFFF
      {"\xFF\xFE", "??"},
      {"\x80", "?"},
      {"\xE2\x82", "??"},  // cut short
      {"\xC3(", "?("},
  };
  for (const auto& [text, shown] : cases) EXPECT_EQ(printable(text), shown) << text;
}

TEST(Printable, CutsLongTextBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 6), "abcdef");
  EXPECT_EQ(printable("abcdefg", 6), "abcdef...");
  EXPECT_EQ(printable("ab\xE2\x82\xAC", 4), "ab...");
  EXPECT_EQ(printable("ab\xE2\x82\xAC", 5), "ab\xE2\x82\xAC");
  EXPECT_EQ(printable(std::string(5000, 'x')).size(), 63u);
}

}  // namespace
}  // namespace farop
