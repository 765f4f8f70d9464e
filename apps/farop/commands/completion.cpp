// SPDX-License-Identifier: GPL-3.0-or-later
// Shell completion, made from the same option tree as the parser and the help.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "command_line.h"
#include "core/output_file.h"
#include "help.h"
#include "session.h"
#include "spd/spd.h"

namespace farop::app {
namespace {

std::vector<const CLI::App*> shown_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); });
}

std::string joined_names(const CLI::App& app) {
  std::string names;
  for (const CLI::App* c : shown_commands(app)) names += (names.empty() ? "" : " ") + c->get_name();
  return names;
}

/// "--long", or "-s" where there is no long name.
std::string word_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? "-" + option.get_snames().front() : "--" + option.get_lnames().front();
}

std::vector<const CLI::Option*> shown_options(const CLI::App& command) {
  std::vector<const CLI::Option*> out;
  for (const std::string& group : option_groups(command)) {
    for (const CLI::Option* option : options_of_group(command, group)) {
      if (option->nonpositional()) out.push_back(option);
    }
  }
  return out;
}

// The words an option takes when its value is one of a few, "" for numbers and files.
std::string choices(const CLI::Option& option) {
  std::string words = value_name(option);
  const bool list =
      words.find('|') != std::string::npos &&
      std::all_of(words.begin(), words.end(), [](char c) { return c == '|' || (c >= 'a' && c <= 'z'); });
  if (!list) return "";
  std::replace(words.begin(), words.end(), '|', ' ');
  return words;
}

std::string scene_names() {
  std::string names;
  for (const SpdSceneInfo& scene : spd_scenes())
    names += fmt::format("{}{}", names.empty() ? "" : " ", scene.name);
  return names;
}

std::string bash_script(const CLI::App& app) {
  std::string options, values;
  for (const CLI::App* command : shown_commands(app)) {
    std::string names = "--help";
    for (const CLI::Option* option : shown_options(*command)) {
      names += " " + word_of(*option);
      const std::string words = choices(*option);
      if (!words.empty()) {
        values += fmt::format("    {}:{}) words='{}' ;;\n", command->get_name(), word_of(*option), words);
      }
    }
    options += fmt::format("    {}) options='{}' ;;\n", command->get_name(), names);
  }
  return fmt::format(
      R"(# bash completion for farop: source it, or put it into a bash-completion folder as "farop"
_farop() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD-1]}}" command="${{COMP_WORDS[1]}}"
  local options='' words=''
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$current"))
    return
  fi
  case "$command" in
{}  esac
  case "$command:$previous" in
{}  esac
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  elif [[ "$current" == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [ "$command" = spd ] && [ "$COMP_CWORD" -eq 2 ]; then
    COMPREPLY=($(compgen -W '{}' -- "$current"))
  else
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -F _farop farop
)",
      joined_names(app), options, values, scene_names());
}

std::string quoted(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

// Inside single quotes a quote ends the string, is added escaped, and starts it again.
std::string in_single_quotes(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out;
}

std::string zsh_script(const CLI::App& app) {
  std::string descriptions, cases;
  for (const CLI::App* command : shown_commands(app)) {
    descriptions += fmt::format("    '{}:{}'\n", command->get_name(),
                                in_single_quotes(quoted(command->get_description(), ":")));
    cases += fmt::format("    {}) _arguments '--help[help]'", command->get_name());
    for (const CLI::Option* option : shown_options(*command)) {
      const std::string words = choices(*option);
      const std::string value = option->get_items_expected_max() == 0 ? ""
                                : words.empty()                       ? ":value:_files"
                                                                      : fmt::format(":value:({})", words);
      cases += fmt::format(" \\\n        '{}[{}]{}'", word_of(*option),
                           in_single_quotes(quoted(option->get_description(), "[]:")), value);
    }
    cases += command->get_name() == "spd" ? fmt::format(" \\\n        ':scene:({})' ;;\n", scene_names())
                                          : " \\\n        '*:file:_files' ;;\n";
  }
  return fmt::format(R"(#compdef farop
# zsh completion for farop: put it into a folder of $fpath as "_farop"
_farop() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe 'command' commands
    return
  fi
  local command="${{words[2]}}"
  shift words
  (( CURRENT-- ))
  case "$command" in
{}  esac
}}
compdef _farop farop
)",
                     descriptions, cases);
}

std::string fish_script(const CLI::App& app) {
  std::string out = "# fish completion for farop: put it into ~/.config/fish/completions as farop.fish\n";
  for (const CLI::App* command : shown_commands(app)) {
    const std::string& name = command->get_name();
    out += fmt::format("complete -c farop -n __fish_use_subcommand -f -a {} -d '{}'\n", name,
                       quoted(command->get_description(), "'\\"));
    for (const CLI::Option* option : shown_options(*command)) {
      const std::string words = choices(*option);
      const std::string value = option->get_items_expected_max() == 0 ? ""
                                : words.empty()                       ? " -r"
                                                                      : fmt::format(" -x -a '{}'", words);
      const std::string fish_name = option->get_lnames().empty() ? "-s " + option->get_snames().front()
                                                                 : "-l " + option->get_lnames().front();
      out += fmt::format("complete -c farop -n '__fish_seen_subcommand_from {}' {}{} -d '{}'\n", name,
                         fish_name, value, quoted(option->get_description(), "'\\"));
    }
  }
  return out +
         fmt::format("complete -c farop -n '__fish_seen_subcommand_from spd' -f -a '{}'\n", scene_names());
}

}  // namespace

void add_completion(CommandLine& line) {
  const auto shell = std::make_shared<std::string>();
  CLI::App& command =
      line.add_command("completion", "completion script for bash, zsh or fish",
                       {{"source <(farop completion bash)", "completes commands and options in this shell"},
                        {"farop completion fish", "the script for fish, to standard output"}},
                       [&line, shell](Session&) {
                         OutputFile out("-");
                         out.write(*shell == "bash"  ? bash_script(line.app())
                                   : *shell == "zsh" ? zsh_script(line.app())
                                                     : fish_script(line.app()));
                         out.commit();
                       });
  command.add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->type_name("SHELL")
      ->group("Input");
}

}  // namespace farop::app
