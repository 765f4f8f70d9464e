// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mstch/mstch.hpp>
#include <nlohmann/json.hpp>

#include "conformance_report/lattice_picture.h"
#include "conformance_report/png.h"
#include "conformance_report/row_story.h"
#include "conformance_report/web_files_internal.h"
#include "core/diagnostics.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;
using Json = nlohmann::ordered_json;

// The page must stay small enough to be mailed.
constexpr std::size_t k_page_budget = 6u << 20u;
constexpr std::size_t k_text_limit = 4096, k_output_limit = 16384;
constexpr std::size_t k_tables_size = 6000;  // about what the tables of one finding take
constexpr std::size_t k_listed_cases = 2000, k_listed_pixels = 12, k_listed_findings = 2000;

std::string lines(std::string_view text, std::size_t limit = k_text_limit) {
  std::string out;
  while (!text.empty() && out.size() < limit) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out += printable(text.substr(0, end), limit);
    out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return text.empty() ? out : out + "...\n";
}

std::string number(std::uint64_t n) {
  std::string s = std::to_string(n);
  for (int at = static_cast<int>(s.size()) - 3; at > 0; at -= 3)
    s.insert(static_cast<std::size_t>(at), "\u00A0");  // no line break inside
  return s;
}

std::string corner_text(const ScreenVertex& v) {
  return fmt::format("({}, {})", v.x, v.y);
}

/// The polygon whose row is shown: the owner that should have been there, or the one that was.
int story_polygon(const Example& e) {
  if (e.polygons.empty() || e.pixels.empty()) return -1;
  const WrongPixel& p = e.pixels.front();
  const int wanted = p.expected_owner >= 0 ? p.expected_owner : p.got_owner;
  return wanted >= 0 && static_cast<std::size_t>(wanted) < e.polygons.size() ? wanted : 0;
}

/// The first wrong row: crossings as fractions, and the parity count that decides each pixel.
mstch::map row_node(const Example& e, const TestPolygon& polygon) {
  const int y = e.pixels.front().y;
  const std::vector<Crossing> row = crossings(polygon, y);
  mstch::array crossing_nodes, steps;
  for (const Crossing& c : row) {
    crossing_nodes.push_back(mstch::map{{"x", "x = " + fraction(c.numerator, c.denominator)},
                                        {"edge", corner_text(c.from) + " - " + corner_text(c.to)}});
  }
  const int first = std::max(0, e.pixels.front().x - 6), widest = std::min(e.frame.x - 1, first + 15);
  // Behind the last crossing and the last wrong pixel nothing happens any more.
  int last = first + 1;
  if (!row.empty())
    last = std::max<int>(last, static_cast<int>(row.back().numerator / row.back().denominator) + 2);
  for (const WrongPixel& p : e.pixels) last = p.y == y ? std::max(last, p.x + 1) : last;
  last = std::min(last, widest);
  for (int x = first; x <= last; ++x) {
    const int count = crossings_up_to(row, x);
    const auto wrong =
        std::ranges::find_if(e.pixels, [&](const WrongPixel& p) { return p.x == x && p.y == y; });
    const bool bad = wrong != e.pixels.end();
    steps.push_back(mstch::map{{"x", x},
                               {"count", count},
                               {"inside", std::string(count % 2 == 1 ? "inside" : "outside")},
                               {"wrong", bad},
                               {"kind", bad ? wrong->kind : std::string()}});
  }
  return {{"y", y}, {"crossings", crossing_nodes}, {"steps", steps}, {"none", row.empty()}};
}

mstch::array pixel_nodes(const Example& e) {
  mstch::array nodes;
  for (const WrongPixel& p : e.pixels) {
    if (nodes.size() == k_listed_pixels) break;
    std::string values;
    for (const ExactValue& v : p.values) {
      values +=
          fmt::format("{}{} = {}", values.empty() ? "" : "; ", v.name, fraction(v.numerator, v.denominator));
      if (v.got) values += fmt::format(", yours {}", *v.got);
    }
    nodes.push_back(
        mstch::map{{"at", fmt::format("({}, {})", p.x, p.y)},
                   {"kind", p.kind},
                   {"expected", fmt::format("{} {} {}", p.expected[0], p.expected[1], p.expected[2])},
                   {"got", fmt::format("{} {} {}", p.got[0], p.got[1], p.got[2])},
                   {"values", values}});
  }
  return nodes;
}

