// SPDX-License-Identifier: GPL-3.0-or-later
// Messages about an input text: who, where, what, what now.
//
// Parsers never print and never throw past their door: they report here. The application prints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace farop {

/// A word of an input text. Lines and columns count from 1; columns count bytes.
/// line 0 = the file as a whole (cannot be opened, say); column 0 = the line as a whole.
struct SourceLocation {
  std::string file;
  std::uint64_t line = 0;
  std::uint64_t column = 0;
};

enum class Severity { note, warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  SourceLocation where;
  std::string message;             ///< what was found and what was expected, one line, no final stop
  std::string hint;                ///< the remedy, or empty
  std::string excerpt;             ///< the source line for the caret picture, or empty when it is not at hand
  std::size_t excerpt_column = 0;  ///< caret position within `excerpt`, from 1; 0 = no caret
  std::size_t length = 1;          ///< length of the word under the caret, bytes
};

/// Receives diagnostics in the order they are found.
class DiagnosticSink {
 public:
  virtual ~DiagnosticSink() = default;
  virtual void report(Diagnostic diagnostic) = 0;
};

/// Keeps everything: for tests, and for callers that print later.
class DiagnosticList : public DiagnosticSink {
 public:
  void report(Diagnostic diagnostic) override { items.push_back(std::move(diagnostic)); }
  std::size_t count(Severity severity) const;

  std::vector<Diagnostic> items;
};

/// Text of one diagnostic, lines separated and ended by LF:
///
///     gears.nff:9:1: error: 'pp' announces 3 vertices, the file ends after 2
///         9 | pp 3
///           | ^~
///       hint: each vertex needs six numbers: x y z nx ny nz
///
/// Control characters of the excerpt are shown as '.', long excerpts are cut around the caret.
std::string to_text(const Diagnostic& diagnostic);

/// `text` with every control character and invalid UTF-8 byte replaced by '?', cut to `limit` bytes ("..."
/// appended): for words of an input that are quoted in a message.
std::string printable(std::string_view text, std::size_t limit = 60);

}  // namespace farop
