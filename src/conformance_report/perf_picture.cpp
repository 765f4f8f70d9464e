// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/perf_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace farop::conformance_report {
namespace {

// Of the drawing, in units of the SVG; labels stand outside of it.
constexpr double k_width = 100, k_height = 60;

/// From values > 0 to 0..length.
class LogScale {
 public:
  LogScale(double low, double high, double length)
      : low_(std::log10(low)), span_(std::max(std::log10(high) - std::log10(low), 1e-3)), length_(length) {}
  double operator()(double value) const { return (std::log10(value) - low_) / span_ * length_; }

 private:
  double low_, span_, length_;
};

bool drawable(double size, double seconds) {
  return std::isfinite(size) && std::isfinite(seconds) && size > 0 && seconds > 0;
}

std::vector<std::pair<double, double>> points(const std::vector<double>& sizes,
                                              const std::vector<double>& seconds) {
  std::vector<std::pair<double, double>> list;
  for (std::size_t i = 0; i < std::min(sizes.size(), seconds.size()); ++i) {
    if (drawable(sizes[i], seconds[i])) list.emplace_back(sizes[i], seconds[i]);
  }
  return list;
}

std::string seconds_text(double s) {
  return s < 1e-3 ? fmt::format("{:.3g} \u00B5s", s * 1e6)
         : s < 1  ? fmt::format("{:.3g} ms", s * 1e3)
                  : fmt::format("{:.3g} s", s);
}

std::string curve(const std::vector<std::pair<double, double>>& list, const LogScale& x, const LogScale& y,
                  const char* name) {
  if (list.empty()) return "";
  std::string svg = fmt::format("<polyline class=\"{}\" points=\"", name), dots;
  for (const auto& [size, seconds] : list) {
    svg += fmt::format("{:.2f},{:.2f} ", x(size), k_height - y(seconds));
    dots += fmt::format("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"1.2\"/>", name, x(size),
                        k_height - y(seconds));
  }
  return svg + "\"/>" + dots;
}

}  // namespace

std::string perf_svg(const conformance::PerfResult& perf, const std::string& title) {
  const auto mine = points(perf.sizes, perf.seconds), reference = points(perf.sizes, perf.reference_seconds);
  if (mine.size() < 2) return "";
  double left = mine.front().first, right = left, low = mine.front().second, high = low;
  for (const auto* list : {&mine, &reference}) {
    for (const auto& [size, seconds] : *list) {
      left = std::min(left, size), right = std::max(right, size);
      low = std::min(low, seconds), high = std::max(high, seconds);
    }
  }
  const LogScale x(left, right, k_width), y(low, high, k_height);
  std::string svg =
      fmt::format("<svg class=\"curve\" role=\"img\" aria-label=\"{}\" viewBox=\"-22 -4 128 74\">", title);
  svg += fmt::format("<path class=\"frame\" d=\"M0 0h{0}v{1}h-{0}z\"/>", k_width, k_height);
  svg += curve(reference, x, y, "reference") + curve(mine, x, y, "mine");
  for (const double size : {left, right})
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\">{:.4g}</text>", x(size), k_height + 6, size);
  for (const double seconds : {low, high})
    svg += fmt::format("<text class=\"time\" x=\"-1.5\" y=\"{:.1f}\">{}</text>",
                       k_height - y(seconds) + (seconds == low ? 0 : 3), seconds_text(seconds));
  return svg + "</svg>";
}

std::string what_grows(const std::string& name) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> k_measures = {
      {{"fill", "area of one polygon"},
       {"setup", "number of small polygons"},
       {"resolution", "size of the frame"},
       {"vertices", "corners of one polygon"},
       {"depth", "layers"},
       {"active", "edges that cross one row"}}};
  const auto* const found = std::ranges::find_if(k_measures, [&](const auto& m) { return name == m.first; });
  return found == k_measures.end() ? name : found->second;
}

}  // namespace farop::conformance_report
