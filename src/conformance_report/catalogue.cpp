// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/catalogue.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "conformance_report/web_files_internal.h"

namespace farop::conformance_report {
namespace {

/// A key with gaps: its fixed parts, and what it is in the other language.
struct Pattern {
  std::vector<std::string> parts;
  std::string translation;
  std::size_t fixed = 0;  ///< letters that are not gaps
};

struct Table {
  std::map<std::string, std::string, std::less<>> sentences;
  std::vector<Pattern> patterns;  ///< most specific first
};

Table read_table(const char* text) {
  Table table;
  const nlohmann::json json = nlohmann::json::parse(text);
  for (const auto& [key, value] : json.items()) {
    table.sentences[key] = value.get<std::string>();
    if (key.find("{}") == std::string::npos) continue;
    Pattern p;
    std::size_t at = 0;
    for (std::size_t gap = 0; (gap = key.find("{}", at)) != std::string::npos; at = gap + 2)
      p.parts.push_back(key.substr(at, gap - at));
    p.parts.push_back(key.substr(at));
    p.translation = value.get<std::string>();
    for (const std::string& part : p.parts) p.fixed += part.size();
    table.patterns.push_back(std::move(p));
  }
  std::ranges::stable_sort(table.patterns, std::greater{}, &Pattern::fixed);
  return table;
}

const Table& portuguese() {
  static const Table table = read_table(k_web_portuguese);
  return table;
}

/// What stands in the gaps of a pattern; nothing where it does not fit. Gaps are never empty.
std::optional<std::vector<std::string>> gaps(const Pattern& p, std::string_view text) {
  if (!text.starts_with(p.parts.front())) return std::nullopt;
  std::vector<std::string> found;
  std::size_t at = p.parts.front().size();
  for (std::size_t i = 1; i < p.parts.size(); ++i) {
    const std::string& part = p.parts[i];
    const bool last = i + 1 == p.parts.size();
    const std::size_t next = last ? (text.ends_with(part) ? text.size() - part.size() : std::string::npos)
                                  : text.find(part, at + 1);
    if (next == std::string::npos || next <= at) return std::nullopt;
    found.emplace_back(text.substr(at, next - at));
    at = next + part.size();
  }
  return found;
}

std::string translate(const Table& table, std::string_view text, int depth) {
  if (const auto exact = table.sentences.find(text); exact != table.sentences.end()) return exact->second;
  if (depth == 0) return std::string(text);
  for (const Pattern& p : table.patterns) {
    const auto found = gaps(p, text);
    if (!found) continue;
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    // Gaps hold sentences and words, too.
    for (const std::string& gap : *found) store.push_back(translate(table, gap, depth - 1));
    return fmt::vformat(p.translation, store);
  }
  return std::string(text);
}

constexpr int k_nesting = 3;
constexpr std::size_t k_longest = 2000;  // a sentence of ours is shorter

}  // namespace

std::string Catalogue::operator()(std::string_view english) const {
  if (language_ == Language::english || english.size() > k_longest) return std::string(english);
  return translate(portuguese(), english, k_nesting);
}

bool Catalogue::has(std::string_view english) const {
  if (language_ == Language::english) return true;
  const Table& table = portuguese();
  return table.sentences.contains(english) ||
         std::ranges::any_of(table.patterns, [&](const Pattern& p) { return gaps(p, english).has_value(); });
}

std::string Catalogue::pattern(std::string_view key) const {
  if (language_ == Language::english) return std::string(key);
  const auto found = portuguese().sentences.find(key);
  return found == portuguese().sentences.end() ? std::string(key) : found->second;
}

conformance::CheckResult translated(conformance::CheckResult r, const Catalogue& words) {
  if (words.language() == Language::english) return r;
  const auto in_place = [&](std::string& text) { text = words(text); };
  for (conformance::Finding& f : r.findings) in_place(f.message), in_place(f.hint);
  for (conformance::FamilyResult& f : r.families) in_place(f.skip_reason);
  for (conformance::CaseResult& c : r.cases) in_place(c.purpose), in_place(c.reason);
  for (std::string& note : r.notes) in_place(note);
  return r;
}

}  // namespace farop::conformance_report
