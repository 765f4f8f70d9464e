// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_nff/nff_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "parse_nff/nff_numbers.h"

namespace farop::nff {
namespace {

// No keyword and no name below is longer; longer words are never compared.
constexpr std::size_t k_longest_name = 24;

constexpr std::pair<std::string_view, std::string_view> k_names[] = {
    {"background", "b"}, {"bg", "b"},       {"camera", "v"},  {"color", "f"},        {"colour", "f"},
    {"cone", "c"},       {"cylinder", "c"}, {"face", "p"},    {"fill", "f"},         {"fov", "angle"},
    {"light", "l"},      {"lookat", "at"},  {"eye", "from"},  {"material", "f"},     {"near", "hither"},
    {"patch", "pp"},     {"poly", "p"},     {"polygon", "p"}, {"res", "resolution"}, {"size", "resolution"},
    {"sphere", "s"},     {"triangle", "p"}, {"view", "v"},    {"viewpoint", "v"}};

constexpr std::string_view k_spelled_out[] = {"pp", "at", "up", "from", "angle", "hither", "resolution"};

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

// Whether the words differ by one slip: a letter left out, added, replaced, or two neighbours swapped.
bool one_slip_apart(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty() && a.front() == b.front()) a.remove_prefix(1), b.remove_prefix(1);
  while (!a.empty() && !b.empty() && a.back() == b.back()) a.remove_suffix(1), b.remove_suffix(1);
  const bool swapped = a.size() == 2 && b.size() == 2 && a[0] == b[1] && a[1] == b[0];
  return swapped || (a.size() <= 1 && b.size() <= 1);
}

// The misspelt keyword, or nothing. Words of one or two letters are too close to everything.
std::string_view misspelt_keyword(std::string_view word) {
  const auto* const found = std::find_if(
      std::begin(k_spelled_out), std::end(k_spelled_out),
      [&](std::string_view keyword) { return word.size() > 2 && one_slip_apart(word, keyword); });
  return found == std::end(k_spelled_out) ? std::string_view() : *found;
}

std::string did_you_mean(std::string_view keyword) {
  return fmt::format("did you mean '{}'?", keyword);
}

}  // namespace

std::string hint_for_unknown_keyword(std::string_view word, const KeywordTest& is_keyword) {
  if (word.substr(0, 2) == "\x1F\x8B") return "the file is compressed with gzip: unpack it first";
  if (!word.empty() && word.size() <= k_longest_name) {
    const std::size_t number_start = word.find_first_of("0123456789+-.");
    double value = 0;
    if (number_start != std::string_view::npos && is_keyword(word.substr(0, number_start)) &&
        parse_number(word.substr(number_start), value) == NumberSyntax::number) {
      return fmt::format("put a blank between keyword and number: '{} {}'", word.substr(0, number_start),
                         word.substr(number_start));
    }
    const std::string lower = lower_case(word);
    const std::string_view bare = std::string_view(lower).substr(0, lower.find_last_not_of(":;,=(){}") + 1);
    if (is_keyword(bare)) return did_you_mean(bare);
    const auto* const named = std::find_if(std::begin(k_names), std::end(k_names),
                                           [&](const auto& name) { return name.first == bare; });
    if (named != std::end(k_names)) return did_you_mean(named->second);
    if (const std::string_view meant = misspelt_keyword(bare); !meant.empty()) return did_you_mean(meant);
  }
  return "keywords are v, b, l, f, c, s, p and pp, in lower case; '#' starts a comment";
}

}  // namespace farop::nff
