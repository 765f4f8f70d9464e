// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/github_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/diagnostics.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;

constexpr std::size_t k_annotations = 10;  // of a kind and step: more are not shown
constexpr std::size_t k_annotation_limit = 2000, k_summary_findings = 200;

/// Of a message; properties must not contain ':' and ',' either.
std::string escaped(std::string_view text, bool property) {
  std::string out;
  for (const char c : printable(text, k_annotation_limit)) {
    const bool bad = c == '%' || (property && (c == ':' || c == ','));
    out += bad ? fmt::format("%{:02X}", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return out;
}

/// Text in a table of Markdown: nothing of it is markup.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : printable(text, k_annotation_limit)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (std::string_view("\\`*_{}[]()#+!|~@$").find(c) != std::string_view::npos)
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

std::string title_of(const Finding& f) {
  return f.verdict + (f.detail.empty() ? "" : " " + f.detail);
}

const char* command_of(conformance::Severity severity) {
  return severity == conformance::Severity::error ? "error" : "warning";
}

}  // namespace

std::string to_github_annotations(const CheckResult& r, const Catalogue& words) {
  // Scripts are in the repository as they are: the annotation is shown at the file.
  const std::string file = r.plugin.kind == "python" ? ",file=" + escaped(r.plugin.argument, true) : "";
  std::string out;
  for (const auto severity : {conformance::Severity::error, conformance::Severity::warning}) {
    std::size_t shown = 0;
    for (const Finding& f : r.findings) {
      if (f.severity != severity || ++shown > k_annotations) continue;
      std::string text = f.message + (f.hint.empty() ? "." : ". " + words.format("hint: {}", f.hint) + ".");
      if (!f.case_ids.empty()) text += " " + words.format("First case: {}.", f.case_ids.front());
      if (!f.examples.empty() && !f.examples.front().command.empty())
        text += " " + words.format("repeat: {}", f.examples.front().command);
      out += fmt::format("::{} title={}{}::{}\n", command_of(severity),
                         escaped("farop check: " + title_of(f), true), file, escaped(text, false));
    }
  }
  const Summary& s = r.summary;
  return out + "::notice title=farop check::" +
         escaped(
             s.verdict + ". " +
                 words.format("{} cases, {} failed, {} skipped; {} pixels judged, {} wrong, {} left open; "
                              "score {} of 100.",
                              s.cases, s.failed, s.skipped, s.judged, s.wrong, s.ambiguous,
                              fmt::format("{:.1f}", s.score)),
             false) +
         "\n";
}

std::string to_github_summary(const CheckResult& r, const Catalogue& words) {
  const Summary& s = r.summary;
  std::string out =
      fmt::format("## farop check: {}\n\n**{}**. {}\n", plain(r.plugin.name), plain(words(s.verdict)),
                  words.format("{} cases, {} failed, {} skipped; {} pixels judged, {} wrong, {} "
                               "left open; score {} of 100.",
                               s.cases, s.failed, s.skipped, s.judged, s.wrong, s.ambiguous,
                               fmt::format("{:.1f}", s.score)));
  if (!r.findings.empty()) {
    out += fmt::format("\n| | {} | {} |\n|---|---|---|\n", words("verdict"), words("What is wrong, and why"));
    std::size_t listed = 0;
    for (const Finding& f : r.findings) {
      if (++listed > k_summary_findings) break;
      out += fmt::format("| {} | {} | {}{} |\n", severity_letter(f.severity), plain(title_of(f)),
                         plain(f.message), f.hint.empty() ? "" : "<br>" + plain(f.hint));
    }
  }
  out += fmt::format("\n| {} | {} | {} | {} |\n|---|---:|---:|---:|\n", words("family"), words("passed"),
                     words("failed"), words("skipped"));
  for (const FamilyResult& f : r.families) {
    out += fmt::format("| {} | {} | {} | {} |\n", plain(f.name), f.passed + f.warned, f.failed, f.skipped);
  }
  return out + "\n";
}

}  // namespace farop::conformance_report
