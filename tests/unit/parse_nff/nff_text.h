// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of the NFF parser share: parsing from memory and looking at what was reported.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "parse_nff/parse_nff.h"

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

inline ParsedText parse_text(std::string_view text, const NffOptions& options = {}) {
  WordReader reader(text, "folder/scene.nff");
  DiagnosticList list;
  ParsedText parsed;
  parsed.scene = parse_nff(reader, list, options);
  parsed.reports = std::move(list.items);
  return parsed;
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
