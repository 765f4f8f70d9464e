// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolate/layers.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include "isolate/control_group.h"
#include "isolate/runner_process.h"

namespace farop {

using namespace isolate;

namespace isolate {
namespace {

constexpr std::array<const char*, k_layer_count> k_names = {"A limits", "B namespaces", "C landlock",
                                                            "D seccomp"};

std::string remedy(int index, int error) {
  switch (index) {
    case 1:
      return error == ENOSPC
                 ? "raise /proc/sys/user/max_user_namespaces"
                 : "user namespaces are forbidden: in a container by its profile, on Ubuntu by AppArmor "
                   "(kernel.apparmor_restrict_unprivileged_userns), elsewhere by "
                   "kernel.unprivileged_userns_clone or user.max_user_namespaces";
    case 2:
      return "needs Linux 5.13 or later with landlock in its list of security modules (lsm=landlock,... at "
             "boot), and "
             "a container profile that lets its three system calls through";
    case 3:
      return "needs a kernel with CONFIG_SECCOMP_FILTER, and a container profile that allows seccomp()";
    default:
      return {};
  }
}

}  // namespace

std::uint32_t wanted_layers(const IsolationOptions& options) {
  if (options.isolation == Isolation::off) return 0;
  std::uint32_t layers = k_all_layers;
  for (const char letter : options.without) {
    if (letter >= 'A' && letter < 'A' + k_layer_count) layers &= ~(1u << (letter - 'A'));
  }
  return layers;
}

bool wants_group(const IsolationOptions& options) {
  return options.isolation != Isolation::off && options.without.find('E') == std::string::npos;
}

std::vector<IsolationLayer> layers_of(const Hello& hello, std::uint32_t asked) {
  std::vector<IsolationLayer> layers;
  layers.push_back({"0 process", true, "", ""});
  for (int i = 0; i < k_layer_count; ++i) {
    IsolationLayer layer;
    layer.id = k_names[static_cast<std::size_t>(i)];
    const std::uint32_t bit = 1u << i;
    layer.holds = (hello.layers & asked & bit) != 0;
    if ((asked & bit) == 0) {
      layer.why = "not asked for";
    } else if (!layer.holds) {
      layer.why = std::strerror(hello.error[i]);
      layer.how_to_enable = remedy(i, hello.error[i]);
    } else if (i == 2) {
      layer.why = fmt::format("version {}", hello.landlock_abi);
    } else if (i == 3 && hello.watched == 0) {
      layer.why = "refused calls fail, but cannot be reported";
    } else if (i == 0 && hello.unchanged_root != 0) {
      layer.holds = false;
      layer.why = "the runner could not give up being root";
    }
    layers.push_back(std::move(layer));
  }
  return layers;
}

}  // namespace isolate

std::string find_runner() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path folder = program.parent_path();
  for (const char* place : {"../libexec/farop/farop-runner", "libexec/farop/farop-runner",
                            "../lib/farop/farop-runner", "farop-runner"}) {
    const std::filesystem::path candidate = folder / place;
    if (std::filesystem::is_regular_file(candidate, error)) return candidate.lexically_normal().string();
  }
  throw Error(
      ExitStatus::surroundings, "farop-runner, which rasterizers run in, is not where it should be",
      fmt::format("expected ../libexec/farop/farop-runner beside {}; reinstall farop", folder.string()));
}

std::string missing_walls(const std::vector<IsolationLayer>& layers) {
  std::string text;
  for (const IsolationLayer& layer : layers) {
    const char letter = layer.id.front();
    if (layer.holds || letter < 'A' || letter > 'D') continue;
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", layer.id, layer.why);
  }
  if (text.empty()) return text;
  return fmt::format("walls around rasterizers that are missing here: {}; `farop doctor` says more", text);
}

std::vector<IsolationLayer> probe_isolation(const std::string& runner) {
  const SharedMemory nothing("farop-probe", 4096);
  const SharedMemory box("farop-black-box", k_black_box_bytes);
  const SharedMemory ring("farop-polygons", k_slot_bytes * k_ring_slots);
  std::vector<IsolationLayer> layers;
  layers.push_back({"0 process", true, "", ""});
  for (int i = 0; i < k_layer_count; ++i) {
    const std::uint32_t bit = 1u << i;
    RunnerProcess::Start start;
    start.runner = runner.empty() ? find_runner() : runner;
    start.library = &nothing;
    start.black_box = &box;
    start.ring = &ring;
    start.settings.mode = Mode::probe;
    start.settings.layers = bit;
    start.settings.memory_bytes = std::uint64_t{256} << 20;
    start.settings.cookie = 1;
    RunnerProcess process(start);
    RunnerLimits limits;
    limits.cpu_seconds = 5, limits.wall_seconds = 5;
    process.start_clocks(limits);
    IsolationLayer layer{k_names[static_cast<std::size_t>(i)], false, "the probe gave no answer", ""};
    while (const std::optional<RunnerEvent> event = process.next(true)) {
      if (const Hello* hello = std::get_if<Hello>(&*event)) {
        layer = layers_of(*hello, bit)[static_cast<std::size_t>(i) + 1];
      } else if (const Reply* reply = std::get_if<Reply>(&*event)) {
        if (layer.holds && (reply->warnings & bit) != 0) {
          layer.holds = false;
          layer.why = "it is there, but what it should stop went through";
        }
        break;
      }
    }
    layers.push_back(std::move(layer));
  }
  layers.push_back(probe_control_group());
  return layers;
}

}  // namespace farop
