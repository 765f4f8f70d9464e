// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/script_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/diagnostics.h"
#include "parse_sipp/parse_sipp.h"
#include "parse_sipp/script_error_internal.h"

namespace farop::sipp {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_folder_hint = "a script reads only files below its own folder";

bool is_below(const fs::path& folder, const fs::path& file) {
  auto f = file.begin();
  for (const fs::path& part : folder) {
    if (part.empty()) continue;  // behind a trailing slash
    if (f == file.end() || *f != part) return false;
    ++f;
  }
  return f != file.end();
}

}  // namespace

std::string_view ScriptText::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > lines.size()) return {};
  return lines[static_cast<std::size_t>(number) - 1];
}

std::string ScriptFiles::resolve(const std::string& name) const {
  const std::string shown = printable(name, 200);
  if (name.empty() || name.find('\0') != std::string::npos) {
    throw ScriptError("an empty or impossible file name found", name, k_folder_hint);
  }
  if (folder_.empty()) {
    throw ScriptError(fmt::format("'{}': this script has no folder to read files from", shown), name,
                      k_folder_hint);
  }
  std::error_code ec;
  const fs::path wanted = fs::path(folder_) / name;  // an absolute name replaces the folder
  // What is not even written as a file below the folder is refused before the disk is asked about it.
  if (!is_below(folder_, wanted.lexically_normal())) {
    throw ScriptError(fmt::format("'{}' lies outside the folder of the scene", shown), name, k_folder_hint);
  }
  const fs::path real = fs::canonical(wanted, ec);
  if (ec) {
    const std::string folder = display_folder_.empty() ? "." : printable(display_folder_, 300);
    throw ScriptError(fmt::format("'{}': cannot open: {}", shown, ec.message()), name,
                      fmt::format("names are relative to the folder of the scene, '{}'", folder));
  }
  if (!is_below(folder_, real)) {
    throw ScriptError(fmt::format("'{}' leads outside the folder of the scene", shown), name, k_folder_hint);
  }
  if (!fs::is_regular_file(real, ec)) {
    throw ScriptError(fmt::format("'{}' is no regular file", shown), name, k_folder_hint);
  }
  if (fs::file_size(real, ec) > k_max_script_bytes || ec) {
    throw ScriptError(fmt::format("'{}' is larger than {} MB", shown, k_max_script_bytes >> 20), name,
                      "split it");
  }
  return real.string();
}

void ScriptFiles::add(const std::string& path, std::string display_name, std::string text) {
  ScriptText& entry = texts_[path];
  entry.display_name = std::move(display_name);
  entry.text = std::move(text);
  entry.lines.clear();
  const std::string_view all = entry.text;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find('\n', at), all.size());
    entry.lines.push_back(all.substr(at, end - at));
    at = end + 1;
  }
}

void ScriptFiles::load(const std::string& path) {
  if (texts_.contains(path)) return;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file && text.str().empty() && fs::file_size(path) > 0) {
    throw ScriptError(fmt::format("'{}': cannot be read", printable(path, 200)));
  }
  add(path, (fs::path(display_folder_) / fs::path(path).lexically_relative(folder_)).string(), text.str());
}

const ScriptText* ScriptFiles::find(const std::string& path) const {
  const auto found = texts_.find(path);
  return found == texts_.end() ? nullptr : &found->second;
}

}  // namespace farop::sipp
