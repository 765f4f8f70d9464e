// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <mstch/mstch.hpp>
#include <nlohmann/json.hpp>

#include "conformance_report/finding_nodes.h"
#include "conformance_report/perf_picture.h"
#include "conformance_report/web_files_internal.h"
#include "core/diagnostics.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;
using Json = nlohmann::ordered_json;

constexpr std::size_t k_page_text_limit = 4096, k_output_limit = 16384, k_listed_cases = 2000;

/// The template in the language of the page: [[sentence]] becomes its translation.
std::string localized_template(const Catalogue& words) {
  std::string_view rest = k_web_template;
  std::string out;
  for (std::size_t at = 0; (at = rest.find("[[")) != std::string_view::npos;) {
    const std::size_t end = rest.find("]]", at);
    out += rest.substr(0, at);
    out += words(rest.substr(at + 2, end - at - 2));
    rest.remove_prefix(end + 2);
  }
  return out.append(rest);
}

/// The sentences that the script asks for with t('...').
Json script_words(const Catalogue& words) {
  Json json = Json::object();
  const std::string_view script = k_web_script;
  for (std::size_t at = 0; (at = script.find("t('", at)) != std::string_view::npos; at += 3) {
    const std::size_t end = script.find("')", at);
    const std::string word(script.substr(at + 3, end - at - 3));
    json[word] = words(word);
  }
  return json;
}

std::string status_word(CaseStatus status, const Catalogue& words) {
  return words(status == CaseStatus::failed ? "failed" : status == CaseStatus::warned ? "warned" : "skipped");
}

class Page {
 public:
  Page(const CheckResult& result, const Catalogue& words) : result_(result), words_(words) {}

  std::string write() {
    FindingNodes findings(result_, words_);
    mstch::map page = head();
    page["findings"] = findings.all();
    page["no_findings"] = result_.findings.empty();
    page["fingerprint"] = fingerprint();
    page["families"] = families();
    page["listed"] = listed_cases();
    page["perf"] = perf();
    page["has_perf"] = !result_.perf.empty();
    page["facts"] = facts();
    page["notes"] = notes(findings.left_out());
    page["has_viewer"] = !findings.viewer().empty();
    const Json json{{"words", script_words(words_)}, {"pictures", findings.viewer()}};
    std::string data = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    // Inside a script element only '<' could end it.
    for (std::size_t at = 0; (at = data.find('<', at)) != std::string::npos;) data.replace(at, 1, "\\u003c");
    page["data"] = data;
    return mstch::render(localized_template(words_), page);
  }

 private:
  mstch::map head() const {
    const Summary& s = result_.summary;
    const RunFacts& run = result_.run;
    const RuleFingerprint& rule = result_.rule_fingerprint;
    return {{"lang", std::string(words_.code())},
            {"name", printable(result_.plugin.name, k_page_text_limit)},
            {"about", printable(result_.plugin.summary, k_page_text_limit)},
            {"passed", !result_.has_errors()},
            {"verdict", words_(printable(s.verdict, k_page_text_limit))},
            {"score", fmt::format("{:.1f}", s.score)},
            {"cases", grouped(s.cases)},
            {"failed", grouped(s.failed)},
            {"judged", grouped(s.judged)},
            {"wrong", grouped(s.wrong)},
            {"ambiguous", grouped(s.ambiguous)},
            {"precision", precision()},
            {"has_precision", !(s.precision.depth_class + s.precision.color_class).empty()},
            {"required", rule.required},
            {"named", rule.named},
            {"has_named", !rule.named.empty()},
            {"closest", rule.closest},
            {"has_closest", !rule.closest.empty()},
            {"explains", fmt::format("{:.1f}", 100 * rule.closest_explains)},
            {"command", printable(run.command, k_page_text_limit)},
            {"output", printable_lines(run.output + run.error_output, k_output_limit)},
            {"has_output", !(run.output + run.error_output).empty()},
            {"style", std::string(k_web_style)},
            {"script_hash", std::string(k_web_script_hash)},
            {"script", std::string(k_web_script)}};
  }

  mstch::array precision() const {
    const Precision& p = result_.summary.precision;
    const auto row = [&](const char* what, const std::string& name, double worst, bool last) {
      return mstch::map{{"what", words_(what)},
                        {"class", words_(name.empty() ? "not measured" : name)},
                        {"worst", name.empty() ? std::string() : fmt::format("{:.4g}", worst)},
                        {"last", last}};
    };
    return {row("depth", p.depth_class, p.worst_depth, false),
            row("colour", p.color_class, p.worst_color, true)};
  }

