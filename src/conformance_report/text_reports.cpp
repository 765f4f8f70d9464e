// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/text_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/diagnostics.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;
using Json = nlohmann::ordered_json;

constexpr std::size_t k_cell_limit = 16384;

/// Printable, line by line.
std::string clean(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (at > 0) out += '\n';
    out += printable(text.substr(at, end - at), k_cell_limit);
    at = end + 1;
  }
  return out;
}

Json clean_list(const std::vector<std::string>& list) {
  Json json = Json::array();
  for (const std::string& s : list) json.push_back(clean(s));
  return json;
}

std::string dumped(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

const char* status_name(CaseStatus status) {
  switch (status) {
    case CaseStatus::passed:
      return "passed";
    case CaseStatus::failed:
      return "failed";
    case CaseStatus::warned:
      return "warned";
    case CaseStatus::skipped:
      break;
  }
  return "skipped";
}

std::string family_of(const std::string& id) {
  return id.substr(0, id.find('/'));
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : " ") + w;
  return out;
}

Json pixel_json(const WrongPixel& p) {
  Json json{{"x", p.x},
            {"y", p.y},
            {"kind", p.kind},
            {"expected", p.expected},
            {"got", p.got},
            {"expected_owner", p.expected_owner},
            {"got_owner", p.got_owner}};
  Json& values = json["values"] = Json::array();
  for (const ExactValue& v : p.values) {
    values.push_back({{"name", v.name},
                      {"numerator", v.numerator},
                      {"denominator", v.denominator},
                      {"got", v.got ? Json(*v.got) : Json(nullptr)}});
  }
  return json;
}

Json example_json(const Example& e) {
  Json json{{"case", clean(e.from_case)},
            {"frame", {e.frame.x, e.frame.y, e.frame.z, e.frame.color}},
            {"polygons", e.polygons.size()},
            {"flat", clean(e.flat)},
            {"file", clean(e.file)},
            {"command", clean(e.command)},
            {"shrunk", e.shrunk},
            {"wrong_pixels", e.wrong_pixels}};
  Json& pixels = json["pixels"] = Json::array();
  for (const WrongPixel& p : e.pixels) pixels.push_back(pixel_json(p));
  return json;
}

Json finding_json(const Finding& f) {
  return {{"verdict", f.verdict},
          {"detail", clean(f.detail)},
          {"severity", std::string(1, severity_letter(f.severity))},
          {"message", clean(f.message)},
          {"hint", clean(f.hint)},
          {"count", f.count},
          {"explained", f.explained},
          {"total", f.total},
          {"cases", clean_list(f.case_ids)},
          {"trace", clean_list(f.trace)},
          {"at_polygon", f.at_polygon ? Json(*f.at_polygon) : Json(nullptr)},
          {"example", f.examples.empty() ? Json(nullptr) : example_json(f.examples.front())}};
}

Json family_json(const FamilyResult& f) {
  return {{"name", f.name},      {"passed", f.passed},       {"failed", f.failed},
          {"warned", f.warned},  {"skipped", f.skipped},     {"judged", f.judged},
          {"wrong", f.wrong},    {"ambiguous", f.ambiguous}, {"skip_reason", clean(f.skip_reason)},
          {"ms", f.milliseconds}};
}

Json case_json(const CaseResult& c) {
  return {{"id", clean(c.id)},
          {"status", status_name(c.status)},
          {"verdicts", clean_list(c.verdicts)},
          {"judged", c.judged},
          {"wrong", c.wrong},
          {"ambiguous", c.ambiguous},
          {"reason", clean(c.reason)},
          {"ms", c.milliseconds}};
}

Json run_json(const RunFacts& r) {
  return {{"version", r.program_version},
          {"compiler", r.compiler},
          {"system", clean(r.system)},
          {"processor", clean(r.processor)},
          {"command", clean(r.command)},
          {"level", r.level},
          {"seed", r.seed},
          {"corpus", r.corpus_hash},
          {"rule", r.rule},
          {"precision", r.precision},
          {"isolation", r.isolation},
          {"in_process", r.in_process},
          {"workers", r.workers},
          {"time_started", r.started},
          {"time_seconds", r.time_seconds}};
}

Json summary_json(const Summary& s) {
  return {{"verdict", s.verdict},
          {"score", s.score},
          {"cases", s.cases},
          {"failed", s.failed},
          {"warned", s.warned},
          {"skipped", s.skipped},
          {"judged", s.judged},
          {"wrong", s.wrong},
          {"ambiguous", s.ambiguous},
          {"precision",
           {{"depth", s.precision.depth_class},
            {"depth_error", s.precision.worst_depth},
            {"colour", s.precision.color_class},
            {"colour_error", s.precision.worst_color}}}};
}