/// What the viewer needs beside the two pictures of the page.
Json viewer_data(const Example& e) {
  Json json{{"w", e.frame.x}, {"h", e.frame.y}, {"case", printable(e.from_case, k_text_limit)}};
  Json& polygons = json["polygons"] = Json::array();
  std::size_t corners = 0;
  for (const TestPolygon& polygon : e.polygons) {
    corners += polygon.size();
    if (corners > 20000) break;
    Json list = Json::array();
    for (const ScreenVertex& v : polygon) list.push_back({v.x, v.y, v.z, v.r, v.g, v.b});
    polygons.push_back(std::move(list));
  }
  Json& wrong = json["wrong"] = Json::array();
  for (const WrongPixel& p : e.pixels) wrong.push_back({p.x, p.y, p.kind});
  // Runs of (owner, length) keep large frames small.
  Json& owners = json["owners"] = Json::array();
  for (std::size_t i = 0; i < e.owners.size();) {
    std::size_t end = i;
    while (end < e.owners.size() && e.owners[end] == e.owners[i]) ++end;
    owners.push_back(e.owners[i]);
    owners.push_back(end - i);
    i = end;
  }
  return json;
}

class Page {
 public:
  explicit Page(const CheckResult& result) : result_(result) {}

  std::string write() {
    const Summary& s = result_.summary;
    const RunFacts& run = result_.run;
    mstch::map page{{"name", printable(result_.plugin.name, k_text_limit)},
                    {"about", printable(result_.plugin.summary, k_text_limit)},
                    {"passed", !result_.has_errors()},
                    {"verdict", printable(s.verdict, k_text_limit)},
                    {"score", fmt::format("{:.1f}", s.score)},
                    {"cases", number(s.cases)},
                    {"failed", number(s.failed)},
                    {"judged", number(s.judged)},
                    {"wrong", number(s.wrong)},
                    {"ambiguous", number(s.ambiguous)},
                    {"required", result_.rule_fingerprint.required},
                    {"named", result_.rule_fingerprint.named},
                    {"closest", result_.rule_fingerprint.closest},
                    {"version", run.program_version},
                    {"machine", printable(run.processor + " " + run.system, k_text_limit)},
                    {"level", run.level},
                    {"seed", std::to_string(run.seed)},
                    {"corpus", run.corpus_hash},
                    {"command", printable(run.command, k_text_limit)},
                    {"output", lines(run.output + run.error_output, k_output_limit)},
                    {"style", std::string(k_web_style)},
                    {"script_hash", std::string(k_web_script_hash)},
                    {"script", std::string(k_web_script)}};
    page["has_output"] = !(run.output + run.error_output).empty();
    page["fingerprint"] = fingerprint();
    page["findings"] = findings();
    page["has_named"] = !result_.rule_fingerprint.named.empty();
    page["no_findings"] = result_.findings.empty();
    page["families"] = families();
    page["listed"] = listed_cases();
    mstch::array notes;
    for (const std::string& note : result_.notes) notes.push_back(mstch::map{{"text", lines(note)}});
    if (left_out_ > 0)
      notes.push_back(
          mstch::map{{"text", fmt::format("{} pictures are left out to keep this page small.", left_out_)}});
    page["notes"] = notes;
    page["has_viewer"] = !viewer_.empty();
    std::string data = viewer_.dump(-1, ' ', true, Json::error_handler_t::replace);
    // Inside a script element only '<' could end it.
    for (std::size_t at = 0; (at = data.find('<', at)) != std::string::npos;) data.replace(at, 1, "\\u003c");
    page["data"] = data;
    return mstch::render(k_web_template, page);
  }

 private:
  mstch::array fingerprint() const {
    mstch::array rows;
    for (const FingerprintRow& row : result_.rule_fingerprint.table) {
      rows.push_back(mstch::map{
          {"kind", row.kind},
          {"owned", number(row.owned)},
          {"cases", number(row.cases)},
          {"share", row.cases == 0 ? std::string("0") : std::to_string(100 * row.owned / row.cases)}});
    }
    return rows;
  }