  mstch::array fingerprint() const {
    mstch::array rows;
    for (const FingerprintRow& row : result_.rule_fingerprint.table) {
      rows.push_back(mstch::map{
          {"kind", words_(row.kind)},
          {"owned", grouped(row.owned)},
          {"cases", grouped(row.cases)},
          {"share", row.cases == 0 ? std::string("0") : std::to_string(100 * row.owned / row.cases)}});
    }
    return rows;
  }

  mstch::array families() const {
    std::vector<const FamilyResult*> order;
    for (const FamilyResult& f : result_.families) order.push_back(&f);
    std::ranges::stable_sort(order, [](const auto* a, const auto* b) { return a->failed > b->failed; });
    mstch::array rows;
    for (const FamilyResult* f : order) {
      rows.push_back(mstch::map{{"name", printable(f->name, 200)},
                                {"passed", grouped(f->passed + f->warned)},
                                {"failed", grouped(f->failed)},
                                {"bad", f->failed > 0},
                                {"skipped", grouped(f->skipped)},
                                {"seconds", fmt::format("{:.2f}", f->milliseconds / 1000)},
                                {"reason", printable(f->skip_reason, k_page_text_limit)}});
    }
    return rows;
  }

  /// Everything but the cases that passed.
  mstch::array listed_cases() const {
    mstch::array rows;
    for (const CaseStatus status : {CaseStatus::failed, CaseStatus::warned, CaseStatus::skipped}) {
      for (const CaseResult& c : result_.cases) {
        if (c.status != status || rows.size() == k_listed_cases) continue;
        std::string verdicts;
        for (const std::string& v : c.verdicts)
          verdicts += (verdicts.empty() ? "" : ", ") + printable(v, 200);
        rows.push_back(
            mstch::map{{"id", printable(c.id, 200)},
                       {"status", status_word(status, words_)},
                       {"verdicts", verdicts},
                       {"wrong", grouped(c.wrong)},
                       {"purpose", printable(c.status == CaseStatus::skipped ? c.reason : c.purpose, 500)}});
      }
    }
    return rows;
  }

  mstch::array perf() const {
    const auto interval = [](double value, double low, double high) {
      return fmt::format("{:.2f} ({:.2f} - {:.2f})", value, low, high);
    };
    mstch::array nodes;
    for (const PerfResult& p : result_.perf) {
      const std::string what = words_(what_grows(p.name));
      nodes.push_back(mstch::map{{"name", printable(p.name, 200)},
                                 {"what", what},
                                 {"svg", perf_svg(p, what)},
                                 {"slope", interval(p.slope, p.slope_low, p.slope_high)},
                                 {"has_slope", p.slope_high > 0},
                                 {"ratio", interval(p.ratio, p.ratio_low, p.ratio_high)},
                                 {"has_ratio", p.ratio_high > 0}});
    }
    return nodes;
  }

  mstch::array facts() const {
    const RunFacts& run = result_.run;
    const PluginFacts& plugin = result_.plugin;
    mstch::array rows;
    const auto add = [&](const char* name, const std::string& value) {
      if (!value.empty())
        rows.push_back(mstch::map{{"name", words_(name)}, {"value", printable(value, k_page_text_limit)}});
    };
    std::string walls;
    for (const std::string& wall : run.isolation) walls += (walls.empty() ? "" : ", ") + wall;
    add("program", run.program_version.empty() ? "" : "FAROP " + run.program_version);
    add("rasterizer", plugin.argument == plugin.name ? "" : plugin.argument);
    add("sha256", plugin.sha256);
    add("started", run.started);
    add("level", run.level);
    add("seed", std::to_string(run.seed));
    add("corpus", run.corpus_hash);
    add("system", run.system);
    add("processor", run.processor);
    add("compiler", run.compiler);
    add("isolation", walls);
    return rows;
  }

  mstch::array notes(std::size_t left_out) const {
    mstch::array list;
    for (const std::string& note : result_.notes)
      list.push_back(mstch::map{{"text", printable_lines(note, k_page_text_limit)}});
    if (left_out > 0) {
      list.push_back(
          mstch::map{{"text", words_.format("{} pictures are left out to keep this page small.", left_out)}});
    }
    return list;
  }

  const CheckResult& result_;
  const Catalogue& words_;
};

}  // namespace

std::string to_html(const CheckResult& result, const Catalogue& words) {
  return Page(result, words).write();
}

}  // namespace farop::conformance_report
