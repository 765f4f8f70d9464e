// SPDX-License-Identifier: GPL-3.0-or-later
#include "help.h"

#include <fmt/format.h>

#include <algorithm>

namespace farop::app {
namespace {

constexpr std::size_t k_signature_width = 39;
constexpr std::size_t k_line_width = 105;

bool hidden(const CLI::App& command) {
  return command.get_group().empty();
}

std::string examples_text(const std::vector<Example>& examples) {
  std::string out = "\nExamples\n";
  for (const Example& e : examples) {
    const bool fits = e.line.size() + e.meaning.size() + 7 <= k_line_width;  // as a comment of the shell
    out += fits ? fmt::format("  {}   # {}\n", e.line, e.meaning)
                : fmt::format("  {}\n      {}\n", e.line, e.meaning);
  }
  return out;
}

std::string row(const std::string& signature, const std::string& text) {
  if (signature.size() < k_signature_width)
    return fmt::format("  {:<{}}{}\n", signature, k_signature_width, text);
  return fmt::format("  {}\n  {:<{}}{}\n", signature, "", k_signature_width, text);
}

}  // namespace

std::vector<const CLI::Option*> options_of_group(const CLI::App& command, const std::string& group) {
  std::vector<const CLI::Option*> out;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group() == group) out.push_back(option);
  }
  return out;
}

std::vector<std::string> option_groups(const CLI::App& command) {
  static const std::vector<std::string> order = {"Input",      "Output",     "Scene", "View",
                                                 "Geometry",   "Drawing",    "Cases", "Judging",
                                                 "Rasterizer", "Comparison", "Report"};
  std::vector<std::string> out;
  for (const std::string& group : order) {
    if (!options_of_group(command, group).empty()) out.push_back(group);
  }
  return out;
}

std::string value_name(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));  // CLI11 appends what its validators say
}

std::string option_signature(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ",-") + name;
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "--" : ",--") + name;
  const bool positional = names.empty();
  if (option.get_items_expected_max() == 0) return names;
  return positional ? value_name(option) : names + " " + value_name(option);
}

std::string usage_line(const CLI::App& command) {
  std::string line = fmt::format("farop {} [options]", command.get_name());
  for (const CLI::Option* option : command.get_options()) {
    if (!option->nonpositional()) {
      const bool many = option->get_items_expected_max() > 1;
      const std::string name =
          value_name(*option) + (many && value_name(*option).find(' ') == std::string::npos ? "..." : "");
      line += option->get_required() ? " " + name : " [" + name + "]";
    }
  }
  return line;
}

std::string command_help(const CLI::App& command, const std::vector<Example>& examples) {
  std::string out = fmt::format("{}\nUsage: {}\n", command.get_description(), usage_line(command));
  for (const std::string& group : option_groups(command)) {
    out += fmt::format("\n{}\n", group);
    const std::vector<const CLI::Option*> options = options_of_group(command, group);
    for (std::size_t i = 0; i < options.size(); ++i) {
      // Neighbours that one text describes share a row.
      std::string signature = option_signature(*options[i]);
      while (i + 1 < options.size() && options[i + 1]->get_description() == options[i]->get_description()) {
        signature += ", " + option_signature(*options[++i]);
      }
      out += row(signature, options[i]->get_description());
    }
  }
  return out + examples_text(examples);
}

std::string exit_status_table() {
  return "  0  done; every check passed\n"
         "  1  the input is at fault, or a check found something\n"
         "  2  the command line is at fault\n"
         "  3  the plug-in failed or was stopped\n"
         "  4  the surroundings: an output cannot be written, memory or time limit of the machine\n"
         "  5  our own fault: please report it\n";
}

std::string program_help(const CLI::App& app) {
  std::string out =
      "farop - a bench for polygon rasterizers\n\n"
      "Reads scenes, runs the geometry stage (culling, clipping, perspective, lighting, triangulation)\n"
      "and hands on polygons in screen coordinates: to a file, to a picture, back to NFF.\n\n"
      "Usage: farop COMMAND [options]\n\nCommands\n";
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* c) { return !hidden(*c); })) {
    out += fmt::format("  {:<12}{}\n", command->get_name(), command->get_description());
  }
  out +=
      "\nOptions\n"
      "  --help, --version, --config FILE   (every option is also a key of FILE, or a variable FAROP_NAME)\n"
      "\nFirst steps\n"
      "  farop spd gears -o gears.nff                        a scene of the Standard Procedural Databases\n"
      "  farop export gears.nff -o gears.scr                 polygons in screen coordinates for your "
      "rasterizer\n"
      "  farop render gears.nff -o gears.png                 what the picture should look like\n"
      "  farop render --help                                 all options of a command, with examples\n"
      "\nExit status\n";
  return out + exit_status_table();
}

}  // namespace farop::app
