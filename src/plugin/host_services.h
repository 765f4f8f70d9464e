// SPDX-License-Identifier: GPL-3.0-or-later
// What the host offers to a rasterizer: log, options, extensions.
#pragma once

#include <farop/rasterizer.h>

#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace farop {

/// Receives the lines that a rasterizer logs, one at a time, from whichever thread it logs them.
using PluginLog = std::function<void(farop_log_level level, const std::string& line)>;

/// A farop_host and what stands behind it. Lives as long as the process, as the interface promises:
/// rasterizers keep pointers to it, so it is never moved and its options never change.
class HostServices {
 public:
  /// `options`: --plugin-option key=value.
  explicit HostServices(std::map<std::string, std::string> options, PluginLog log);
  HostServices(const HostServices&) = delete;
  HostServices& operator=(const HostServices&) = delete;

  /// One that is never destroyed, for libraries that are loaded into this process.
  static HostServices& for_the_life_of_the_process(std::map<std::string, std::string> options, PluginLog log);

  const farop_host* host() const { return &table_.host; }
  /// The last line that was logged as an error, or else the last line; empty when there was none.
  std::string last_words() const;
  /// The last line that was logged as an error; empty when there was none.
  std::string last_error() const;
  /// Forgets last_words().
  void forget_words();

 private:
  /// The host comes first, so that a pointer to it is a pointer to its table.
  struct Table {
    farop_host host;
    HostServices* services;
  };
  static HostServices& of(const farop_host* host);
  static void log_line(const farop_host* host, farop_log_level level, const char* text);
  static const char* option_value(const farop_host* host, const char* key);
  static const void* extension_named(const farop_host* host, const char* id);

  Table table_;
  std::map<std::string, std::string> options_;
  PluginLog log_;
  mutable std::mutex mutex_;  ///< rasterizers may log from threads of their own
  std::string last_error_, last_line_;
};

}  // namespace farop
