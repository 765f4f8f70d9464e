// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "parse_sipp/parse_sipp.h"

namespace farop::test {

/// What came of a script that was given as text.
struct ScriptRun {
  std::optional<Scene> scene;
  DiagnosticList messages;
  std::vector<std::string> printed;

  /// The error's message and hint; empty without one.
  std::string error() const {
    for (const Diagnostic& d : messages.items) {
      if (d.severity == Severity::error) return d.message + " | " + d.hint;
    }
    return {};
  }
  const Object& world() const { return *scene->root.children.at(0); }
};

inline ScriptRun run_script(const std::string& text, SippOptions options = {}) {
  ScriptRun run;
  options.log = [&run](const std::string& line) { run.printed.push_back(line); };
  run.scene = parse_sipp_text(text, "test.sipp", "", run.messages, options);
  return run;
}

/// What the script prints; fails the test on an error.
inline std::vector<std::string> prints(const std::string& text) {
  const ScriptRun run = run_script(text);
  EXPECT_EQ(run.error(), "") << text;
  return run.printed;
}

}  // namespace farop::test
