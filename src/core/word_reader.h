// SPDX-License-Identifier: GPL-3.0-or-later
// Words of a text file with their positions, read block by block: memory does not grow with the file.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostics.h"
#include "core/progress.h"
#include "core/text_feed.h"

namespace farop {

/// A run of bytes without white space. `text` is valid until the next call of WordReader::next().
struct Word {
  std::string_view text;
  std::uint64_t line = 0;    ///< from 1; LF, CR and CRLF each end a line
  std::uint64_t column = 0;  ///< from 1, in bytes
  std::uint64_t offset = 0;  ///< of the first byte in the file
};

/// White space is space, tab, LF, CR, FF, VT; `#` starts a comment that runs to the end of the line, also
/// directly behind a word. A UTF-8 byte order mark at the start is skipped. All other bytes, NUL included,
/// belong to words; a NUL also ends a comment, so that binary data cannot hide in one. A word is cut after
/// k_max_word bytes (its rest is dropped), so that junk cannot fill the memory.
class WordReader {
 public:
  static constexpr std::size_t k_max_word = 4096;

  /// Opens a file; "-" is standard input. Throws Error(ExitStatus::input) when it cannot be opened or is a
  /// directory; reading errors throw the same from next().
  explicit WordReader(const std::string& path);
  /// Reads `text` (not copied; it must outlive the reader) under the name `name`.
  WordReader(std::string_view text, std::string name);
  ~WordReader();
  WordReader(const WordReader&) = delete;
  WordReader& operator=(const WordReader&) = delete;

  /// The next word; false at the end of the file.
  bool next(Word& word);
  /// The short way to the next word where that is a plain decimal number, [sign] digits [. digits], with
  /// white space alone before it: its value, rounded to nearest. False, and nothing read, in every other
  /// case, also where this way cannot tell: then next() and a full conversion decide. Together with those it
  /// gives the same numbers as they do alone.
  bool next_decimal(double& value);
  /// The same for a whole number lowest .. highest of at most nine digits without a sign.
  bool next_count(std::int64_t lowest, std::int64_t highest, std::int64_t& value);
  /// A line that peek_integers() has found, and where its words stand. Valid until the reader moves.
  struct IntegerLine {
    static constexpr std::size_t k_most = 8;
    std::array<std::uint32_t, k_most> columns{};  ///< from 0
    std::uint64_t line = 0, line_start = 0;
    std::uint64_t lines = 0;    ///< that end before it
    const char* end = nullptr;  ///< where its last word ends

    /// Word i, without its text.
    Word place(std::size_t i) const {
      return {{}, line, columns[i] + std::uint64_t{1}, line_start + columns[i]};
    }
  };
  /// The next line, if it certainly is nothing but values.size() <= k_most integers of one to seven digits,
  /// one blank between them, and the reader stands behind the last word of the line before. Nothing is read.
  /// False in every other case, also where this way cannot tell: then next() decides.
  bool peek_integers(std::span<std::int64_t> values, IntegerLine& line) const;
  /// Goes behind the last word of a line just peeked at.
  void take(const IntegerLine& line);
  /// What is at hand of the text from the first byte of `word` on, the one that next() delivered last.
  std::string_view text_from(const Word& word) const;
  /// The place behind `passed`, a text that begins where `from` does and has no CR that does not stand in
  /// front of an LF. Without a text.
  static Word place_behind(const Word& from, std::string_view passed);
  /// Goes on at a place at hand, behind the last byte of a word.
  void go_to(const Word& place);
  /// A second character that starts a comment where a word could start ('%' in the AFF dialect), 0 for none.
  void set_second_comment_character(char c) { second_comment_ = c; }

  /// Text in memory, without a byte order mark; nothing where this reader reads a file.
  std::optional<std::string_view> text_in_memory() const;
  /// The next bytes of the file as they are; 0 at its end. For a feed.
  std::size_t read_bytes(char* to, std::size_t most);
  /// Whether the file is there as a whole: no pipe, no terminal.
  bool is_regular_file() const { return is_regular_file_; }
  /// From now on the text comes from `feed` (not owned), which begins where this reader stands; to be called
  /// before the first word is read. With nullptr at last: the text has ended.
  void set_feed(TextFeed* feed);

  const std::string& name() const { return name_; }
  std::uint64_t bytes_read() const { return consumed_ + position_; }
  /// Size of the file, 0 when not known (pipes).
  std::uint64_t bytes_total() const { return total_; }
  void set_progress(ProgressFunction progress) { progress_ = std::move(progress); }

  /// Position just behind the last byte read.
  SourceLocation here() const { return {name_, line_, column()}; }
  /// A diagnostic about a word that next() delivered, with its source line while that is still in the buffer.
  Diagnostic diagnostic(Severity severity, const Word& word, std::string message,
                        std::string hint = {}) const;

 private:
  /// Where the next word begins, if that is certain without reading on and `room` bytes follow; counts lines.
  struct Ahead {
    std::size_t at = 0;
    std::uint64_t lines = 0, line_start = 0;
  };
  bool look_ahead(std::size_t room, Ahead& ahead) const;
  void go_to(const char* behind_word, const Ahead& ahead);
  bool fill();
  bool take_block();
  std::uint64_t column() const { return consumed_ + position_ - line_start_ + 1; }
  void end_line(char c);
  void skip_comment();
  void skip_rest_of_word();

  std::string name_;
  int descriptor_ = -1;
  std::unique_ptr<char[]> storage_;
  const char* data_ = nullptr;
  std::size_t position_ = 0;  ///< next byte in data_
  std::size_t end_ = 0;
  std::size_t readable_ = 0;    ///< bytes behind end_ that messages may show, counted from data_; 0: none
  std::uint64_t consumed_ = 0;  ///< file offset of data_[0]
  std::uint64_t line_ = 1;
  std::uint64_t line_start_ = 0;  ///< file offset of the current line
  std::uint64_t total_ = 0;
  bool last_was_cr_ = false;
  bool word_was_cut_ = false;
  bool at_end_ = false;
  bool is_regular_file_ = false;
  TextFeed* feed_ = nullptr;
  char second_comment_ = 0;
  ProgressFunction progress_;
};

}  // namespace farop
