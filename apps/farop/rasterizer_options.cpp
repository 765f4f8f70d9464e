// SPDX-License-Identifier: GPL-3.0-or-later
#include "rasterizer_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string_view>

#include "core/diagnostics.h"
#include "core/error.h"
#include "program_files.h"
#include "suggest.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view k_library_suffix = ".so";

/// "mine" for mine.so and libmine.so; nothing for other files.
std::string name_of_library(const fs::path& file) {
  if (file.extension() != k_library_suffix) return {};
  std::string name = file.stem();
  if (name.starts_with("lib")) name.erase(0, 3);
  return name;
}

bool is_file_name(const std::string& name) {
  return name.find('/') != std::string::npos || name.ends_with(k_library_suffix);
}

ChosenRasterizer look_up(const RasterizerOptions& options) {
  const std::vector<FoundLibrary> libraries = find_libraries(options.folders);
  const auto found = std::ranges::find(libraries, options.name, &FoundLibrary::name);
  if (found != libraries.end()) return {RasterizerKind::library, found->file, {}};
  std::vector<std::string> names = {"internal", "null"};
  for (const FoundLibrary& library : libraries) names.push_back(library.name);
  const std::string near = did_you_mean(options.name, names);
  throw Error(
      ExitStatus::plugin, fmt::format("no rasterizer is called '{}'", printable(options.name)),
      near.empty()
          ? fmt::format("a file needs a slash: --rasterizer ./{}.so; `farop plugins` lists what is found",
                        printable(options.name))
          : fmt::format("did you mean '{}'? `farop plugins` lists what is found", near));
}

}  // namespace

void add_rasterizer_options(CLI::App& command, RasterizerOptions& options) {
  const auto group = [](CLI::Option* option) { return option->group("Rasterizer"); };
  group(
      command.add_option("--rasterizer", options.name, "internal, null (draws nothing), or yours [internal]")
          ->type_name("NAME|FILE.so"));
  group(command.add_option("--cmd", options.command, "a program: reads a flat file, writes a PPM")
            ->type_name("'PROGRAM {flat} {ppm}'"));
  group(command.add_option("--plugin-option", options.key_values, "an option that your rasterizer asks for")
            ->type_name("K=V")
            ->expected(1)
            ->take_all());
  group(command.add_option("-I", options.folders, "folder with rasterizers, before FAROP_PLUGIN_PATH")
            ->type_name("DIR")
            ->expected(1)
            ->take_all());
  group(command.add_flag("--in-process", options.in_process, "call it in this process, for debuggers"));
}

std::map<std::string, std::string> plugin_options(const RasterizerOptions& options) {
  std::map<std::string, std::string> table;
  for (const std::string& pair : options.key_values) {
    const std::size_t equals = pair.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw Error(ExitStatus::usage,
                  fmt::format("--plugin-option: found '{}', expected KEY=VALUE", printable(pair)));
    }
    table[pair.substr(0, equals)] = pair.substr(equals + 1);
  }
  return table;
}

std::vector<fs::path> plugin_folders(const std::vector<std::string>& first) {
  std::vector<fs::path> folders(first.begin(), first.end());
  const char* const variable = std::getenv("FAROP_PLUGIN_PATH");
  for (std::string_view rest = variable == nullptr ? "" : variable; !rest.empty();) {
    const std::size_t colon = rest.find(':');
    if (colon != 0) folders.emplace_back(rest.substr(0, colon));
    rest = colon == std::string_view::npos ? std::string_view() : rest.substr(colon + 1);
  }
  folders.push_back(library_file("plugins"));
  return folders;
}

std::vector<FoundLibrary> find_libraries(const std::vector<std::string>& first_folders) {
  std::vector<FoundLibrary> libraries;
  std::set<std::string> names;
  for (const fs::path& folder : plugin_folders(first_folders)) {
    std::vector<fs::path> files;
    std::error_code ec;
    for (fs::directory_iterator i(folder, ec), end; !ec && i != end; i.increment(ec))
      files.push_back(i->path());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
      const std::string name = name_of_library(file);
      if (!name.empty() && names.insert(name).second) libraries.push_back({name, file});
    }
  }
  return libraries;
}

ChosenRasterizer choose_rasterizer(const RasterizerOptions& options) {
  if (!options.command.empty()) {
    if (options.name != "internal") {
      throw Error(ExitStatus::usage, "--cmd and --rasterizer are both given", "give the one that is to draw");
    }
    return {RasterizerKind::command, {}, options.command};
  }
  if (options.name == "internal") return {};
  if (options.name == "null") return {RasterizerKind::null, {}, {}};
  if (is_file_name(options.name)) return {RasterizerKind::library, options.name, {}};
  return look_up(options);
}

}  // namespace farop::app
