// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sstream>

#include "conformance_report/github_report.h"
#include "sample_result.h"

namespace farop::conformance_report {
namespace {

const Catalogue k_english(Language::english);

TEST(Github, WritesOneCommandALineAndNothingElse) {
  conformance::CheckResult r = sample_result();
  r.findings[0].message = "100% wrong,\n::error::not a command: of ours";
  std::istringstream lines(to_github_annotations(r, k_english));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_TRUE(line.starts_with("::error title=") || line.starts_with("::notice title=")) << line;
  EXPECT_EQ(count, 3);
  EXPECT_NE(to_github_annotations(r, k_english).find("100%25 wrong,?::error::"), std::string::npos);
}

TEST(Github, NamesTheScriptWhereThereIsOne) {
  conformance::CheckResult r = sample_result();
  r.plugin.kind = "python", r.plugin.argument = "a,b:c.py";
  EXPECT_NE(to_github_annotations(r, k_english)
                .find("::error title=farop check%3A cov.missing,file=a%2Cb%3Ac.py::"),
            std::string::npos)
      << to_github_annotations(r, k_english);
}

TEST(Github, ShowsTenOfAKind) {
  conformance::CheckResult r = sample_result();
  r.findings.assign(50, r.findings[0]);
  std::istringstream lines(to_github_annotations(r, k_english));
  int count = 0;
  for (std::string line; std::getline(lines, line);) ++count;
  EXPECT_EQ(count, 11);
}

TEST(Github, SummaryIsATableWithoutForeignMarkup) {
  conformance::CheckResult r = sample_result();
  r.findings[0].message = "a | b <img src=x> [link](http://x) @everyone";
  const std::string text = to_github_summary(r, k_english);
  EXPECT_NE(text.find("a \\| b &lt;img src=x&gt; \\[link\\]\\(http://x\\) \\@everyone"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("<script>"), std::string::npos);
  EXPECT_NE(text.find("| smoke | 1 | 1 | 0 |"), std::string::npos) << text;
}

}  // namespace
}  // namespace farop::conformance_report
