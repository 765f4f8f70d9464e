// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/word_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace farop {
namespace {

constexpr std::size_t k_block = std::size_t{1} << 18;
/// Bytes kept behind the reading position when the buffer is refilled, for the source line of a diagnostic.
constexpr std::size_t k_context = 1024;
/// Of a long source line a diagnostic carries this much on either side of the word's first byte.
constexpr std::size_t k_excerpt_side = 512;
constexpr std::size_t k_capacity = k_block + k_context + WordReader::k_max_word;

constexpr bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// White space and '#', by byte: one look instead of four comparisons for every byte of every word.
constexpr std::array<bool, 256> k_ends_word = [] {
  std::array<bool, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = is_space(static_cast<char>(i)) || i == '#';
  return table;
}();

const char* word_end(const char* first, const char* last) {
  while (first != last && !k_ends_word[static_cast<unsigned char>(*first)]) ++first;
  return first;
}

}  // namespace

WordReader::WordReader(const std::string& path) : name_(path == "-" ? "<stdin>" : path) {
  descriptor_ = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw Error(ExitStatus::input, fmt::format("{}: cannot open: {}", path, std::strerror(errno)));
  }
  struct stat info {};
  if (::fstat(descriptor_, &info) == 0) {
    if (S_ISDIR(info.st_mode)) {
      if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
      throw Error(ExitStatus::input, fmt::format("{}: is a directory, expected a file", name_));
    }
    if (S_ISREG(info.st_mode)) total_ = static_cast<std::uint64_t>(info.st_size);
  }
  storage_ = std::make_unique<char[]>(k_capacity);
  data_ = storage_.get();
}

WordReader::WordReader(std::string_view text, std::string name)
    : name_(std::move(name)), data_(text.data()), end_(text.size()), total_(text.size()) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") position_ = 3, line_start_ = 3;
}

WordReader::~WordReader() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

// Moves what is still needed (the unread rest and some context) to the front and reads on. False at the end.
bool WordReader::fill() {
  if (descriptor_ < 0 || at_end_) return false;  // a terminal would go on after its end of file
  const bool first_block = consumed_ == 0 && end_ == 0;
  const std::size_t keep_from = position_ > k_context ? position_ - k_context : 0;
  std::memmove(storage_.get(), storage_.get() + keep_from, end_ - keep_from);
  consumed_ += keep_from, position_ -= keep_from, end_ -= keep_from;
  if (progress_) progress_(bytes_read(), total_);
  std::size_t wanted = std::min(k_block, k_capacity - end_);
  std::size_t got_here = 0;
  for (;;) {
    const ssize_t got = ::read(descriptor_, storage_.get() + end_, wanted);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw Error(ExitStatus::input, fmt::format("{}: cannot read: {}", name_, std::strerror(errno)));
    end_ += static_cast<std::size_t>(got), got_here += static_cast<std::size_t>(got);
    wanted -= static_cast<std::size_t>(got);
    at_end_ = got == 0;
    if (!first_block || got == 0 || end_ >= 3) break;  // the byte order mark may arrive in pieces
  }
  if (first_block && end_ >= 3 && std::memcmp(data_, "\xEF\xBB\xBF", 3) == 0) position_ = 3, line_start_ = 3;
  return got_here > 0;
}

void WordReader::end_line(char c) {
  if (c == '\n' && last_was_cr_) {
    // Second half of CRLF: the line was counted at the CR.
  } else {
    ++line_;
  }
  line_start_ = consumed_ + position_;
}

void WordReader::skip_comment() {
  const auto goes_on = [](char c) { return c != '\n' && c != '\r' && c != '\0'; };
  for (;;) {
    while (position_ < end_ && goes_on(data_[position_])) ++position_;
    if (position_ < end_ || !fill()) return;
  }
}

void WordReader::skip_rest_of_word() {
  for (;;) {
    position_ = static_cast<std::size_t>(word_end(data_ + position_, data_ + end_) - data_);
    if (position_ < end_ || !fill()) return;
  }
}

bool WordReader::next(Word& word) {
  if (word_was_cut_) skip_rest_of_word();
  word_was_cut_ = false;
  for (;;) {
    if (position_ == end_ && !fill()) return false;
    const char c = data_[position_];
    if (is_space(c)) {
      ++position_;
      if (c == '\n' || c == '\r') end_line(c);
      last_was_cr_ = c == '\r';
    } else if (c == '#' || (second_comment_ != 0 && c == second_comment_)) {
      skip_comment();
      last_was_cr_ = false;
    } else {
      break;
    }
  }
  last_was_cr_ = false;
  word.line = line_;
  word.column = column();
  word.offset = bytes_read();
  std::size_t length = 0;
  for (;;) {
    const char* const start = data_ + position_;
    const char* const limit = start + std::min(end_ - position_, k_max_word);
    length = static_cast<std::size_t>(word_end(start + length, limit) - start);
    if (position_ + length < end_ || length == k_max_word || !fill()) break;  // fill() keeps the unread bytes
  }
  word.text = {data_ + position_, length};
  position_ += length;
  word_was_cut_ = length == k_max_word;  // its rest goes with the next call: `text` points into the buffer
  return true;
}

Diagnostic WordReader::diagnostic(Severity severity, const Word& word, std::string message,
                                  std::string hint) const {
  Diagnostic d;
  d.severity = severity;
  d.where = {name_, word.line, word.column};
  d.message = std::move(message);
  d.hint = std::move(hint);
  if (word.offset < consumed_ || data_ == nullptr) return d;
  const std::size_t start = static_cast<std::size_t>(word.offset - consumed_);
  const std::uint64_t before =
      std::min({word.column - 1, std::uint64_t{start}, std::uint64_t{k_excerpt_side}});
  const char* const end = data_ + std::min(end_, start + k_excerpt_side);
  const auto ends_line = [](char c) { return c == '\n' || c == '\r'; };
  const char* line_end = std::find_if(data_ + start, end, ends_line);
  d.excerpt.assign(data_ + start - before, line_end);
  d.excerpt_column = static_cast<std::size_t>(before) + 1;
  d.length = static_cast<std::size_t>(word_end(data_ + start, line_end) - (data_ + start));
  return d;
}

}  // namespace farop
