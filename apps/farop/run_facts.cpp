// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_facts.h"

#include <fmt/format.h>
#include <nettle/sha2.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

#include "core/diagnostics.h"

namespace farop::app {
namespace {

constexpr std::size_t k_most_lines = 200;  // different ones: more tell nothing new

}  // namespace

std::string sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return "";
  sha256_ctx context;
  sha256_init(&context);
  std::array<char, 65536> buffer{};
  while (file.read(buffer.data(), buffer.size()) || file.gcount() > 0) {
    sha256_update(&context, static_cast<std::size_t>(file.gcount()),
                  reinterpret_cast<const std::uint8_t*>(buffer.data()));
  }
  if (!file.eof()) return "";
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  std::string text;
  for (const std::uint8_t byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::string compiler_name() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return "";
#endif
}

std::string system_name() {
  utsname system{};
  if (::uname(&system) != 0) return "";
  return fmt::format("{} {} {}", system.sysname, system.release, system.machine);
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string name;
  for (std::string line; name.empty() && std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) name = line.substr(colon + 2) + ", ";
  }
  return printable(name, 200) + fmt::format("{} processors", std::thread::hardware_concurrency());
}

std::string time_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  std::array<char, 32> text{};
  const std::size_t size = ::gmtime_r(&now, &utc) == nullptr
                               ? 0
                               : std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {text.data(), size};
}

void PrintedLines::add(const std::string& line) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find(lines_, line, &std::pair<std::string, std::uint64_t>::first);
  if (known != lines_.end())
    ++known->second;
  else if (lines_.size() < k_most_lines)
    lines_.emplace_back(line, 1);
  else
    ++left_out_;
}

std::string PrintedLines::text() const {
  const std::lock_guard lock(mutex_);
  std::string text;
  for (const auto& [line, count] : lines_)
    text += line + (count > 1 ? fmt::format("  ({} x)", count) : "") + "\n";
  if (left_out_ > 0) text += fmt::format("... {} x\n", left_out_);
  return text;
}

}  // namespace farop::app
