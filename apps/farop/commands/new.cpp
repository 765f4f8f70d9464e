// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string_view>
#include <system_error>

#include "command_line.h"
#include "core/output_file.h"
#include "program_files.h"
#include "session.h"
#include "suggest.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  std::string path, language;
  std::string algorithm = "blank";
};

struct Language {
  const char* name;   ///< as --lang takes it; its rules for make are templates/NAME.mk
  const char* title;  ///< as people write it
  const char* suffix;
  const char* compiler;  ///< none for Python
};

constexpr Language k_languages[] = {
    {"c", "C", "c", "cc"},        {"c++", "C++", "cpp", "c++"},   {"rust", "Rust", "rs", "rustc"},
    {"zig", "Zig", "zig", "zig"}, {"python", "Python", "py", ""}, {"fortran", "Fortran", "f90", "gfortran"}};

struct Algorithm {
  const char* name;   ///< as --algorithm takes it; its words in the README are templates/NAME.md
  const char* start;  ///< the file to start from, without suffix
  const char* title;
  bool triangles;
};

constexpr Algorithm k_algorithms[] = {{"blank", "dots", "dots, and parts to fill in", false},
                                      {"zbuffer", "zbuffer", "a z-buffer for triangles", true}};

constexpr std::size_t k_max_name = 40;  // the Fortran files keep 64 characters

/// The row of `table` called `word`. Throws Error(usage) with the names there are.
template <class Row, std::size_t N>
const Row& chosen(const Row (&table)[N], const std::string& word, const char* option) {
  const auto found = std::ranges::find_if(table, [&](const Row& row) { return row.name == word; });
  if (found != std::end(table)) return *found;
  std::vector<std::string> names;
  for (const Row& row : table) names.emplace_back(row.name);
  const std::string near = did_you_mean(word, names);
  throw Error(ExitStatus::usage,
              fmt::format("{}: found '{}', expected {}", option, printable(word), fmt::join(names, ", ")),
              near.empty() ? "" : fmt::format("did you mean '{}'?", near));
}

// ---- name --------------------------------------------------------------------------------------------

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

// A leading hyphen would read as an option of the compilers.
bool is_name(std::string_view name) {
  return !name.empty() && name.size() <= k_max_name && name.front() != '-' &&
         std::ranges::all_of(name, is_name_character);
}

/// A name like `text` that will do: "My Raster.c" -> "my_raster_c".
std::string nearest_name(const std::string& text) {
  std::string name;
  for (char c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (!is_name_character(c)) c = '_';
    const bool separator = c == '_' || c == '-';
    if (separator && (name.empty() || name.back() == c)) continue;
    name += c;
  }
  name.resize(std::min(name.size(), k_max_name));
  while (!name.empty() && (name.back() == '_' || name.back() == '-')) name.pop_back();
  return name.empty() ? "mine" : name;
}

/// The folder to make, without a slash behind it. Throws Error(usage) when its last part is no name.
fs::path checked_path(const std::string& text) {
  fs::path path = text;
  while (!path.empty() && !path.has_filename() && path.has_relative_path()) path = path.parent_path();
  const std::string name = path.filename();
  if (!is_name(name)) {
    throw Error(ExitStatus::usage, fmt::format("'{}' cannot be a rasterizer's name", printable(name)),
                fmt::format("up to {} of a-z, 0-9, _ and -, for instance {}", k_max_name,
                            printable((path.parent_path() / nearest_name(name)).string(), 4096)));
  }
  return path;
}

void refuse_existing(const fs::path& path) {
  std::error_code ec;
  const fs::file_status status = fs::symlink_status(path, ec);
  if (!fs::exists(status)) return;
  if (fs::is_directory(status) && fs::is_empty(path, ec) && !ec) return;
  throw Error(ExitStatus::usage,
              fmt::format("{}: {}", printable(path.string(), 4096),
                          fs::is_directory(status) ? "exists and is not empty" : "exists and is no folder"),
              "choose another name; nothing was touched");
}

// ---- files -------------------------------------------------------------------------------------------

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) {
    throw Error(ExitStatus::surroundings, fmt::format("{}: cannot be read", path.string()),
                "a part of this installation is missing: install farop anew");
  }
  return text;
}

std::string template_text(const std::string& name) {
  return file_text(data_file("templates") / name);
}

/// Words and what stands for them, in the order in which they are replaced.
using Words = std::vector<std::pair<std::string, std::string>>;

std::string replaced(std::string text, const Words& words) {
  for (const auto& [word, by] : words) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size())) {
      text.replace(at, word.size(), by);
    }
  }
  return text;
}

struct ProjectFile {
  std::string name, text;
};

