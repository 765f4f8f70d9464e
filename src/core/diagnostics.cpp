// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>

namespace farop {
namespace {

constexpr std::size_t k_excerpt_width = 100;

const char* word_for(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

// Length of the well-formed UTF-8 sequence of printable characters at the start of `s`, 0 if there is none.
std::size_t utf8_length(std::string_view s) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
  const unsigned char first = byte(0);
  if (first < 0x20 || first == 0x7F) return 0;
  if (first < 0x80) return 1;
  const std::size_t n = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || s.size() < n) return 0;
  for (std::size_t i = 1; i < n; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  if (first == 0xC2 && byte(1) < 0xA0) return 0;  // C1 control characters
  if (first == 0xE0 && byte(1) < 0xA0) return 0;  // overlong
  if (first == 0xED && byte(1) > 0x9F) return 0;  // surrogates
  if (first == 0xE2 && byte(1) == 0x80 && (byte(2) >= 0xAA && byte(2) <= 0xAE))
    return 0;  // text direction overrides
  if (first == 0xF0 && byte(1) < 0x90) return 0;
  if (first == 0xF4 && byte(1) > 0x8F) return 0;
  return n;
}

}  // namespace

std::size_t DiagnosticList::count(Severity severity) const {
  return static_cast<std::size_t>(
      std::count_if(items.begin(), items.end(), [&](const Diagnostic& d) { return d.severity == severity; }));
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  while (!text.empty()) {
    const std::size_t n = utf8_length(text);
    if (out.size() + std::max<std::size_t>(n, 1) > limit) return out + "...";
    if (n == 0) {
      out += '?';
      text.remove_prefix(1);
    } else {
      out += text.substr(0, n);
      text.remove_prefix(n);
    }
  }
  return out;
}

std::string to_text(const Diagnostic& d) {
  std::string place = printable(d.where.file, 4096);
  if (d.where.line > 0) place += fmt::format(":{}", d.where.line);
  if (d.where.line > 0 && d.where.column > 0) place += fmt::format(":{}", d.where.column);
  std::string out = fmt::format("{}: {}: {}\n", place, word_for(d.severity), d.message);
  if (d.excerpt_column > 0 && d.excerpt_column <= d.excerpt.size()) {
    // A window of the line around the caret; one byte is one column, so non-ASCII text is shown as '.'.
    const std::size_t caret = d.excerpt_column - 1;
    const std::size_t from = caret > k_excerpt_width / 2 ? caret - k_excerpt_width / 2 : 0;
    std::string line = d.excerpt.substr(from, k_excerpt_width);
    for (char& c : line) {
      if (c == '\t') c = ' ';
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = '.';
    }
    const std::size_t width = std::clamp<std::size_t>(d.length, 1, line.size() - (caret - from));
    out += fmt::format("{:>6} | {}\n       | {:>{}}{}\n", d.where.line, line, '^', caret - from + 1,
                       std::string(width - 1, '~'));
  }
  if (!d.hint.empty()) out += fmt::format("  hint: {}\n", d.hint);
  return out;
}

}  // namespace farop
