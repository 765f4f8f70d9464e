// SPDX-License-Identifier: GPL-3.0-or-later
// The collection of tests/hostile as its tests see it: the rows, and what must be as before after each.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "unit/isolate/bench.h"

namespace farop::test {

/// A line of a manifest.
struct Row {
  std::string name, expected, path;
  std::vector<std::string> also;  ///< right as well, where walls are missing

  int number() const;
  /// One run cannot judge it: it needs the comparisons of `farop check`.
  bool needs_check() const;
};
std::ostream& operator<<(std::ostream& out, const Row& row);

std::vector<Row> rows_of(const std::string& manifest);
/// The rows that are built from sources.
std::vector<Row> built_rows();
/// "01_null_dereference", for names of tests.
std::string test_name(const Row& row);

/// Part of the names of what the plug-ins make (plug-in option `suite`): two runs of the tests at the same
/// time do not take each other's for their own.
const std::string& suite();

/// Stands around a run: afterwards nothing has changed that should not have. Files of others in the folders
/// where plug-ins would find them, processes and threads by the plug-ins' name, whatever runs the runner of
/// this program, and this process's descriptors, children (orphans come back to it) and shared memory.
class Surroundings {
 public:
  Surroundings();
  ~Surroundings();
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  /// Test failures that name `what`.
  void expect_unchanged(const std::string& what) const;

 private:
  std::vector<std::filesystem::path> folders_;
  Belongings before_;
};

}  // namespace farop::test
