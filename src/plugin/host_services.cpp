// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/host_services.h"

#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/diagnostics.h"

namespace farop {
namespace {

/// Longest line that is taken from a rasterizer; a text without an end stops here.
constexpr std::size_t k_max_line = 4096;

}  // namespace

HostServices::HostServices(std::map<std::string, std::string> options, PluginLog log)
    : table_{{sizeof(farop_host), FAROP_ABI_VERSION, "farop", log_line, option_value, extension_named}, this},
      options_(std::move(options)),
      log_(std::move(log)) {}

HostServices& HostServices::for_the_life_of_the_process(std::map<std::string, std::string> options,
                                                        PluginLog log) {
  // Never destroyed itself, so that a library's own destructors may still log.
  static auto* const all = new std::vector<std::unique_ptr<HostServices>>;
  all->push_back(std::make_unique<HostServices>(std::move(options), std::move(log)));
  return *all->back();
}

HostServices& HostServices::of(const farop_host* host) {
  static_assert(std::is_standard_layout_v<Table> && offsetof(Table, host) == 0);
  return *reinterpret_cast<const Table*>(host)->services;
}

void HostServices::log_line(const farop_host* host, farop_log_level level, const char* text) {
  if (host == nullptr || text == nullptr) return;
  HostServices& self = of(host);
  const std::string line = printable({text, ::strnlen(text, k_max_line + 1)}, k_max_line);
  const std::lock_guard lock(self.mutex_);
  self.last_line_ = line;
  if (level >= FAROP_LOG_ERROR) self.last_error_ = line;
  if (self.log_) self.log_(level, line);
}

const char* HostServices::option_value(const farop_host* host, const char* key) {
  if (host == nullptr || key == nullptr) return nullptr;
  const auto& options = of(host).options_;
  const auto found = options.find(key);
  return found == options.end() ? nullptr : found->second.c_str();
}

const void* HostServices::extension_named(const farop_host*, const char*) {
  return nullptr;  // none yet
}

std::string HostServices::last_words() const {
  const std::lock_guard lock(mutex_);
  return last_error_.empty() ? last_line_ : last_error_;
}

std::string HostServices::last_error() const {
  const std::lock_guard lock(mutex_);
  return last_error_;
}

void HostServices::forget_words() {
  const std::lock_guard lock(mutex_);
  last_error_.clear();
  last_line_.clear();
}

}  // namespace farop
