// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "command_line.h"

namespace farop::app {

/// Groups of options in the order of every help page.
std::vector<std::string> option_groups(const CLI::App& command);
/// Options of one group, in the order they were added; hidden ones left out.
std::vector<const CLI::Option*> options_of_group(const CLI::App& command, const std::string& group);
/// "OUT", "auto|always|never": what stands for an option's value.
std::string value_name(const CLI::Option& option);
/// "-o,--output OUT": names and value of an option.
std::string option_signature(const CLI::Option& option);
/// "farop render [options] IN..."
std::string usage_line(const CLI::App& command);

/// The page that `farop COMMAND --help` prints.
std::string command_help(const CLI::App& command, const std::vector<Example>& examples);
/// The page that `farop --help` prints.
std::string program_help(const CLI::App& app);

/// Names and meanings of the exit statuses, one a line.
std::string exit_status_table();

}  // namespace farop::app
