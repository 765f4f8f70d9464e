// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/word_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
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

std::uint64_t count_line_ends(std::string_view text) {
  constexpr std::size_t k_at_once = 128;  // counted in bytes: whole vectors of them
  std::uint64_t lines = 0;
  for (; text.size() >= k_at_once; text.remove_prefix(k_at_once)) {
    std::uint8_t some = 0;
    for (std::size_t i = 0; i < k_at_once; ++i) some = static_cast<std::uint8_t>(some + (text[i] == '\n'));
    lines += some;
  }
  return lines + static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

const char* word_end(const char* first, const char* last) {
  while (first != last && !k_ends_word[static_cast<unsigned char>(*first)]) ++first;
  return first;
}

// Powers of ten that are doubles without rounding: a quotient of two exact numbers is rounded once (W. D.
// Clinger, "How to Read Floating Point Numbers Accurately", PLDI 1990).
constexpr std::array<double, 23> k_power_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::uint64_t k_largest_exact = std::uint64_t{1} << 53;
constexpr std::ptrdiff_t k_most_digits = 19;  // always fit 64 bits

constexpr std::array<std::uint64_t, 9> k_whole_power_of_ten = {
    1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000};

/// The value of up to eight digits at `first`, and how many there are; reads eight bytes. All in one word:
/// the number of digits is not a branch that the processor has to guess (D. Lemire, "Number parsing at a
/// gigabyte per second", Software: Practice and Experience 51(8), 2021).
struct EightDigits {
  explicit EightDigits(const char* first) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, first, sizeof bytes);
    if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
    std::uint64_t digits = bytes ^ 0x3030303030303030u;
    const std::uint64_t others = ((digits + 0x7676767676767676u) | digits) & 0x8080808080808080u;
    count = static_cast<std::size_t>(std::countr_zero(others)) / 8;  // 8 where there are no others
    if (count == 0) return;
    digits <<= 8 * (8 - count);  // zeros in front
    digits = digits * 10 + (digits >> 8);
    value = (((digits & 0x000000FF000000FFu) * 0x000F424000000064u) +
             (((digits >> 16) & 0x000000FF000000FFu) * 0x0000271000000001u)) >>
            32;
  }

  std::uint64_t value = 0;
  std::size_t count = 0;
};

/// Appends the run of digits at `first` to `value`; looks at no byte beyond `first` + k_most_digits.
const char* append_digits(const char* first, std::uint64_t& value) {
  const char* const limit = first + k_most_digits;
  while (first != limit && static_cast<unsigned char>(*first - '0') <= 9) {
    value = value * 10 + static_cast<unsigned char>(*first - '0');
    ++first;
  }
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
    is_regular_file_ = S_ISREG(info.st_mode);
    if (is_regular_file_) total_ = static_cast<std::uint64_t>(info.st_size);
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
  if (feed_ != nullptr) return take_block();
  if (descriptor_ < 0 || at_end_) return false;  // a terminal would go on after its end of file
  const bool first_block = consumed_ == 0 && end_ == 0;
  const std::size_t keep_from = position_ > k_context ? position_ - k_context : 0;
  std::memmove(storage_.get(), storage_.get() + keep_from, end_ - keep_from);
  consumed_ += keep_from, position_ -= keep_from, end_ -= keep_from;
  if (progress_) progress_(bytes_read(), total_);
  std::size_t wanted = std::min(k_block, k_capacity - end_);
  std::size_t got_here = 0;
  for (;;) {
    const std::size_t got = read_bytes(storage_.get() + end_, wanted);
    end_ += got, got_here += got;
    wanted -= got;
    at_end_ = got == 0;
    if (!first_block || got == 0 || end_ >= 3) break;  // the byte order mark may arrive in pieces
  }
  if (first_block && end_ >= 3 && std::memcmp(data_, "\xEF\xBB\xBF", 3) == 0) position_ = 3, line_start_ = 3;
  return got_here > 0;
}

std::optional<std::string_view> WordReader::text_in_memory() const {
  if (descriptor_ >= 0) return std::nullopt;
  return std::string_view(data_, end_).substr(position_);
}

void WordReader::set_feed(TextFeed* feed) {
  consumed_ += position_;  // the text read so far is out of sight
  data_ = nullptr;
  position_ = end_ = readable_ = 0;
  at_end_ = feed == nullptr;
  feed_ = feed;
}

bool WordReader::take_block() {
  // Unread bytes are here at the end of the text alone: no other block ends within a word.
  TextFeed::Block block;
  if (at_end_ || position_ < end_ || !feed_->next(block)) {
    at_end_ = true;
    return false;
  }
  const std::uint64_t offset = bytes_read();
  data_ = block.data;
  position_ = block.begin, end_ = block.end, readable_ = block.readable;
  consumed_ = offset - position_;
  if (progress_) progress_(offset, total_);
  if (offset == 0 && std::string_view(data_ + position_, end_ - position_).substr(0, 3) == "\xEF\xBB\xBF") {
    position_ += 3, line_start_ = 3;
  }
  return true;
}

