// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/finding_nodes.h"

#include <fmt/format.h>

#include <algorithm>

#include "conformance_report/example_data.h"
#include "conformance_report/lattice_picture.h"
#include "conformance_report/png.h"
#include "conformance_report/row_story.h"
#include "core/diagnostics.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;

// The page must stay small enough to be mailed.
constexpr std::size_t k_page_budget = 6u << 20u;
constexpr std::size_t k_finding_text_limit = 4096;
constexpr std::size_t k_tables_size = 6000;  // about what the tables of one finding take
constexpr std::size_t k_listed_pixels = 12, k_listed_findings = 2000, k_listed_sums = 24;

std::string corner_text(const ScreenVertex& v) {
  return fmt::format("({}, {})", v.x, v.y);
}

std::string edge_text(const Crossing& c) {
  return corner_text(c.from) + " - " + corner_text(c.to);
}

/// The polygon whose row is shown: the owner that should have been there, or the one that was.
int story_polygon(const Example& e) {
  if (e.polygons.empty() || e.pixels.empty()) return -1;
  const WrongPixel& p = e.pixels.front();
  const int wanted = p.expected_owner >= 0 ? p.expected_owner : p.got_owner;
  return wanted >= 0 && static_cast<std::size_t>(wanted) < e.polygons.size() ? wanted : 0;
}

}  // namespace

std::string printable_lines(std::string_view text, std::size_t limit) {
  std::string out;
  while (!text.empty() && out.size() < limit) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out += printable(text.substr(0, end), limit);
    out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return text.empty() ? out : out + "...\n";
}

std::string grouped(std::uint64_t number) {
  std::string s = std::to_string(number);
  for (int at = static_cast<int>(s.size()) - 3; at > 0; at -= 3)
    s.insert(static_cast<std::size_t>(at), "\u00A0");
  return s;
}

mstch::array FindingNodes::all() {
  mstch::array nodes;
  for (const Finding& f : result_.findings) {
    if (nodes.size() == k_listed_findings) break;
    nodes.push_back(node(f, nodes.size() + 1));
  }
  return nodes;
}

mstch::map FindingNodes::node(const Finding& f, std::size_t index) {
  mstch::array trace;
  for (const std::string& line : f.trace)
    trace.push_back(mstch::map{{"text", printable_lines(line, k_finding_text_limit)}});
  const std::string first_case = f.case_ids.empty() ? std::string() : f.case_ids.front();
  const std::string purpose = purpose_of(first_case);
  mstch::map node{{"index", std::to_string(index)},
                  {"verdict", printable(f.verdict, 200)},
                  {"detail", printable(f.detail, 200)},
                  {"letter", std::string(1, severity_letter(f.severity))},
                  {"message", printable_lines(f.message, k_finding_text_limit)},
                  {"hint", printable_lines(f.hint, k_finding_text_limit)},
                  {"has_hint", !f.hint.empty()},
                  {"count", grouped(f.count)},
                  {"shown_by", grouped(f.case_ids.size())},
                  {"first_case", printable(first_case, 200)},
                  {"purpose", purpose},
                  {"has_purpose", !purpose.empty()},
                  {"trace", trace},
                  {"has_trace", !trace.empty()}};
  add_examples(node, f);
  return node;
}

std::string FindingNodes::purpose_of(const std::string& case_id) const {
  const auto found = std::ranges::find(result_.cases, case_id, &CaseResult::id);
  return found == result_.cases.end() ? std::string() : printable(found->purpose, 500);
}

std::string FindingNodes::kind(const std::string& kind) const {
  if (kind == "extra") return words_("too many");
  if (kind == "owner") return words_("wrong polygon");
  if (kind == "depth") return words_("wrong depth");
  if (kind == "colour") return words_("wrong colour");
  return words_(kind);
}

void FindingNodes::add_examples(mstch::map& node, const Finding& f) {
  if (f.examples.empty()) return;
  const Example& e = f.examples.front();
  // Without a file of its own an example is repeated by its case.
  std::string command = e.command;
  if (command.empty() && !e.from_case.empty() && !result_.run.command.empty() &&
      result_.run.command.find(" --case ") == std::string::npos)
    command = result_.run.command + " --case '" + e.from_case + "'";
  node["command"] = printable(command, k_finding_text_limit);
  node["has_command"] = !command.empty();
  if (used_ > k_page_budget) {
    ++left_out_;
    return;
  }
  used_ += std::min(e.flat.size(), k_finding_text_limit) + k_tables_size;
  node["flat"] = printable_lines(e.flat, k_finding_text_limit);
  node["has_flat"] = !e.flat.empty();
  node["pixels"] = pixel_nodes(e);
  node["has_pixels"] = !e.pixels.empty();
  const bool has_row = story_polygon(e) >= 0;
  node["has_row"] = has_row;
  if (has_row) node["row"] = row_node(e);
  mstch::array pictures;
  for (const Example& one : f.examples) {
    if (add_picture(pictures, one) && &one == &e) {
      const std::string svg =
          lattice_svg(e, has_row ? e.pixels.front().y : -1, words_("expected and delivered pixels"));
      used_ += svg.size();
      node["svg"] = svg;
      node["has_svg"] = !svg.empty();
    }
  }
  node["pictures"] = pictures;
}

