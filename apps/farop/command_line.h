// SPDX-License-Identifier: GPL-3.0-or-later
// The program as a function: arguments in, exit status out.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace farop::app {

class Session;

/// A sub-command that was chosen: set by its callback, run after the whole line has been parsed.
using CommandFunction = std::function<void(Session&)>;

/// Two command lines that the help shows and the tests run.
struct Example {
  std::string line, meaning;
};

/// The whole command line: the one source of the parser, the help, the man page and the shell completions.
class CommandLine {
 public:
  CommandLine();

  /// Adds a sub-command; `run` is what it does.
  CLI::App& add_command(const std::string& name, const std::string& description,
                        const std::vector<Example>& examples, CommandFunction run);

  /// Adds the shared report options; last, so that their group ends the help.
  void add_report_options(CLI::App& command);

  CLI::App& app() { return app_; }
  const CLI::App& app() const { return app_; }
  const std::vector<Example>& examples(const CLI::App& command) const;
  /// Parses and runs; prints help, messages and errors.
  int run(std::vector<std::string> arguments);

 private:
  int report_parse_error(const CLI::ParseError& error, const std::vector<std::string>& arguments) const;

  CLI::App app_;
  std::unique_ptr<Session> session_;
  std::vector<std::pair<const CLI::App*, std::vector<Example>>> examples_;
  CommandFunction chosen_;
};

int run_command_line(std::vector<std::string> arguments);

// One function per command of the design; each lives in commands/.
void add_render(CommandLine& line);
void add_export(CommandLine& line);
void add_raster(CommandLine& line);
void add_convert(CommandLine& line);
void add_spd(CommandLine& line);
void add_info(CommandLine& line);
void add_compare(CommandLine& line);
void add_plugins(CommandLine& line);
void add_check(CommandLine& line);
void add_doctor(CommandLine& line);
void add_table(CommandLine& line);
void add_bench(CommandLine& line);
void add_new(CommandLine& line);
void add_completion(CommandLine& line);
void add_man(CommandLine& line);

}  // namespace farop::app
