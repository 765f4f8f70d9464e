// SPDX-License-Identifier: GPL-3.0-or-later
#include "rasterizer_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
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
constexpr std::string_view k_python_suffix = ".py";

/// "mine" for mine.so, libmine.so and mine.py; nothing for other files.
std::string name_of_library(const fs::path& file) {
  if (file.extension() == k_python_suffix) return file.stem();
  if (file.extension() != k_library_suffix) return {};
  std::string name = file.stem();
  if (name.starts_with("lib")) name.erase(0, 3);
  return name;
}

bool is_file_name(const std::string& name) {
  return name.find('/') != std::string::npos || name.ends_with(k_library_suffix) ||
         name.ends_with(k_python_suffix);
}

/// Longest script that is read; a million lines.
constexpr std::uintmax_t k_max_script_bytes = 64u << 20;

std::string text_file(const std::string& path) {
  const auto fail = [&](const std::string& reason) {
    throw Error(ExitStatus::plugin, fmt::format("{}: {}", printable(path, 4096), reason));
  };
  std::error_code ec;
  const fs::file_status status = fs::status(path, ec);
  if (!fs::exists(status)) fail("cannot be opened: No such file or directory");
  if (!fs::is_regular_file(status)) fail("is no regular file, expected a Python script");
  if (fs::file_size(path, ec) > k_max_script_bytes) fail("is too large for a script");
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file || text.find('\0') != std::string::npos) fail("is no text, expected a Python script");
  return text;
}

/// What `scanline` means: the one that ships with the explanations, called as a user's is.
std::string readable_reference() {
  const fs::path file = library_file("plugins") / "scanline_fill.so";
  if (!fs::exists(file)) {
    throw Error(ExitStatus::plugin, fmt::format("{}, which 'scanline' stands for, is missing", file.string()),
                "reinstall farop");
  }
  return file;
}

ChosenRasterizer look_up(const RasterizerOptions& options) {
  const std::vector<FoundLibrary> libraries = find_libraries(options.folders);
  const auto found = std::ranges::find(libraries, options.name, &FoundLibrary::name);
  if (found != libraries.end()) return {RasterizerKind::library, found->file, {}};
  std::vector<std::string> names = {"internal", "null", "scanline"};
  for (const FoundLibrary& library : libraries) names.push_back(library.name);
  const std::string near = did_you_mean(options.name, names);
  const std::string name = printable(options.name);
  const std::string hint = near.empty()
                               ? fmt::format("a file is named with its suffix: {}.so or {}.py", name, name)
                               : fmt::format("did you mean '{}'?", near);
  throw Error(ExitStatus::plugin, fmt::format("no rasterizer is called '{}'", name),
              hint + (near.empty() ? ";" : "") + " `farop plugins` lists what is found");
}

}  // namespace

void add_rasterizer_options(CLI::App& command, RasterizerOptions& options) {
  const auto group = [](CLI::Option* option) { return option->group("Rasterizer"); };
  group(
      command
          .add_option("--rasterizer", options.name, "internal, scanline, null (draws none), yours [internal]")
          ->type_name("NAME|FILE.so|FILE.py"));
  group(command
            .add_option("--threads", options.threads, "of the internal rasterizer [all]; of your library [1]")
            ->check(CLI::Range(1, 1024))
            ->type_name("N"));
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
  group(command.add_option("--isolation", options.isolation, "walls around it; strict: or not at all [auto]")
            ->check(CLI::IsMember({"auto", "strict", "off"}))
            ->type_name("auto|strict|off"));
  group(command.add_option("--cpu", options.cpu_seconds, "processor seconds it may take for a frame [60]")
            ->check(CLI::PositiveNumber)
            ->type_name("S"));
  group(command.add_option("--wall", options.wall_seconds, "seconds by the clock that it may take [305]")
            ->check(CLI::PositiveNumber)
            ->type_name("S"));
  group(command.add_option("--memory", options.memory_megabytes, "memory that it may take, megabytes [2048]")
            ->check(CLI::PositiveNumber)
            ->type_name("MB"));
  group(command.add_flag("--in-process", options.in_process, "call it in this process, for debuggers"));
  group(
      command.add_flag("--check", options.check, "look at both sides of every call; status 1 for findings"));
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

IsolationOptions isolation_options(const RasterizerOptions& options, PluginLog log) {
  IsolationOptions isolation;
  isolation.isolation = options.isolation == "strict" ? Isolation::strict
                        : options.isolation == "off"  ? Isolation::off
                                                      : Isolation::automatic;
  RunnerLimits& limits = isolation.limits;
  if (options.cpu_seconds) {
    limits.cpu_seconds = *options.cpu_seconds;
    limits.wall_seconds = 5 * *options.cpu_seconds + 5;  // what sleeps is caught too, but later
  }
  limits.wall_seconds = options.wall_seconds.value_or(limits.wall_seconds);
  if (options.memory_megabytes)
    limits.memory_bytes = static_cast<std::uint64_t>(*options.memory_megabytes * 1e6);
  limits.threads = std::max(options.threads, 1);
  isolation.log = std::move(log);
  isolation.check = options.check;
  return isolation;
}

LoadableRasterizer loadable(const std::string& file, std::map<std::string, std::string> options) {
  // dlopen searches for a name without a slash; a file of the current folder was meant.
  if (!file.ends_with(k_python_suffix)) {
    return {file.find('/') == std::string::npos ? "./" + file : file, std::move(options)};
  }
  const fs::path adapter = library_file("farop-python.so");
  if (!fs::exists(adapter)) {
    throw Error(ExitStatus::plugin,
                fmt::format("{}: this farop was built without Python", printable(file, 4096)),
                "build it where libpython3-dev is installed");
  }
  options["script"] = file;
  options["source"] = text_file(file);
  return {adapter, std::move(options)};
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
  if (options.name == "scanline") return {RasterizerKind::library, readable_reference(), {}};
  if (is_file_name(options.name)) return {RasterizerKind::library, options.name, {}};
  return look_up(options);
}

}  // namespace farop::app
