// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <memory>

#include "command_line.h"
#include "core/output_file.h"
#include "isolate/isolated_rasterizer.h"
#include "program_files.h"
#include "rasterizer_options.h"
#include "session.h"

namespace farop::app {
namespace {

struct PluginsOptions {
  std::vector<std::string> folders;
  bool abi = false;
};

std::string wishes(std::uint32_t wants) {
  const std::pair<std::uint32_t, const char*> words[] = {
      {FAROP_WANT_TRIANGLES, "triangles"},         {FAROP_WANT_NORMALS, "normals"},
      {FAROP_WANT_EYE_POSITIONS, "eye positions"}, {FAROP_WANT_VERTEX_IDS, "vertex ids"},
      {FAROP_WANT_MATERIAL, "material"},           {FAROP_DRAWS_ELSEWHERE, "draws elsewhere"}};
  std::string text;
  for (const auto& [bit, word] : words) {
    if ((wants & bit) != 0) text += (text.empty() ? "" : ", ") + std::string(word);
  }
  return text.empty() ? "polygons as the flat file has them" : text;
}

/// Loads it where it can do no harm: its own words about itself come from its own code.
std::string describe(const FoundLibrary& found) {
  std::string text;
  try {
    const LoadableRasterizer what = loadable(found.file, {});
    IsolationOptions isolation;
    isolation.plugin_options = what.options;
    const PluginDescription described = IsolatedRasterizer(what.library, isolation, {}).description();
    text = fmt::format("{:<16}{}\n{:16}wants {}; interface {}.{}\n", found.name, described.summary, "",
                       wishes(described.wants), described.abi_version >> 16, described.abi_version & 0xFFFFu);
  } catch (const PluginFailure& failure) {
    text = fmt::format("{:<16}cannot be used: {}\n", found.name, failure.finding().message);
  } catch (const Error& error) {
    text = fmt::format("{:<16}cannot be used: {}\n", found.name, error.what());
  }
  return text + fmt::format("{:16}{}\n", "", found.file.string());
}

std::string listing(const PluginsOptions& options) {
  if (options.abi) {
    return fmt::format("rasterizer interface {}.{}\n{}\n", FAROP_ABI_MAJOR, FAROP_ABI_MINOR,
                       include_folder().string());
  }
  std::string text;
  for (const FoundLibrary& found : find_libraries(options.folders)) text += describe(found);
  if (!text.empty()) return text;
  text = "no rasterizers are found in\n";
  for (const auto& folder : plugin_folders(options.folders)) text += fmt::format("  {}\n", folder.string());
  return text;
}

void run(const PluginsOptions& options) {
  OutputFile file("-");
  file.write(listing(options));
  file.commit();
}

}  // namespace

void add_plugins(CommandLine& line) {
  const auto options = std::make_shared<PluginsOptions>();
  CLI::App& command = line.add_command(
      "plugins", "rasterizers that are found, what each wants and says of itself",
      {{"farop plugins -I .", "those of this folder too"},
       {"farop plugins --abi", "version of the interface, and the folder of farop/rasterizer.h"}},
      [options](Session&) { run(*options); });
  command.add_option("-I", options->folders, "folder with rasterizers, before FAROP_PLUGIN_PATH")
      ->type_name("DIR")
      ->expected(1)
      ->take_all()
      ->group("Rasterizer");
  command.add_flag("--abi", options->abi, "version and header folder of the interface")->group("Rasterizer");
  line.add_report_options(command);
}

}  // namespace farop::app
