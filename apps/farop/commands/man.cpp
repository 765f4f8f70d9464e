// SPDX-License-Identifier: GPL-3.0-or-later
// The man page, made from the same option tree as the parser and the help.
#include <fmt/format.h>

#include "command_line.h"
#include "core/output_file.h"
#include "help.h"
#include "version.h"

namespace farop::app {
namespace {

std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  // A line that begins with a control character would be taken for a request.
  return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

std::string options_section(const CLI::App& command) {
  std::string out;
  for (const std::string& group : option_groups(command)) {
    for (const CLI::Option* option : options_of_group(command, group)) {
      out += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(option_signature(*option)),
                         roff(option->get_description()));
    }
  }
  return out;
}

std::string page(const CommandLine& line) {
  std::string out = fmt::format(
      ".TH FAROP 1 \"\" \"farop {}\" \"User Commands\"\n.SH NAME\nfarop \\- a bench for polygon "
      "rasterizers\n",
      k_version);
  out +=
      ".SH SYNOPSIS\n.B farop\n.I COMMAND\n[options]\n.SH DESCRIPTION\n"
      "Reads scenes, runs the geometry stage (culling, clipping, perspective, lighting, triangulation) and "
      "hands on polygons\n"
      "in screen coordinates: to a file, to a picture, back to NFF.\n.SH COMMANDS\n";
  for (const CLI::App* command :
       line.app().get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); })) {
    out += fmt::format(".SS {}\n{}.\n.PP\n.B {}\n", roff(command->get_name()),
                       roff(command->get_description()), roff(usage_line(*command)));
    out += options_section(*command);
    for (const Example& e : line.examples(*command)) {
      out += fmt::format(".TP\n.RB \"Example: \" \"{}\"\n{}\n", roff(e.line), roff(e.meaning));
    }
  }
  out += ".SH EXIT STATUS\n.nf\n" + roff(exit_status_table()) + ".fi\n";
  out +=
      ".SH ENVIRONMENT\nEvery long option can be set as a variable: \\-\\-light\\-intensity as "
      "FAROP_LIGHT_INTENSITY.\n"
      "NO_COLOR switches coloured messages off.\n";
  return out;
}

}  // namespace

void add_man(CommandLine& line) {
  CLI::App& command = line.add_command("man", "the manual page in roff", {}, [&line](Session&) {
    OutputFile out("-");
    out.write(page(line));
    out.commit();
  });
  command.group("");  // for the build, which installs the page
}

}  // namespace farop::app
