// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <new>

#include "core/error.h"
#include "help.h"
#include "session.h"
#include "suggest.h"
#include "version.h"

namespace farop::app {
namespace {

// Every long option can also come from the environment: --light-intensity from FAROP_LIGHT_INTENSITY. Where
// one word means different things to different commands, one of them names its own variable.
void name_environment(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_lnames().empty() || option->get_lnames().front() == "help" ||
        option->get_lnames().front() == "output" || !option->get_envname().empty())
      continue;
    std::string name = "FAROP_" + option->get_lnames().front();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return c == '-' ? '_' : static_cast<char>(std::toupper(c)); });
    option->envname(name);
  }
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

int status_of(ExitStatus status) {
  return static_cast<int>(status);
}

void print_error(const std::string& message, const std::string& hint) {
  fmt::print(stderr, "farop: error: {}\n", message);
  if (!hint.empty()) fmt::print(stderr, "  hint: {}\n", hint);
}

// A write to a closed pipe or a full disk shows only when the buffer is emptied.
void print_data(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ExitStatus::surroundings, "cannot write to standard output");
  }
}

}  // namespace

CommandLine::CommandLine()
    : app_("A bench for polygon rasterizers", "farop"), session_(std::make_unique<Session>()) {
  app_.set_version_flag("--version", std::string("farop ") + k_version);
  app_.set_config("--config", "", "file with options: [render] samples=4 ...");
  app_.require_subcommand(1);
  add_render(*this);
  add_export(*this);
  add_raster(*this);
  add_check(*this);
  add_convert(*this);
  add_spd(*this);
  add_info(*this);
  add_compare(*this);
  add_plugins(*this);
  add_doctor(*this);
  add_bench(*this);
  add_table(*this);
  add_new(*this);
  add_completion(*this);
  add_man(*this);
}

CLI::App& CommandLine::add_command(const std::string& name, const std::string& description,
                                   const std::vector<Example>& examples, CommandFunction run) {
  CLI::App& command = *app_.add_subcommand(name, description);
  command.fallthrough();
  command.callback([this, name, run = std::move(run)] {
    session_->report.command = name;
    chosen_ = run;
  });
  examples_.emplace_back(&command, examples);
  return command;
}

void CommandLine::add_report_options(CLI::App& command) {
  ReportOptions& options = session_->options;
  command.add_option("--stats", options.stats_file, "write counts, timers and memory as JSON")
      ->type_name("FILE.json")
      ->group("Report");
  command
      .add_option("--trace", options.trace_file,
                  "write when each stage ran, for Perfetto or chrome://tracing")
      ->type_name("FILE.json")
      ->group("Report");
  command.add_flag("-v,--verbose", options.verbose, "tell every step, or only warnings and errors")
      ->group("Report");
  command.add_flag("-q,--quiet", options.quiet, "tell every step, or only warnings and errors")
      ->group("Report");
  command.add_flag("--no-progress", options.no_progress, "no progress bar")->group("Report");
  command.add_option("--color", options.color, "coloured messages [auto]")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->type_name("auto|always|never")
      ->group("Report");
}

const std::vector<Example>& CommandLine::examples(const CLI::App& command) const {
  static const std::vector<Example> none;
  const auto found =
      std::find_if(examples_.begin(), examples_.end(), [&](const auto& e) { return e.first == &command; });
  return found == examples_.end() ? none : found->second;
}

int CommandLine::report_parse_error(const CLI::ParseError& error,
                                    const std::vector<std::string>& arguments) const {
  const auto chosen = app_.get_subcommands();
  const CLI::App& command = chosen.empty() ? app_ : *chosen.front();
  const std::string page =
      chosen.empty() ? "farop --help" : fmt::format("farop {} --help", command.get_name());
  std::string message = error.what();
  std::string hint = fmt::format("see {}", page);
  const std::vector<std::string> unknown =
      app_.remaining(true);  // sub-commands hand up what they do not know
  const bool bad_command = chosen.empty() && !arguments.empty() && !arguments.front().starts_with("-");
  if (bad_command) {
    std::vector<std::string> names;
    for (const CLI::App* c : app_.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(c->get_name());
    message = fmt::format("unknown command '{}'", printable(arguments.front()));
    const std::string best = did_you_mean(arguments.front(), names);
    if (!best.empty()) hint = fmt::format("did you mean '{}'? All commands: {}", best, page);
  } else if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !unknown.empty()) {
    const std::string word = unknown.front().substr(0, unknown.front().find('='));
    message = fmt::format("unknown {} '{}'", word.starts_with("-") ? "option" : "word", printable(word));
    const std::string best = did_you_mean(word, option_names(command));
    if (!best.empty()) hint = fmt::format("did you mean '{}'? All options: {}", best, page);
  }
  while (!message.empty() && (message.back() == '\n' || message.back() == '.')) message.pop_back();
  print_error(message, hint);
  return status_of(ExitStatus::usage);
}

int CommandLine::run(std::vector<std::string> arguments) {
  for (CLI::App* command : app_.get_subcommands([](CLI::App*) { return true; })) name_environment(*command);
  arguments = join_open_lists(std::move(arguments));
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // the order that CLI11 wants
    app_.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app_.get_subcommands();
    print_data(chosen.empty() ? program_help(app_)
                              : command_help(*chosen.front(), examples(*chosen.front())));
    return 0;
  } catch (const CLI::CallForVersion& version) {
    print_data(std::string(version.what()) + "\n");
    return 0;
  } catch (const CLI::ParseError& error) {
    return report_parse_error(error, arguments);
  }

  session_->console.configure(session_->options);
  if (!session_->options.trace_file.empty()) session_->clocks.trace_to(session_->trace);
  ExitStatus status = ExitStatus::ok;
  const auto fail = [&](const Error& error) {
    status = error.status();
    session_->console.report_failure(error);
  };
  const auto guarded = [&](const auto& work) {
    try {
      work();
    } catch (const Error& error) {
      fail(error);
    } catch (const std::bad_alloc&) {
      fail(Error(ExitStatus::surroundings, "out of memory",
                 "use a smaller scene or picture, or a larger machine"));
    } catch (const std::exception& error) {
      fail(Error(ExitStatus::internal, fmt::format("internal error: {}", error.what()),
                 "please report it with this command line and its input"));
    }
  };
  guarded([&] {
    const TimedSlice slice(session_->clocks.total);
    chosen_(*session_);
  });
  guarded([&] { session_->finish(status); });
  return status_of(status);
}

int run_command_line(std::vector<std::string> arguments) {
  try {
    return CommandLine().run(std::move(arguments));
  } catch (const Error& error) {
    print_error(error.what(), error.hint());
    return status_of(error.status());
  } catch (const std::exception& error) {
    print_error(fmt::format("internal error: {}", error.what()), "please report it with this command line");
    return status_of(ExitStatus::internal);
  }
}

}  // namespace farop::app
