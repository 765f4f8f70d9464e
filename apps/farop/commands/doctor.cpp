// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <sys/utsname.h>

#include <cstring>
#include <filesystem>
#include <string_view>
#include <thread>

#include "command_line.h"
#include "core/hardware_counters.h"
#include "core/output_file.h"
#include "isolate/isolation.h"
#include "program_files.h"
#include "session.h"
#include "version.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;

/// One line: yes or no, what, why, and how to get it.
std::string row(bool there, std::string_view what, std::string_view why, std::string_view remedy) {
  std::string line = fmt::format("  {:<4}{:<18}{}", there ? "yes" : "no", what, why);
  if (!there && !remedy.empty()) line += fmt::format("{}{}", why.empty() ? "" : "; ", remedy);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string isolation_section() {
  std::string text =
      "Isolation of users' rasterizers (farop render --rasterizer; --isolation strict needs A to D)\n";
  try {
    for (const IsolationLayer& layer : probe_isolation()) {
      text += row(layer.holds, layer.id, layer.why, layer.how_to_enable);
    }
  } catch (const Error& error) {
    text += row(false, "runner", error.what(), error.hint());
  }
  return text;
}

std::string counters_section() {
  const std::string remedy =
      "sysctl kernel.perf_event_paranoid=2 on the machine itself; virtual machines often have none";
  const HardwareCounters& counters = HardwareCounters::of_process();
  const auto counter = [&](const char* name, const PerfCounter& c) {
    return row(c.error() == 0, name, c.error() == 0 ? "" : std::strerror(c.error()), remedy);
  };
  return "Counters (timers of --stats)\n" + counter("cycles", counters.cycles) +
         counter("instructions", counters.instructions);
}

std::string machine_section() {
  utsname system{};
  ::uname(&system);
  std::string text = fmt::format("Machine\n  {} {} {}, {} processors\n", system.sysname, system.release,
                                 system.machine, std::thread::hardware_concurrency());
#if defined(__x86_64__)
  text += row(__builtin_cpu_supports("sse4.2") != 0, "SSE4.2", "", "");
  text += row(__builtin_cpu_supports("avx2") != 0, "AVX2", "", "");
  text += row(__builtin_cpu_supports("avx512f") != 0, "AVX-512", "", "");
#endif
  return text;
}

std::string toolchains_section() {
  struct Tool {
    const char *program, *what, *package;
  };
  const Tool tools[] = {{"cc", "C", "gcc"},
                        {"c++", "C++", "g++"},
                        {"rustc", "Rust", "rustc"},
                        {"zig", "Zig", ""},
                        {"gfortran", "Fortran", "gfortran"},
                        {"make", "make", "make"}};
  std::string text = "Languages for rasterizers\n";
  for (const Tool& tool : tools) {
    const std::string path = program_in_path(tool.program);
    const std::string remedy = *tool.package == 0
                                   ? "Debian has no package of it: https://ziglang.org/download"
                                   : fmt::format("apt-get install {}", tool.package);
    text += row(!path.empty(), tool.what, path, remedy);
  }
  const fs::path adapter = library_file("farop-python.so");
  text += row(fs::exists(adapter), "Python", fs::exists(adapter) ? adapter.string() : "",
              "this farop was built where libpython3-dev was missing");
  return text;
}

void run() {
  std::string text = fmt::format("farop {}\n\n", k_version);
  text += isolation_section() + "\n" + counters_section() + "\n" + machine_section() + "\n" +
          toolchains_section();
  OutputFile file("-");
  file.write(text);
  file.commit();
}

}  // namespace

void add_doctor(CommandLine& line) {
  CLI::App& command =
      line.add_command("doctor", "what this machine offers: isolation, counters, SIMD, languages",
                       {{"farop doctor", "yes or no, why, and how to get what is missing"},
                        {"farop doctor | grep -w no", "what is missing"}},
                       [](Session&) { run(); });
  line.add_report_options(command);
}

}  // namespace farop::app
