// SPDX-License-Identifier: GPL-3.0-or-later
// What the user sees on standard error; standard output carries data only.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>

#include "core/diagnostics.h"
#include "core/error.h"
#include "core/progress.h"
#include "options.h"

namespace farop::app {

class Console : public DiagnosticSink {
 public:
  void configure(const ReportOptions& options);
  /// --strict: warnings become errors.
  void set_strict(bool strict) { strict_ = strict; }

  /// Prints a diagnostic; under --strict warnings become errors.
  void report(Diagnostic diagnostic) override;
  void report_failure(const Error& error);

  /// A line of the short summary (not under --quiet).
  template <class... Args>
  void summary(fmt::format_string<Args...> format, Args&&... args) {
    if (!quiet_) line(fmt::format(format, std::forward<Args>(args)...));
  }
  /// A line of the log in the words of the 1997 system (only under --verbose).
  template <class... Args>
  void log(fmt::format_string<Args...> format, Args&&... args) {
    if (verbose_) line(fmt::format(format, std::forward<Args>(args)...));
  }
  bool verbose() const { return verbose_; }
  /// A remark that is no warning: what was decided for the user.
  void notice(const std::string& message);

  std::size_t warnings() const { return warnings_; }
  std::size_t errors() const { return errors_; }

  /// A progress bar that appears on a terminal once the work has lasted half a second; empty when not wanted.
  /// `what` names the work.
  ProgressFunction progress(std::string what);
  /// Wipes the bar.
  void end_progress();

 private:
  void line(const std::string& text);
  void print(std::string_view text);
  std::string colored(std::string_view text, const char* code) const;
  void draw_bar(const std::string& what, std::uint64_t done, std::uint64_t total);

  using Clock = std::chrono::steady_clock;
  bool quiet_ = false, verbose_ = false, color_ = false, progress_ = false, strict_ = false;
  bool bar_visible_ = false;
  Clock::time_point work_began_, bar_drawn_;
  std::size_t warnings_ = 0, errors_ = 0;
};

}  // namespace farop::app
