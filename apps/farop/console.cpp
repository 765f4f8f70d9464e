// SPDX-License-Identifier: GPL-3.0-or-later
#include "console.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace farop::app {
namespace {

constexpr auto k_bar_delay = std::chrono::milliseconds(500);
constexpr auto k_bar_interval = std::chrono::milliseconds(100);
constexpr int k_bar_width = 30;
constexpr const char* k_bold_red = "\033[1;31m";
constexpr const char* k_bold_yellow = "\033[1;33m";
constexpr const char* k_reset = "\033[0m";

}  // namespace

void Console::configure(const ReportOptions& options) {
  const bool terminal = ::isatty(STDERR_FILENO) == 1;
  quiet_ = options.quiet;
  verbose_ = options.verbose;
  progress_ = terminal && !options.quiet && !options.no_progress;
  // https://no-color.org: any non-empty value of NO_COLOR switches colours off unless the option asks for
  // them.
  const char* no_color = std::getenv("NO_COLOR");
  color_ = options.color == "always" ||
           (options.color == "auto" && terminal && (no_color == nullptr || *no_color == 0));
}

void Console::print(std::string_view text) {
  if (bar_visible_) end_progress();
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void Console::line(const std::string& text) {
  print(text + "\n");
}

std::string Console::colored(std::string_view text, const char* code) const {
  return color_ ? fmt::format("{}{}{}", code, text, k_reset) : std::string(text);
}

void Console::report(Diagnostic diagnostic) {
  if (strict_ && diagnostic.severity == farop::Severity::warning)
    diagnostic.severity = farop::Severity::error;
  const bool error = diagnostic.severity == farop::Severity::error;
  if (error) ++errors_;
  if (diagnostic.severity == farop::Severity::warning) ++warnings_;
  if (diagnostic.severity == farop::Severity::note && quiet_) return;
  std::string text = to_text(diagnostic);
  for (const auto& [word, code] :
       {std::pair{": error: ", k_bold_red}, std::pair{": warning: ", k_bold_yellow}}) {
    const std::size_t at = text.find(word);
    if (at != std::string::npos && at < text.find('\n')) {
      const std::string_view inner(word + 2);
      text.replace(at + 2, inner.size(), colored(inner.substr(0, inner.size() - 1), code) + " ");
      break;
    }
  }
  print(text);
}

void Console::report_failure(const Error& error) {
  ++errors_;
  if (*error.what() == 0) return;  // its diagnostic has been printed
  line(fmt::format("farop: {} {}", colored("error:", k_bold_red), error.what()));
  if (!error.hint().empty()) line(fmt::format("  hint: {}", error.hint()));
}

void Console::notice(const std::string& message) {
  if (!quiet_) line(fmt::format("farop: note: {}", message));
}

ProgressFunction Console::progress(std::string what) {
  if (!progress_) return {};
  work_began_ = bar_drawn_ = Clock::now();
  return [this, what = std::move(what)](std::uint64_t done, std::uint64_t total) {
    const auto now = Clock::now();
    if (now - work_began_ < k_bar_delay || now - bar_drawn_ < k_bar_interval) return;
    bar_drawn_ = now;
    draw_bar(what, done, total);
  };
}

void Console::draw_bar(const std::string& what, std::uint64_t done, std::uint64_t total) {
  const double seconds = std::chrono::duration<double>(Clock::now() - work_began_).count();
  if (total > 0) {
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    const int filled = static_cast<int>(share * k_bar_width);
    const double left = share > 0 ? seconds / share - seconds : 0;
    fmt::print(stderr, "\r{:<12} [{:#<{}}{:.<{}}] {:3.0f} %  {:.0f} s left \033[K", what, "", filled, "",
               k_bar_width - filled, 100 * share, left);
  } else {
    fmt::print(stderr, "\r{:<12} {:.1f} million  {:.0f} s \033[K", what, static_cast<double>(done) * 1e-6,
               seconds);
  }
  std::fflush(stderr);
  bar_visible_ = true;
}

void Console::end_progress() {
  if (!bar_visible_) return;
  bar_visible_ = false;
  std::fputs("\r\033[K", stderr);
}

}  // namespace farop::app
