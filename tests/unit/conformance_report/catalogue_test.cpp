// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/catalogue.h"

#include <gtest/gtest.h>

#include <set>

#include "conformance/corpus.h"
#include "conformance_report/html_report.h"
#include "conformance_report/terminal_report.h"
#include "conformance_report/web_files_internal.h"
#include "sample_result.h"

namespace farop::conformance_report {
namespace {

const Catalogue k_english(Language::english), k_portuguese(Language::portuguese);

std::set<std::string> between(std::string_view text, std::string_view open, std::string_view close) {
  std::set<std::string> found;
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string_view::npos;) {
    const std::size_t from = at + open.size(), end = text.find(close, from);
    found.emplace(text.substr(from, end - from));
    at = end;
  }
  return found;
}

TEST(Catalogue, KnowsAllThatThePageSaysItself) {
  std::set<std::string> said = between(k_web_template, "[[", "]]");
  said.merge(between(k_web_script, " t('", "')"));
  said.merge(between(k_web_script, "(t('", "')"));
  said.merge(between(k_web_script, "{t('", "')"));
  EXPECT_GT(said.size(), 100u);
  for (const std::string& sentence : said) EXPECT_TRUE(k_portuguese.has(sentence)) << sentence;
}

TEST(Catalogue, KnowsThePurposeOfEveryCase) {
  std::set<std::string> purposes;
  for (const auto level : {conformance::Level::normal, conformance::Level::thorough}) {
    for (const conformance::Case& c : conformance::make_corpus({level, 1, true})) purposes.insert(c.purpose);
  }
  for (const std::string& purpose : purposes) EXPECT_TRUE(k_portuguese.has(purpose)) << purpose;
}

TEST(Catalogue, PutsWhatStandsInGapsIntoTheTranslation) {
  EXPECT_EQ(k_portuguese("everything sits half a pixel too far left"),
            "tudo está meio pixel demais à esquerda");
  EXPECT_EQ(k_portuguese("whole rows are missing (3 of 4 wrong samples explained)"),
            "faltam linhas inteiras (3 de 4 amostras erradas explicadas)");
  EXPECT_EQ(k_portuguese("two pictures that must be equal are not: The same polygons in a larger frame."),
            "duas imagens que devem ser iguais não são: Os mesmos polígonos num quadro maior.");
  EXPECT_EQ(k_portuguese("division by zero in polygon 3 (4 corners, first at 1,2)"),
            "divisão por zero no polígono 3 (4 vértices, o primeiro em 1,2)");
}

TEST(Catalogue, LeavesWhatItDoesNotKnow) {
  for (const char* text : {"", "cov.leak", "{0} {1} {}", "what a rasterizer says", "{", "nonsense ({} of"}) {
    EXPECT_EQ(k_portuguese(text), text);
    EXPECT_EQ(k_english(text), text);
  }
  const std::string endless(100000, '(');
  EXPECT_EQ(k_portuguese(endless), endless);
}

TEST(Catalogue, TranslatesSentencesAndKeepsNames) {
  conformance::CheckResult r = sample_result();
  r.findings[0].message = "whole rows are missing", r.cases[0].purpose = "A random triangle.";
  const conformance::CheckResult t = translated(r, k_portuguese);
  EXPECT_EQ(t.findings[0].message, "faltam linhas inteiras");
  EXPECT_EQ(t.cases[0].purpose, "Um triângulo aleatório.");
  EXPECT_EQ(t.findings[0].verdict, r.findings[0].verdict);
  EXPECT_EQ(t.cases[0].id, r.cases[0].id);
  EXPECT_EQ(translated(r, k_english).findings[0].message, r.findings[0].message);
}

TEST(Html, SpeaksPortuguese) {
  const std::string page = to_html(translated(sample_result(), k_portuguese), k_portuguese);
  EXPECT_NE(page.find("<html lang=\"pt\">"), std::string::npos);
  EXPECT_NE(page.find("Regra de preenchimento"), std::string::npos);
  EXPECT_EQ(page.find("Fill rule"), std::string::npos);
  EXPECT_EQ(page.substr(0, page.find("<script")).find("[["), std::string::npos);
}

TEST(Terminal, SaysTheSameForProgramsInEveryLanguage) {
  const conformance::CheckResult r = sample_result();
  const std::string english = to_terminal(r, k_english, false);
  const std::string portuguese = to_terminal(translated(r, k_portuguese), k_portuguese, false);
  const auto lines = [](const std::string& text) { return text.substr(0, text.find("\n\n")); };
  EXPECT_EQ(lines(english), lines(portuguese));
  EXPECT_NE(english.find("fail: 4 cases, 2 failed"), std::string::npos) << english;
  EXPECT_NE(portuguese.find("fail: 4 casos, 2 falharam"), std::string::npos) << portuguese;
  EXPECT_NE(english.find("<>"), std::string::npos);
  EXPECT_EQ(english.find('\033'), std::string::npos);
  EXPECT_NE(to_terminal(r, k_english, true).find("\033[48;2;200;80;40m"), std::string::npos);
}

}  // namespace
}  // namespace farop::conformance_report
