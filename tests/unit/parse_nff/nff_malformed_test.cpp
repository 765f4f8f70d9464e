// SPDX-License-Identifier: GPL-3.0-or-later
// Every malformed file of the corpus gives exactly the message that lies beside it, at exactly that place.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "nff_text.h"

namespace farop {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> corpus() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(FAROP_SOURCE_DIR) / "tests/corpus/nff/bad")) {
    if (entry.path().extension() == ".nff") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class NffMalformed : public testing::TestWithParam<std::string> {
 protected:
  fs::path path(const char* extension) const {
    return fs::path(FAROP_SOURCE_DIR) / "tests/corpus/nff/bad" / (GetParam() + extension);
  }
};

TEST_P(NffMalformed, GivesTheExpectedErrorAtTheExpectedPlace) {
  const std::string text = contents(path(".nff"));
  const ParsedText parsed = parse_text(text);
  EXPECT_TRUE(ends_in_scene_or_one_error(parsed));
  EXPECT_FALSE(parsed.scene);
  ASSERT_FALSE(parsed.reports.empty());
  EXPECT_EQ(parsed.report(parsed.reports.size() - 1) + "\n", contents(path(".txt")));
  EXPECT_EQ(parsed.reports.back().where.file, "folder/scene.nff");
}

TEST_P(NffMalformed, GivesTheSameReportsFromAFileAsFromMemory) {
  const std::string text = contents(path(".nff"));
  const ParsedText from_memory = parse_text(text);
  WordReader reader(path(".nff").string());
  DiagnosticList from_file;
  EXPECT_FALSE(parse_nff(reader, from_file, {}));
  ASSERT_EQ(from_file.items.size(), from_memory.reports.size());
  for (std::size_t i = 0; i < from_file.items.size(); ++i) {
    const Diagnostic& a = from_file.items[i];
    const Diagnostic& b = from_memory.reports[i];
    EXPECT_EQ(a.message, b.message);
    EXPECT_EQ(a.hint, b.hint);
    EXPECT_EQ(a.where.line, b.where.line);
    EXPECT_EQ(a.where.column, b.where.column);
  }
}

// The caret stands under the first byte of the offending word.
TEST_P(NffMalformed, ShowsTheLineOfTheError) {
  const std::string text = contents(path(".nff"));
  const Diagnostic error = parse_text(text).reports.back();
  ASSERT_GT(error.excerpt_column, 0u);
  ASSERT_LE(error.excerpt_column, error.excerpt.size());
  EXPECT_GE(error.length, 1u);
  EXPECT_NE(text.find(error.excerpt), std::string::npos);
  if (error.excerpt.size() < 500) {
    EXPECT_EQ(error.excerpt_column, error.where.column);
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, NffMalformed, testing::ValuesIn(corpus()),
                         [](const auto& name) { return name.param; });

TEST(NffMalformedCorpus, IsThere) {
  EXPECT_GE(corpus().size(), 150u);
}

}  // namespace
}  // namespace farop
