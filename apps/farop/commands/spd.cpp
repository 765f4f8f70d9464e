// SPDX-License-Identifier: GPL-3.0-or-later
#include "spd/spd.h"

#include <memory>

#include "command_line.h"
#include "core/output_file.h"
#include "session.h"
#include "suggest.h"

namespace farop::app {
namespace {

struct SpdOptions {
  std::string name;
  std::optional<int> size;
  std::optional<int> resolution;
  bool tessellate = false;
  bool list = false;
  std::string output = "-";
};

std::string count_text(std::uint64_t n, const char* noun) {
  return n == 0 ? "" : fmt::format(", {} {}", n, noun);
}

void print_list() {
  OutputFile out("-");
  for (const SpdSceneInfo& scene : spd_scenes()) {
    SpdRequest request;
    request.name = scene.name;
    const SpdCounts c = spd_counts(request);
    const std::string counts = count_text(c.polygons + c.patches, "polygons") +
                               count_text(c.spheres, "spheres") + count_text(c.cones, "cones");
    const std::string size = scene.size_ignored ? "-" : fmt::format("{}", scene.default_size);
    out.write(fmt::format("{:<15} {:>4}  {} ({})\n", scene.name, size, scene.description, counts.substr(2)));
  }
  out.commit();
}

void check_name(const std::string& name) {
  std::vector<std::string> names;
  for (const SpdSceneInfo& scene : spd_scenes()) names.emplace_back(scene.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string best = did_you_mean(name, names);
  throw Error(
      ExitStatus::usage, fmt::format("unknown scene '{}'", printable(name)),
      (best.empty() ? "" : fmt::format("did you mean '{}'? ", best)) + "All scenes: farop spd --list");
}

void run(Session& session, const SpdOptions& options) {
  if (options.list) return print_list();
  if (options.name.empty())
    throw Error(ExitStatus::usage, "no scene named", "farop spd --list shows them all");
  check_name(options.name);
  SpdRequest request{options.name, options.size, options.tessellate, options.resolution};
  const SpdCounts counts = spd_counts(request);
  OutputFile file(options.output);
  {
    const TimedSlice slice(session.clocks.write);
    write_spd(
        request, [&](std::string_view text) { file.write(text); }, session.console.progress("generating"));
    file.commit();
  }
  session.console.end_progress();
  session.report.polygons_loaded = counts.polygons + counts.patches;
  session.report.outputs.push_back(options.output);
  if (options.output == "-") return;  // a pipe's other end does the talking
  session.console.summary("{}: {} polygons, {} spheres, {} cones, {} lights", options.output,
                          counts.polygons + counts.patches, counts.spheres, counts.cones, counts.lights);
}

}  // namespace

void add_spd(CommandLine& line) {
  const auto options = std::make_shared<SpdOptions>();
  CLI::App& command =
      line.add_command("spd", "Standard Procedural Databases and three solids, as NFF",
                       {{"farop spd gears --size 2 -o gears2.nff", "8 meshed gears"},
                        {"farop spd balls --tessellate 2 -o balls.nff", "spheres as triangles, 48 each"}},
                       [options](Session& session) { run(session, *options); });
  command.add_option("name", options->name, "scene; --list shows them all")
      ->type_name("NAME")
      ->group("Scene");
  command.add_flag("--list", options->list, "list the scenes with their default sizes and counts")
      ->group("Scene");
  command.add_option("--size", options->size, "size, from 1 [the scene's default]")
      ->type_name("N")
      ->group("Scene");
  command
      .add_option_function<std::string>(
          "--tessellate",
          [options](const std::string& text) {
            options->tessellate = true;
            if (text.empty()) return;
            int r = 0;
            if (!CLI::detail::lexical_cast(text, r))
              throw CLI::ValidationError("--tessellate", fmt::format("'{}' is not a whole number", text));
            options->resolution = r;
          },
          "spheres and cones as triangles, R facets a quarter [3]")
      ->expected(0, 1)
      ->default_str("")
      ->type_name("[R]")
      ->group("Scene");
  add_output_option(command, options->output, "NFF file [standard output]");
  line.add_report_options(command);
}

}  // namespace farop::app
