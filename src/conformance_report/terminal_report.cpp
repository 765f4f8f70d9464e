// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/terminal_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "conformance/judge.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;

constexpr int k_columns = 16, k_rows = 12;  // of cells: two pictures fit into 80 columns

struct Part {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // both ends included
};

Part part_around(const Example& e) {
  Part part{e.frame.x, e.frame.y, 0, 0};
  for (const WrongPixel& p : e.pixels) {
    part.x0 = std::min(part.x0, p.x), part.x1 = std::max(part.x1, p.x);
    part.y0 = std::min(part.y0, p.y), part.y1 = std::max(part.y1, p.y);
  }
  part.x0 = std::max(0, part.x0 - 2), part.y0 = std::max(0, part.y0 - 2);
  part.x1 = std::min({e.frame.x - 1, part.x1 + 2, part.x0 + k_columns - 1});
  part.y1 = std::min({e.frame.y - 1, part.y1 + 2, part.y0 + k_rows - 1});
  return part;
}

const char* mark_of(const WrongPixel& p) {
  return p.kind == "missing" ? "<>" : p.kind == "extra" ? "++" : "!!";
}

std::string cell(const Example& e, int x, int y, bool mine, bool colored) {
  const Color c = pixel_at(mine ? e.got : e.expected, x, y);
  const auto wrong =
      std::ranges::find_if(e.pixels, [&](const WrongPixel& p) { return p.x == x && p.y == y; });
  const bool marked = mine && wrong != e.pixels.end();
  if (!colored) return marked ? mark_of(*wrong) : c == e.background ? ". " : "# ";
  // Dark marks on bright cells.
  const int ink = c[0] * 3 + c[1] * 6 + c[2] > 1275 ? 30 : 97;
  return fmt::format("\033[48;2;{};{};{}m\033[{}m{}\033[0m", c[0], c[1], c[2], ink,
                     marked ? mark_of(*wrong) : "  ");
}

/// Expected and delivered side by side, wrong samples marked.
std::string cells(const Example& e, const Catalogue& words, bool colored) {
  if (e.got.rgb.empty() || e.pixels.empty()) return {};
  const Part part = part_around(e);
  std::string text =
      fmt::format("    {:<{}}   {}\n", words("expected"), 2 * (part.x1 - part.x0 + 1), words("yours"));
  for (int y = part.y1; y >= part.y0; --y) {
    text += fmt::format("{:>3} ", y);
    for (const bool mine : {false, true}) {
      for (int x = part.x0; x <= part.x1; ++x) text += cell(e, x, y, mine, colored);
      text += mine ? "\n" : "   ";
    }
  }
  return text + "    " +
         words.format("columns {} to {};  <> missing, ++ too many, !! other", part.x0, part.x1) + "\n";
}

}  // namespace

std::string to_terminal(const CheckResult& result, const Catalogue& words, bool colored) {
  std::string text;
  for (const Finding& f : result.findings) text += finding_line(f) + "\n";
  bool first = true;
  for (const Finding& f : result.findings) {
    text += fmt::format("\n{}{}{}: {}\n", f.verdict, f.detail.empty() ? "" : " ", f.detail, f.message);
    if (!f.hint.empty()) text += "  " + words.format("hint: {}", f.hint) + "\n";
    for (const std::string& line : f.trace) text += "  " + words.format("at {}", line) + "\n";
    if (f.examples.empty()) continue;
    const Example& e = f.examples.front();
    if (first) {
      text += cells(e, words, colored);
      first = e.pixels.empty();
    }
    if (!e.file.empty()) text += "  " + words.format("repeat: {}", e.command) + "\n";
  }
  const Summary& s = result.summary;
  if (!text.empty()) text += "\n";
  text += words.format("{}: {} cases, {} failed, {} skipped; {} samples judged, {} wrong, {} open", s.verdict,
                       s.cases, s.failed, s.skipped, s.judged, s.wrong, s.ambiguous) +
          "\n";
  for (const FamilyResult& f : result.families) {
    text += "  " + words.format("{:<7} {:>6} passed {:>5} failed {:>5} skipped", f.name, f.passed + f.warned,
                                f.failed, f.skipped);
    if (!f.skip_reason.empty()) text += "  (" + f.skip_reason + ")";
    text += "\n";
  }
  for (const std::string& note : result.notes) text += words.format("note: {}", note) + "\n";
  return text;
}

}  // namespace farop::conformance_report
