// SPDX-License-Identifier: GPL-3.0-or-later
// The files of one script: which may be read, and under which names messages speak of them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace farop::sipp {

/// A file of a script, cut into lines for messages.
struct ScriptText {
  std::string display_name;
  std::string text;
  std::vector<std::string_view> lines;  ///< into `text`

  /// Line `number` from 1, or nothing.
  std::string_view line(int number) const;
};

class ScriptFiles {
 public:
  /// `folder`: absolute, without symbolic links; the only place that files come from. Empty: nowhere.
  /// `display_folder` is what stands in front of their names in messages.
  ScriptFiles(std::string folder, std::string display_folder)
      : folder_(std::move(folder)), display_folder_(std::move(display_folder)) {}

  /// The file that a script calls `name` (relative to the folder): its real path. Throws ScriptError where it
  /// lies outside the folder after symbolic links are resolved, is no regular file or too large. Nothing but
  /// existence and place of a file is looked at.
  std::string resolve(const std::string& name) const;

  /// Remembers the text of a file for messages.
  void add(const std::string& path, std::string display_name, std::string text);
  /// The same for a file that resolve() found. Throws ScriptError when it cannot be read.
  void load(const std::string& path);
  /// nullptr for an unknown one.
  const ScriptText* find(const std::string& path) const;

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_, display_folder_;
  std::map<std::string, ScriptText> texts_;
};

}  // namespace farop::sipp
