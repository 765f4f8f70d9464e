// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace farop {

/// What a scene has that NFF cannot say: phrases in order of first mention, each once.
class NffLosses {
 public:
  void add(const std::string& phrase);
  void add(const std::vector<std::string>& phrases);
  bool empty() const { return phrases_.empty(); }
  /// "a; b; c"
  std::string text() const;

 private:
  std::vector<std::string> phrases_;
};

}  // namespace farop
