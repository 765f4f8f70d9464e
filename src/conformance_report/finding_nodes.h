// SPDX-License-Identifier: GPL-3.0-or-later
// The findings of a result as nodes of the page's template.
#pragma once

#include <mstch/mstch.hpp>
#include <nlohmann/json.hpp>

#include "conformance/result.h"
#include "conformance_report/catalogue.h"

namespace farop::conformance_report {

/// Made one after the other; what all of them may take together is limited, so that the page can be mailed.
class FindingNodes {
 public:
  /// `result` must outlive it.
  FindingNodes(const conformance::CheckResult& result, const Catalogue& words)
      : result_(result), words_(words) {}

  mstch::array all();
  /// After all(): data of the pictures, in the order of their numbers on the page.
  const nlohmann::ordered_json& viewer() const { return viewer_; }
  /// Pictures that are not on the page for want of room.
  std::size_t left_out() const { return left_out_; }

 private:
  mstch::map node(const conformance::Finding& finding, std::size_t index);
  void add_examples(mstch::map& node, const conformance::Finding& finding);
  bool add_picture(mstch::array& pictures, const conformance::Example& example);
  mstch::map row_node(const conformance::Example& example) const;
  mstch::array step_nodes(const conformance::Example& example, const conformance::TestPolygon& polygon) const;
  mstch::array pixel_nodes(const conformance::Example& example) const;
  std::string kind(const std::string& kind) const;
  std::string purpose_of(const std::string& case_id) const;

  const conformance::CheckResult& result_;
  const Catalogue& words_;
  nlohmann::ordered_json viewer_ = nlohmann::ordered_json::array();
  std::size_t used_ = 0, left_out_ = 0;
};

/// Lines of any text, safe to print, cut where they get too many. Not escaped.
std::string printable_lines(std::string_view text, std::size_t limit);
/// 12 345, with blanks that do not break.
std::string grouped(std::uint64_t number);

}  // namespace farop::conformance_report