bool FindingNodes::add_picture(mstch::array& pictures, const Example& e) {
  const std::string expected = png_data_url(e.expected), got = png_data_url(e.got);
  if (expected.empty() || got.empty()) return false;
  const std::string difference = png_data_url(difference_picture(e));
  nlohmann::ordered_json data = viewer_data(e);
  const std::size_t size = expected.size() + got.size() + difference.size() + data.dump().size();
  if (used_ + size > k_page_budget) {
    ++left_out_;
    return false;
  }
  used_ += size;
  pictures.push_back(mstch::map{{"number", std::to_string(viewer_.size())},
                                {"expected_png", expected},
                                {"got_png", got},
                                {"difference_png", difference},
                                {"from", pictures.empty() ? std::string() : printable(e.from_case, 200)}});
  viewer_.push_back(std::move(data));
  return true;
}

/// The first wrong row: crossings as fractions, and what decides the first wrong pixel.
mstch::map FindingNodes::row_node(const Example& e) const {
  const TestPolygon& polygon = e.polygons[static_cast<std::size_t>(story_polygon(e))];
  const WrongPixel& first = e.pixels.front();
  const std::vector<Crossing> row = crossings(polygon, first.y);
  mstch::array crossing_nodes, sums;
  for (const Crossing& c : row) {
    crossing_nodes.push_back(
        mstch::map{{"x", "x = " + fraction(c.numerator, c.denominator)}, {"edge", edge_text(c)}});
    if (sums.size() == k_listed_sums) continue;
    const EdgeSum sum = edge_sum(c, first.x, first.y);
    sums.push_back(mstch::map{{"sum", edge_text(c) + ": " + sum.text}, {"counts", sum.value >= 0}});
  }
  return {{"y", first.y},
          {"px", first.x},
          {"sums", sums},
          {"inequality", !sums.empty()},
          {"none", row.empty()},
          {"crossings", crossing_nodes},
          {"steps", step_nodes(e, polygon)}};
}

/// The parity count that decides each pixel near the first wrong one.
mstch::array FindingNodes::step_nodes(const Example& e, const TestPolygon& polygon) const {
  const int y = e.pixels.front().y;
  const std::vector<Crossing> row = crossings(polygon, y);
  const int first = std::max(0, e.pixels.front().x - 6), widest = std::min(e.frame.x - 1, first + 15);
  // Behind the last crossing and the last wrong pixel nothing happens any more.
  int last = first + 1;
  if (!row.empty())
    last = std::max<int>(last, static_cast<int>(row.back().numerator / row.back().denominator) + 2);
  for (const WrongPixel& p : e.pixels) last = p.y == y ? std::max(last, p.x + 1) : last;
  last = std::min(last, widest);
  mstch::array steps;
  for (int x = first; x <= last; ++x) {
    const int count = crossings_up_to(row, x);
    const auto wrong =
        std::ranges::find_if(e.pixels, [&](const WrongPixel& p) { return p.x == x && p.y == y; });
    const bool bad = wrong != e.pixels.end();
    steps.push_back(mstch::map{{"x", x},
                               {"count", count},
                               {"inside", words_(count % 2 == 1 ? "inside" : "outside")},
                               {"wrong", bad},
                               {"kind", bad ? kind(wrong->kind) : std::string()}});
  }
  return steps;
}

mstch::array FindingNodes::pixel_nodes(const Example& e) const {
  mstch::array nodes;
  for (const WrongPixel& p : e.pixels) {
    if (nodes.size() == k_listed_pixels) break;
    std::string values;
    for (const ExactValue& v : p.values) {
      values +=
          fmt::format("{}{} = {}", values.empty() ? "" : "; ", v.name, fraction(v.numerator, v.denominator));
      if (v.got) values += fmt::format(", {} {}", words_("yours"), *v.got);
    }
    nodes.push_back(
        mstch::map{{"at", fmt::format("({}, {})", p.x, p.y)},
                   {"kind", kind(p.kind)},
                   {"expected", fmt::format("{} {} {}", p.expected[0], p.expected[1], p.expected[2])},
                   {"got", fmt::format("{} {} {}", p.got[0], p.got[1], p.got[2])},
                   {"values", values}});
  }
  return nodes;
}

}  // namespace farop::conformance_report
