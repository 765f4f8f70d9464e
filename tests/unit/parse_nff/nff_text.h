// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of the NFF parser share: parsing from memory and looking at what was reported.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "parse_nff/parse_nff.h"
#include "scene/merge.h"

namespace farop {

struct ParsedText {
  std::optional<Scene> scene;
  std::vector<Diagnostic> reports;

  std::size_t count(Severity severity) const {
    std::size_t n = 0;
    for (const Diagnostic& d : reports) n += d.severity == severity ? 1 : 0;
    return n;
  }
  /// "LINE:COLUMN: message" of report i.
  std::string report(std::size_t i) const {
    const Diagnostic& d = reports.at(i);
    return fmt::format("{}:{}: {}", d.where.line, d.where.column, d.message);
  }
  /// The surface i of the one object.
  const Surface& surface(std::size_t i = 0) const { return *scene->root.children.at(0)->surfaces.at(i); }
  std::size_t surfaces() const { return scene->root.children.at(0)->surfaces.size(); }
  const InputSummary& summary() const { return scene->inputs.at(0); }
};

inline ParsedText parse_only(std::string_view text, const NffOptions& options) {
  WordReader reader(text, "folder/scene.nff");
  DiagnosticList list;
  ParsedText parsed;
  parsed.scene = parse_nff(reader, list, options);
  parsed.reports = std::move(list.items);
  return parsed;
}

/// The fast way through numbers must not show: same scene, same messages at the same places as the plain way.
/// Blanks behind the text let it be taken to the end.
inline void expect_same_as_plain(std::string_view text, const NffOptions& options) {
  const std::string padded = std::string(text) + std::string(80, ' ');
  NffOptions plain_options = options;
  plain_options.plain = true;
  const ParsedText fast = parse_only(padded, options), plain = parse_only(padded, plain_options);
  ASSERT_EQ(fast.scene.has_value(), plain.scene.has_value()) << text;
  if (fast.scene) {
    ASSERT_TRUE(same_content(*fast.scene, *plain.scene)) << text;
  }
  ASSERT_EQ(fast.reports.size(), plain.reports.size()) << text;
  for (std::size_t i = 0; i < fast.reports.size(); ++i) {
    ASSERT_EQ(fast.report(i), plain.report(i)) << text;
    ASSERT_EQ(fast.reports[i].hint, plain.reports[i].hint) << text;
    ASSERT_EQ(fast.reports[i].excerpt, plain.reports[i].excerpt) << text;
  }
}

inline ParsedText parse_text(std::string_view text, const NffOptions& options = {}) {
  if (text.size() < 100'000) expect_same_as_plain(text, options);
  return parse_only(text, options);
}

/// What must hold for every text whatever: a scene without an error, or no scene and exactly one error as the
/// last report.
inline bool ends_in_scene_or_one_error(const ParsedText& parsed) {
  const std::size_t errors = parsed.count(Severity::error);
  if (parsed.scene) return errors == 0;
  return errors == 1 && parsed.reports.back().severity == Severity::error &&
         !parsed.reports.back().message.empty();
}

}  // namespace farop