  mstch::array findings() {
    mstch::array nodes;
    for (const Finding& f : result_.findings) {
      if (nodes.size() == k_listed_findings) break;
      nodes.push_back(finding(f, nodes.size() + 1));
    }
    return nodes;
  }

  mstch::map finding(const Finding& f, std::size_t index) {
    mstch::array trace;
    for (const std::string& line : f.trace) trace.push_back(mstch::map{{"text", lines(line)}});
    mstch::map node{{"index", std::to_string(index)},
                    {"verdict", printable(f.verdict, 200)},
                    {"detail", printable(f.detail, 200)},
                    {"letter", std::string(1, severity_letter(f.severity))},
                    {"message", lines(f.message)},
                    {"hint", lines(f.hint)},
                    {"has_hint", !f.hint.empty()},
                    {"count", number(f.count)},
                    {"shown_by", number(f.case_ids.size())},
                    {"first_case", f.case_ids.empty() ? std::string() : printable(f.case_ids.front(), 200)},
                    {"trace", trace},
                    {"has_trace", !trace.empty()}};
    if (!f.examples.empty()) add_example(node, f.examples.front());
    return node;
  }

  void add_example(mstch::map& node, const Example& e) {
    // Without a file of its own an example is repeated by its case.
    std::string command = e.command;
    if (command.empty() && !e.from_case.empty() && !result_.run.command.empty() &&
        result_.run.command.find(" --case ") == std::string::npos)
      command = result_.run.command + " --case '" + e.from_case + "'";
    node["command"] = printable(command, k_text_limit);
    node["has_command"] = !command.empty();
    if (used_ > k_page_budget) {
      ++left_out_;
      return;
    }
    node["flat"] = lines(e.flat, k_text_limit);
    node["has_flat"] = !e.flat.empty();
    node["pixels"] = pixel_nodes(e);
    node["has_pixels"] = !e.pixels.empty();
    used_ += std::min(e.flat.size(), k_text_limit) + k_tables_size;
    const int polygon = story_polygon(e);
    if (polygon >= 0) node["row"] = row_node(e, e.polygons[static_cast<std::size_t>(polygon)]);
    if (e.expected.rgb.empty() || e.got.rgb.empty()) return;
    const std::string svg =
        lattice_svg(e, e.pixels.empty() ? -1 : e.pixels.front().y, "expected and delivered pixels");
    const std::string expected = png_data_url(e.expected), got = png_data_url(e.got);
    Json data = viewer_data(e);
    const std::size_t size = svg.size() + expected.size() + got.size() + data.dump().size();
    if (used_ + size > k_page_budget) {
      ++left_out_;
      return;
    }
    used_ += size;
    node["svg"] = svg;
    node["has_svg"] = !svg.empty();
    node["has_pictures"] = !expected.empty() && !got.empty();
    node["expected_png"] = expected;
    node["got_png"] = got;
    node["picture"] = std::to_string(viewer_.size());
    viewer_.push_back(std::move(data));
  }

  mstch::array families() const {
    std::vector<const FamilyResult*> order;
    for (const FamilyResult& f : result_.families) order.push_back(&f);
    std::ranges::stable_sort(order, [](const auto* a, const auto* b) { return a->failed > b->failed; });
    mstch::array rows;
    for (const FamilyResult* f : order) {
      rows.push_back(mstch::map{{"name", printable(f->name, 200)},
                                {"passed", number(f->passed + f->warned)},
                                {"failed", number(f->failed)},
                                {"bad", f->failed > 0},
                                {"skipped", number(f->skipped)},
                                {"seconds", fmt::format("{:.2f}", f->milliseconds / 1000)},
                                {"reason", printable(f->skip_reason, k_text_limit)}});
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
                       {"status", std::string(status == CaseStatus::failed   ? "failed"
                                              : status == CaseStatus::warned ? "warned"
                                                                             : "skipped")},
                       {"verdicts", verdicts},
                       {"wrong", number(c.wrong)},
                       {"purpose", printable(c.status == CaseStatus::skipped ? c.reason : c.purpose, 500)}});
      }
    }
    return rows;
  }

  const CheckResult& result_;
  Json viewer_ = Json::array();
  std::size_t used_ = 0, left_out_ = 0;
};

}  // namespace

std::string to_html(const CheckResult& result) {
  return Page(result).write();
}

}  // namespace farop::conformance_report
