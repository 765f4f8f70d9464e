// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace farop::sipp {

/// Something wrong with a command of a script. Thrown by the commands, turned into an error of Tcl at their
/// door; never leaves this folder.
class ScriptError : public std::runtime_error {
 public:
  /// `word`: the argument that is wrong, as it stands in the script, or empty.
  explicit ScriptError(const std::string& message, std::string word = {}, std::string hint = {})
      : std::runtime_error(message), word_(std::move(word)), hint_(std::move(hint)) {}

  const std::string& word() const { return word_; }
  /// The remedy; empty: the usage of the command serves.
  const std::string& hint() const { return hint_; }

 private:
  std::string word_, hint_;
};

/// A limit that ends the script, whatever it catches.
class ScriptLimitError : public ScriptError {
 public:
  using ScriptError::ScriptError;
};

}  // namespace farop::sipp