std::size_t WordReader::read_bytes(char* to, std::size_t most) {
  for (;;) {
    const ssize_t got = ::read(descriptor_, to, most);
    if (got >= 0) return static_cast<std::size_t>(got);
    if (errno == EINTR) continue;
    throw Error(ExitStatus::input, fmt::format("{}: cannot read: {}", name_, std::strerror(errno)));
  }
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

bool WordReader::look_ahead(std::size_t room, Ahead& ahead) const {
  if (word_was_cut_) return false;
  ahead = {position_, 0, line_start_};
  bool after_cr = last_was_cr_;
  for (;; ++ahead.at) {
    if (ahead.at + room > end_) return false;
    const char c = data_[ahead.at];
    if (!is_space(c)) return true;
    if (c == '\n' || c == '\r') {
      if (c == '\r' || !after_cr) ++ahead.lines;  // CRLF counts once, at the CR
      ahead.line_start = consumed_ + ahead.at + 1;
    }
    after_cr = c == '\r';
  }
}

void WordReader::go_to(const char* behind_word, const Ahead& ahead) {
  line_ += ahead.lines;
  line_start_ = ahead.line_start;
  last_was_cr_ = false;
  position_ = static_cast<std::size_t>(behind_word - data_);
}

bool WordReader::next_decimal(double& value) {
  Ahead ahead;
  if (!look_ahead(2 * k_most_digits + 12, ahead)) return false;  // sign, digits, point, digits, eight bytes
  const char* p = data_ + ahead.at;
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  std::uint64_t mantissa = 0;
  const char* const whole = p;
  p = append_digits(p, mantissa);
  std::ptrdiff_t digits = p - whole;
  std::size_t scale = 0;
  if (*p == '.') {
    const char* const fraction = ++p;
    const EightDigits first(p);
    mantissa = mantissa * k_whole_power_of_ten[first.count] + first.value;
    p += first.count;
    if (first.count == 8) p = append_digits(p, mantissa);
    scale = static_cast<std::size_t>(p - fraction);
    digits += p - fraction;
  }
  if (digits == 0 || digits > k_most_digits || mantissa > k_largest_exact) return false;
  if (!k_ends_word[static_cast<unsigned char>(*p)]) return false;
  const double size = static_cast<double>(mantissa) / k_power_of_ten[scale];
  value = negative ? -size : size;
  go_to(p, ahead);
  return true;
}

bool WordReader::next_count(std::int64_t lowest, std::int64_t highest, std::int64_t& value) {
  constexpr std::ptrdiff_t k_most = 9;
  Ahead ahead;
  if (!look_ahead(k_most_digits + 1, ahead)) return false;
  const char* const first = data_ + ahead.at;
  std::uint64_t count = 0;
  const char* const p = append_digits(first, count);
  if (p == first || p - first > k_most || !k_ends_word[static_cast<unsigned char>(*p)]) return false;
  const auto whole = static_cast<std::int64_t>(count);
  if (whole < lowest || whole > highest) return false;
  value = whole;
  go_to(p, ahead);
  return true;
}

bool WordReader::peek_integers(std::span<std::int64_t> values, IntegerLine& line) const {
  constexpr std::size_t k_longest_word = 8;  // with what follows it
  Ahead ahead;
  if (!look_ahead(k_longest_word * (values.size() + 1), ahead) || ahead.lines == 0) return false;
  const char* p = data_ + ahead.at;
  const char* const line_start = data_ + (ahead.line_start - consumed_);
  line.line = line_ + ahead.lines;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const EightDigits digits(p);
    if (digits.count == 0 || digits.count == 8) return false;
    if (p[digits.count] != (i + 1 < values.size() ? ' ' : '\n')) return false;
    values[i] = static_cast<std::int64_t>(digits.value);
    line.columns[i] = static_cast<std::uint32_t>(p - line_start);
    p += digits.count + 1;
  }
  line.end = p - 1;  // at the end of the line, as behind any other word
  line.lines = ahead.lines, line.line_start = ahead.line_start;
  return true;
}

void WordReader::take(const IntegerLine& line) {
  go_to(line.end, {0, line.lines, line.line_start});
}

std::string_view WordReader::text_from(const Word& word) const {
  const std::size_t start = static_cast<std::size_t>(word.offset - consumed_);
  return {data_ + start, end_ - start};
}

Word WordReader::place_behind(const Word& from, std::string_view passed) {
  const std::uint64_t lines = count_line_ends(passed);
  const std::uint64_t column = lines == 0 ? from.column + passed.size() : passed.size() - passed.rfind('\n');
  return {{}, from.line + lines, column, from.offset + passed.size()};
}

void WordReader::go_to(const Word& place) {
  position_ = static_cast<std::size_t>(place.offset - consumed_);
  line_ = place.line;
  line_start_ = place.offset + 1 - place.column;
  last_was_cr_ = false;
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
  const char* const end = data_ + std::min(std::max(end_, readable_), start + k_excerpt_side);
  const auto ends_line = [](char c) { return c == '\n' || c == '\r'; };
  const char* line_end = std::find_if(data_ + start, end, ends_line);
  d.excerpt.assign(data_ + start - before, line_end);
  d.excerpt_column = static_cast<std::size_t>(before) + 1;
  d.length = static_cast<std::size_t>(word_end(data_ + start, line_end) - (data_ + start));
  return d;
}

}  // namespace farop