std::vector<ProjectFile> project_files(const std::string& name, const Language& language,
                                       const Algorithm& algorithm) {
  const bool compiled = std::string_view(language.name) != "python";
  const std::string source = fmt::format("{}.{}", name, language.suffix);
  const std::string library = compiled ? name + ".so" : source;
  const Words words = {{"@RULE@", template_text(fmt::format("{}.mk", language.name))},
                       {"@TASK@\n", template_text(fmt::format("{}.md", algorithm.name))},
                       {"@INTERFACE@\n", compiled ? "\n" : template_text("python-interface.md")},
                       {"@NAME@", name},
                       {"@FILE@", source},
                       {"@LIBRARY@", library},
                       {"@LANGUAGE@", language.title},
                       {"@EXPORT@", algorithm.triangles ? " --triangles" : ""}};
  // The start is a file that compiles where it is: its own name and its build line are what to replace.
  const std::string start = algorithm.start;
  const Words start_words = {{fmt::format("{}_{}", start, language.suffix), name},
                             {fmt::format("{}.{}", start, language.suffix), source},
                             {start + ".so", library},
                             {"-I plugins/include", "-I $(farop plugins --abi | tail -1)"},
                             {"plugins/exports.map", "exports.map"}};
  const fs::path start_file = data_file("rasterizers") / fmt::format("{}.{}", start, language.suffix);
  return {{source, replaced(file_text(start_file), start_words)},
          {"Makefile", replaced(template_text("Makefile"), words)},
          {"check.sh", template_text("check.sh")},
          {"README.md", replaced(template_text("README.md"), words)}};
}

/// A folder beside the one to make, which takes its name in commit(); without that nothing is left of it.
class StagingFolder {
 public:
  explicit StagingFolder(const fs::path& target) : target_(target) {
    std::string name =
        (target.parent_path() / fmt::format(".{}.XXXXXX", target.filename().string())).string();
    if (::mkdtemp(name.data()) == nullptr) fail("cannot be made", errno);
    path_ = name;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::chmod(path_.c_str(), 0777 & ~mask);  // mkdtemp() makes it private
  }
  ~StagingFolder() {
    std::error_code ec;
    if (!path_.empty()) fs::remove_all(path_, ec);
  }
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  void write(const ProjectFile& file) const {
    OutputFile out((path_ / file.name).string());
    out.write(file.text);
    out.commit();
  }
  void commit() {
    // Takes the place of an empty folder; of anything that came into being since we looked, it does not.
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail("cannot be put in place", errno);
    path_.clear();
  }

 private:
  [[noreturn]] void fail(const char* what, int error_number) const {
    const char* hint = error_number == ENOENT   ? "make the folder it is to be in first"
                       : error_number == EACCES ? "go to a folder of your own"
                                                : "";
    throw Error(
        ExitStatus::surroundings,
        fmt::format("{}: {}: {}", printable(target_.string(), 4096), what, std::strerror(error_number)),
        hint);
  }

  fs::path target_, path_;
};

/// As a shell takes it for one word.
std::string shell_word(const std::string& text) {
  const bool plain = std::ranges::all_of(
      text, [](char c) { return is_name_character(c) || (c >= 'A' && c <= 'Z') || c == '.' || c == '/'; });
  return plain ? text : "'" + replaced(text, {{"'", "'\\''"}}) + "'";
}

void run(Session& session, const NewOptions& options) {
  const Language& language = chosen(k_languages, options.language, "--lang");
  const Algorithm& algorithm = chosen(k_algorithms, options.algorithm, "--algorithm");
  const fs::path target = checked_path(options.path);
  refuse_existing(target);

  const std::vector<ProjectFile> files = project_files(target.filename(), language, algorithm);
  StagingFolder staging(target);
  std::string list;
  for (const ProjectFile& file : files) {
    staging.write(file);
    list += list.empty() ? fmt::format("{} ({})", file.name, algorithm.title) : ", " + file.name;
  }
  staging.commit();
  const std::string folder = target.string();
  session.report.outputs.push_back(folder);
  session.console.summary("{}: {}\nnext:\n  cd {}", printable(folder, 4096), list, shell_word(folder));
  session.console.summary("  make picture    builds it and draws gears into picture.png");
  session.console.summary("  make check      compares three scenes with what they should look like");
  for (const std::string_view needed : {std::string_view(language.compiler), std::string_view("make")}) {
    if (needed.empty() || !program_in_path(needed).empty()) continue;
    session.console.summary("first: there is no {} here; `farop doctor` says how to get it", needed);
  }
}

}  // namespace

void add_new(CommandLine& line) {
  const auto options = std::make_shared<NewOptions>();
  CLI::App& command =
      line.add_command("new", "a rasterizer of your own: a project that builds and draws at once",
                       {{"farop new mine --lang c",
                         "dots, with the parts to fill in marked; cd mine; make picture; make check"},
                        {"farop new fast --lang rust --algorithm zbuffer", "a complete z-buffer to change"}},
                       [options](Session& session) { run(session, *options); });
  command
      .add_option("name", options->path, "folder to make; its last part names the rasterizer: a-z 0-9 _ -")
      ->required()
      ->type_name("NAME")
      ->group("Output");
  // FAROP_LANG is the language that is spoken to the user, as of farop check.
  command.add_option("--lang", options->language, "language it is written in")
      ->envname("FAROP_NEW_LANG")
      ->required()
      ->type_name("c|c++|rust|zig|python|fortran")
      ->group("Rasterizer");
  command.add_option("--algorithm", options->algorithm, "what to start from [blank]")
      ->type_name("blank|zbuffer")
      ->group("Rasterizer");
  line.add_report_options(command);
}

}  // namespace farop::app
