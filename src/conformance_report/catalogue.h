// SPDX-License-Identifier: GPL-3.0-or-later
// What is said to people, in the language they asked for. English is the key: pt.json has what each sentence
// is in Portuguese. `{}` in a key stands for any text; `{0}`, `{1}` ... in its translation for what stood
// there.
#pragma once

#include <fmt/args.h>
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "conformance/result.h"

namespace farop::conformance_report {

enum class Language : std::uint8_t { english, portuguese };

class Catalogue {
 public:
  explicit Catalogue(Language language) : language_(language) {}

  Language language() const { return language_; }
  /// "en", "pt"
  std::string_view code() const { return language_ == Language::english ? "en" : "pt"; }
  /// A sentence or word, whole. Unknown ones, and names such as verdicts, come back as they are.
  std::string operator()(std::string_view english) const;
  /// Whether the language has this sentence.
  bool has(std::string_view english) const;
  /// A sentence of this program's with values in it: the key has `{}` for each.
  template <class... Values>
  std::string format(std::string_view key, const Values&... values) const {
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    (store.push_back(values), ...);
    return fmt::vformat(pattern(key), store);
  }

 private:
  std::string pattern(std::string_view key) const;

  Language language_;
};

/// All sentences of a result in that language: messages, hints, purposes, reasons, notes. Names stay.
conformance::CheckResult translated(conformance::CheckResult result, const Catalogue& words);

}  // namespace farop::conformance_report