Json perf_json(const PerfResult& p) {
  const auto milliseconds = [](std::vector<double> list) {
    for (double& value : list) value *= 1000;
    return list;
  };
  return {{"name", clean(p.name)},
          {"sizes", p.sizes},
          {"ms", milliseconds(p.seconds)},
          {"reference_ms", milliseconds(p.reference_seconds)},
          {"slope", {p.slope, p.slope_low, p.slope_high}},
          {"ratio", {p.ratio, p.ratio_low, p.ratio_high}}};
}

Json fingerprint_json(const RuleFingerprint& f) {
  Json json{{"required", f.required},
            {"named", f.named},
            {"closest", f.closest},
            {"closest_explains", f.closest_explains}};
  Json& table = json["table"] = Json::array();
  for (const FingerprintRow& row : f.table)
    table.push_back({{"kind", row.kind}, {"owned", row.owned}, {"cases", row.cases}});
  return json;
}

/// For text and attributes of XML 1.0.
std::string xml(std::string_view text) {
  std::string out;
  for (const char c : clean(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// Not a wrong picture but none at all.
bool is_process_verdict(const std::string& verdict) {
  return std::ranges::any_of(
      std::initializer_list<std::string_view>{"crash.", "limit.", "abi.", "oob.", "harness."},
      [&](std::string_view start) { return verdict.starts_with(start); });
}

const Finding* finding_of(const CheckResult& result, const std::string& verdict) {
  const auto found = std::ranges::find(result.findings, verdict, &Finding::verdict);
  return found == result.findings.end() ? nullptr : &*found;
}

std::string message_of(const CheckResult& result, const std::string& verdict) {
  const Finding* f = finding_of(result, verdict);
  return f == nullptr ? verdict : f->message + (f->hint.empty() ? "" : " " + f->hint);
}

std::string first_verdict(const CaseResult& c) {
  return c.verdicts.empty() ? "unknown" : c.verdicts.front();
}

std::string junit_case(const CheckResult& result, const CaseResult& c) {
  std::string out = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.6f}\">",
                                xml(family_of(c.id)), xml(c.id), c.milliseconds / 1000);
  if (c.status == CaseStatus::failed) {
    const std::string verdict = first_verdict(c);
    out +=
        fmt::format("<{0} type=\"{1}\" message=\"{2}\"/>", is_process_verdict(verdict) ? "error" : "failure",
                    xml(verdict), xml(message_of(result, verdict)));
  } else if (c.status == CaseStatus::skipped) {
    out += fmt::format("<skipped message=\"{}\"/>", xml(c.reason));
  }
  return out + "</testcase>\n";
}

/// Quoted; a leading sign that a spreadsheet reads as a formula is disarmed.
std::string csv(std::string_view text) {
  std::string out = clean(text);
  if (!out.empty() && std::string_view("=+-@").find(out.front()) != std::string_view::npos)
    out.insert(0, "'");
  for (std::size_t at = 0; (at = out.find('"', at)) != std::string::npos; at += 2) out.insert(at, "\"");
  return "\"" + out + "\"";
}

std::string gradescope_output(const CheckResult& result, const FamilyResult& family, const Catalogue& words) {
  std::string out = words.format("{} passed, {} failed, {} skipped.", family.passed + family.warned,
                                 family.failed, family.skipped);
  if (!family.skip_reason.empty()) out += " " + words.format("Not run: {}", clean(family.skip_reason));
  for (const Finding& f : result.findings) {
    const bool here =
        std::ranges::any_of(f.case_ids, [&](const std::string& id) { return family_of(id) == family.name; });
    if (here) out += fmt::format("\n{}: {} {}", f.verdict, clean(f.message), clean(f.hint));
  }
  return out;
}

}  // namespace

