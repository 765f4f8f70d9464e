// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/word_reader.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

#include "core/error.h"

namespace farop {
namespace {

struct Found {
  std::string text;
  std::uint64_t line, column, offset;
  friend bool operator==(const Found&, const Found&) = default;
};

std::ostream& operator<<(std::ostream& out, const Found& f) {
  return out << '\'' << f.text << "' " << f.line << ':' << f.column << '@' << f.offset;
}

std::vector<Found> words(WordReader& reader) {
  std::vector<Found> found;
  for (Word word; reader.next(word);)
    found.push_back({std::string(word.text), word.line, word.column, word.offset});
  return found;
}

std::vector<Found> words(std::string_view text, char second_comment = 0) {
  WordReader reader(text, "memory");
  if (second_comment != 0) reader.set_second_comment_character(second_comment);
  return words(reader);
}

class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view text) {
    path_ = testing::TempDir() + "/farop_words_XXXXXX";
    const int descriptor = ::mkstemp(path_.data());
    EXPECT_GE(descriptor, 0);
    ::close(descriptor);
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(WordReader, SplitsAtAllWhiteSpace) {
  EXPECT_EQ(
      words(" p\t3\v4\f5\r6\n7 "),
      (std::vector<Found>{
          {"p", 1, 2, 1}, {"3", 1, 4, 3}, {"4", 1, 6, 5}, {"5", 1, 8, 7}, {"6", 2, 1, 9}, {"7", 3, 1, 11}}));
}

TEST(WordReader, FindsNothingInNothing) {
  for (const char* text : {"", " ", "\n\r\n", "# comment", "\xEF\xBB\xBF", "#"})
    EXPECT_TRUE(words(text).empty()) << text;
}

TEST(WordReader, CountsLfCrAndCrLfAsOneLineEndEach) {
  const std::pair<const char*, std::uint64_t> cases[] = {
      {"\nw", 2},       {"\rw", 2},     {"\r\nw", 2},   {"\n\nw", 3},   {"\r\rw", 3},
      {"\r\n\r\nw", 3}, {"\n\rw", 3},   {"\r \nw", 3},  {"#c\r\nw", 2}, {"#c\rw", 2},
      {"a\r\nw", 2},    {"\r#c\nw", 3}, {"\r\n\nw", 3}, {"\r\r\nw", 3}};
  for (const auto& [text, line] : cases)
    EXPECT_EQ(words(text).back().line, line) << testing::PrintToString(std::string(text));
}

TEST(WordReader, EndsCommentsAtTheLineEnd) {
  EXPECT_EQ(words("a#b c\rd # e\n#\nf#"),
            (std::vector<Found>{{"a", 1, 1, 0}, {"d", 2, 1, 6}, {"f", 4, 1, 14}}));
}

TEST(WordReader, LetsNoNulByteHideInAComment) {
  const std::vector<Found> found = words(std::string_view("a # b\0c d\ne", 11));
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[1], (Found{std::string("\0c", 2), 1, 6, 5}));
  EXPECT_EQ(found[3], (Found{"e", 2, 1, 10}));
}

TEST(WordReader, KnowsASecondCommentCharacterAtTheStartOfWords) {
  EXPECT_EQ(words("% a b\nc%d %e\nf", '%'), (std::vector<Found>{{"c%d", 2, 1, 6}, {"f", 3, 1, 13}}));
  EXPECT_EQ(words("% a").size(), 2u);
}

TEST(WordReader, SkipsAByteOrderMarkAtTheStartOnly) {
  EXPECT_EQ(words("\xEF\xBB\xBFp 1\n\xEF\xBB\xBF"),
            (std::vector<Found>{{"p", 1, 1, 3}, {"1", 1, 3, 5}, {"\xEF\xBB\xBF", 2, 1, 7}}));
  EXPECT_EQ(words("\xEF\xBBp").at(0).text, "\xEF\xBBp");
}

TEST(WordReader, CutsOverlongWordsAndDropsTheirRest) {
  for (const std::size_t length : {WordReader::k_max_word - 1, WordReader::k_max_word,
                                   WordReader::k_max_word + 1, std::size_t{2'000'000}}) {
    const std::string text = std::string(length, 'x') + "#c\n y";
    const TemporaryFile file(text);
    WordReader reader(file.path());
    for (const std::vector<Found>& found : {words(text), words(reader)}) {
      ASSERT_EQ(found.size(), 2u) << length;
      EXPECT_EQ(found[0].text.size(), std::min(length, WordReader::k_max_word));
      EXPECT_EQ(found[1], (Found{"y", 2, 2, length + 4}));
    }
  }
}

TEST(WordReader, FindsTheSameWordsInFilesAsInMemory) {
  // Lengths that make words, comments and CRLF fall on the edges of blocks in every way.
  std::mt19937 random(7);
  const char* const pieces[] = {
      " ", "\n", "\r\n", "\r", "word", "-1.5e+07", "#", "# comment of some length\r\n", "%", "\t\t", "p 3"};
  for (int round = 0; round < 4; ++round) {
    std::string text = round % 2 == 0 ? "\xEF\xBB\xBF" : "";
    while (text.size() < 900'000) {
      if (random() % 2000 == 0) text += std::string(random() % 9000, 'x');
      if (random() % 20000 == 0) text += '#' + std::string(random() % 400'000, ' ');
      text += pieces[random() % std::size(pieces)];
    }
    const TemporaryFile file(text);
    WordReader reader(file.path());
    EXPECT_EQ(reader.bytes_total(), text.size());
    EXPECT_TRUE(words(reader) == words(text));
    EXPECT_EQ(reader.bytes_read(), text.size());
  }
}

TEST(WordReader, ReadsPipesInWhateverPiecesTheyDeliver) {
  const std::string path = testing::TempDir() + "/farop_words_fifo_" + std::to_string(::getpid());
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const std::string text = "\xEF\xBB\xBFp 3\r\n1.5 # c\r\nlast";
  std::thread writer([&] {
    std::FILE* pipe = std::fopen(path.c_str(), "wb");
    for (const char c : text) {
      std::fputc(c, pipe);
      std::fflush(pipe);
      std::this_thread::yield();
    }
    std::fclose(pipe);
  });
  {
    WordReader reader(path);
    EXPECT_EQ(reader.bytes_total(), 0u);
    EXPECT_EQ(words(reader), words(text));
  }
  writer.join();
  std::remove(path.c_str());
}

TEST(WordReader, ReportsProgressOncePerBlock) {
  const TemporaryFile file(std::string(1'000'000, '\n') + "w");
  WordReader reader(file.path());
  std::vector<std::uint64_t> done;
  reader.set_progress([&](std::uint64_t bytes, std::uint64_t total) {
    EXPECT_EQ(total, 1'000'001u);
    done.push_back(bytes);
  });
  words(reader);
  EXPECT_GE(done.size(), 4u);
  EXPECT_LE(done.size(), 10u);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

TEST(WordReader, RefusesWhatItCannotOpen) {
  EXPECT_THROW(WordReader(std::string("/nonexistent/scene.nff")), Error);
  try {
    WordReader reader(testing::TempDir());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::input);
    EXPECT_NE(std::string(error.what()).find("is a directory"), std::string::npos);
  }
}

TEST(WordReader, MakesDiagnosticsWithTheSourceLine) {
  WordReader reader("a b\r\n  word#c\r\nd", "scene.nff");
  Word word;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(reader.next(word));
  const Diagnostic d = reader.diagnostic(Severity::warning, word, "message", "hint");
  EXPECT_EQ(d.severity, Severity::warning);
  EXPECT_EQ(d.where.file, "scene.nff");
  EXPECT_EQ(d.where.line, 2u);
  EXPECT_EQ(d.where.column, 3u);
  EXPECT_EQ(d.message, "message");
  EXPECT_EQ(d.hint, "hint");
  EXPECT_EQ(d.excerpt, "  word#c");
  EXPECT_EQ(d.excerpt_column, 3u);
  EXPECT_EQ(d.length, 4u);
}

TEST(WordReader, MakesDiagnosticsAboutEarlierWordsWhileTheirLineIsAtHand) {
  std::string text = "first\n";
  for (int i = 0; i < 300'000; ++i) text += "w\n";
  const TemporaryFile file(text);
  WordReader reader(file.path());
  Word first, word;
  ASSERT_TRUE(reader.next(first));
  ASSERT_TRUE(reader.next(word));
  EXPECT_EQ(reader.diagnostic(Severity::error, first, "m").excerpt, "first");
  while (reader.next(word)) {
  }
  const Diagnostic late = reader.diagnostic(Severity::error, first, "m");
  EXPECT_EQ(late.where.line, 1u);
  EXPECT_TRUE(late.excerpt.empty());
  EXPECT_EQ(late.excerpt_column, 0u);
}

TEST(WordReader, KeepsTheExcerptOfEndlessLinesShort) {
  const std::string text = std::string(100'000, ' ') + "here" + std::string(100'000, ' ');
  WordReader reader(text, "memory");
  Word word;
  ASSERT_TRUE(reader.next(word));
  const Diagnostic d = reader.diagnostic(Severity::error, word, "m");
  EXPECT_EQ(d.where.column, 100'001u);
  EXPECT_LE(d.excerpt.size(), 1024u);
  EXPECT_EQ(d.excerpt.substr(d.excerpt_column - 1, 4), "here");
  EXPECT_EQ(d.length, 4u);
}

}  // namespace
}  // namespace farop