std::string to_json(const CheckResult& r) {
  Json json{{"schema", "farop.check/1"}};
  json["plugin"] = {{"kind", r.plugin.kind},        {"argument", clean(r.plugin.argument)},
                    {"name", clean(r.plugin.name)}, {"summary", clean(r.plugin.summary)},
                    {"sha256", r.plugin.sha256},    {"wants", clean_list(r.plugin.wants)},
                    {"abi", r.plugin.abi}};
  json["run"] = run_json(r.run);
  json["summary"] = summary_json(r.summary);
  json["rule_fingerprint"] = fingerprint_json(r.rule_fingerprint);
  for (const char* list : {"findings", "families", "cases", "perf"}) json[list] = Json::array();
  for (const Finding& f : r.findings) json["findings"].push_back(finding_json(f));
  for (const FamilyResult& f : r.families) json["families"].push_back(family_json(f));
  for (const CaseResult& c : r.cases) json["cases"].push_back(case_json(c));
  for (const PerfResult& p : r.perf) json["perf"].push_back(perf_json(p));
  json["notes"] = clean_list(r.notes);
  return dumped(json, 1);
}

std::string to_json_line(const CaseResult& one, const std::string& corpus_hash) {
  Json json{{"corpus", corpus_hash}};
  json.update(case_json(one));
  return dumped(json, -1);
}

std::string to_junit(const CheckResult& r) {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"farop check\">\n";
  for (const FamilyResult& family : r.families) {
    std::string cases;
    std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
    for (const CaseResult& c : r.cases) {
      if (family_of(c.id) != family.name) continue;
      ++tests;
      if (c.status == CaseStatus::failed) ++(is_process_verdict(first_verdict(c)) ? errors : failures);
      if (c.status == CaseStatus::skipped) ++skipped;
      cases += junit_case(r, c);
    }
    out += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" "
        "time=\"{:.6f}\">\n{}"
        "  </testsuite>\n",
        xml(family.name), tests, failures, errors, skipped, family.milliseconds / 1000, cases);
  }
  return out + "</testsuites>\n";
}

std::string to_tap(const CheckResult& r) {
  std::string out = fmt::format("TAP version 13\n1..{}\n", r.cases.size());
  std::size_t number = 0;
  for (const CaseResult& c : r.cases) {
    // '#' starts a directive.
    std::string id = clean(c.id);
    for (std::size_t at = 0; (at = id.find('#', at)) != std::string::npos; at += 2) id.insert(at, "\\");
    out += fmt::format("{} {} - {}", c.status == CaseStatus::failed ? "not ok" : "ok", ++number, id);
    if (c.status == CaseStatus::skipped) out += " # SKIP " + printable(c.reason, k_cell_limit);
    out += '\n';
    if (c.status != CaseStatus::failed) continue;
    // A JSON string is a YAML string.
    out += fmt::format("  ---\n  verdict: {}\n  message: {}\n  ...\n", Json(joined(c.verdicts)).dump(),
                       Json(clean(message_of(r, first_verdict(c)))).dump());
  }
  return out;
}

std::string to_csv(const CheckResult& r) {
  std::string out = "id,family,status,verdicts,judged,wrong,ambiguous,ms,reason\r\n";
  for (const CaseResult& c : r.cases) {
    out += fmt::format("{},{},{},{},{},{},{},{:.3f},{}\r\n", csv(c.id), csv(family_of(c.id)),
                       status_name(c.status), csv(joined(c.verdicts)), c.judged, c.wrong, c.ambiguous,
                       c.milliseconds, csv(c.reason));
  }
  return out;
}

std::string to_gradescope(const CheckResult& r, const Catalogue& words) {
  Json tests = Json::array();
  constexpr double k_points = 10;
  for (const FamilyResult& f : r.families) {
    const std::uint64_t run = f.passed + f.warned + f.failed;
    const double share = run == 0 ? 0 : static_cast<double>(f.passed + f.warned) / static_cast<double>(run);
    tests.push_back({{"name", f.name},
                     {"score", k_points * share},
                     {"max_score", k_points},
                     {"status", run > 0 && f.failed == 0 ? "passed" : "failed"},
                     {"output", gradescope_output(r, f, words)},
                     {"output_format", "text"},
                     {"visibility", "visible"}});
  }
  Json json{{"execution_time", r.run.time_seconds}};
  // A result without tests needs a score of its own.
  if (tests.empty()) json["score"] = 0;
  json["output"] =
      words.format("{}: {} of {} cases failed.", clean(r.summary.verdict), r.summary.failed, r.summary.cases);
  json["tests"] = std::move(tests);
  json["extra_data"] = {{"corpus", r.run.corpus_hash}, {"seed", r.run.seed}};
  return dumped(json, 1);
}

std::string gradescope_unfinished(const Catalogue& words) {
  const Json json{
      {"score", 0},
      {"output", words("The check did not finish: it was stopped, or ran out of time or memory.")},
      {"tests", Json::array()}};
  return dumped(json, 1);
}

}  // namespace farop::conformance_report
