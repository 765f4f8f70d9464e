// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/lattice_picture.h"

#include <fmt/format.h>

#include <algorithm>

namespace farop::conformance_report {
namespace {

using namespace conformance;

constexpr int k_largest = 40;  // pixels a side: more cannot be told apart on a page

struct Part {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // both ends included
};

void shorten(int& low, int& high, int size) {
  low = std::max(low, 0), high = std::min({high, size - 1, low + k_largest - 1});
}

/// Wrong pixels and their polygons; where that is too much, the lowest of the wrong pixels.
Part shown_part(const Example& e) {
  Part part{e.frame.x, e.frame.y, -1, -1};
  const auto include = [&part](int x, int y) {
    part.x0 = std::min(part.x0, x), part.y0 = std::min(part.y0, y);
    part.x1 = std::max(part.x1, x), part.y1 = std::max(part.y1, y);
  };
  for (const WrongPixel& p : e.pixels) include(p.x, p.y);
  const Part pixels = part;
  for (const TestPolygon& polygon : e.polygons) {
    for (const ScreenVertex& v : polygon)
      include(std::clamp(v.x, 0, e.frame.x - 1), std::clamp(v.y, 0, e.frame.y - 1));
  }
  if (part.x1 < 0) part = {0, 0, e.frame.x - 1, e.frame.y - 1};
  if (pixels.x1 >= 0 && (part.x1 - part.x0 >= k_largest - 2 || part.y1 - part.y0 >= k_largest - 2)) {
    part.x0 = std::max(part.x0, pixels.x0 - 4), part.y0 = std::max(part.y0, pixels.y0 - 4);
  }
  part.x0 -= 1, part.y0 -= 1, part.x1 += 1, part.y1 += 1;
  shorten(part.x0, part.x1, e.frame.x);
  shorten(part.y0, part.y1, e.frame.y);
  return part;
}

/// Squares of the samples where `covered` says so, as runs of a row. y of the SVG grows downwards: -y.
template <class Covered>
std::string squares(const Part& part, const Covered& covered) {
  std::string path;
  for (int y = part.y0; y <= part.y1; ++y) {
    for (int x = part.x0; x <= part.x1; ++x) {
      if (!covered(x, y)) continue;
      int end = x;
      while (end <= part.x1 && covered(end, y)) ++end;
      path += fmt::format("M{} {}h{}v1h-{}z", x - 0.5, -y - 0.5, end - x, end - x);
      x = end;
    }
  }
  return path;
}

std::string mark(const WrongPixel& p) {
  const int x = p.x, y = -p.y;
  if (p.kind == "missing")
    return fmt::format("<path class=\"missing\" d=\"M{} {}l.34 .34l-.34 .34l-.34-.34z\"/>", x, y - 0.34);
  if (p.kind == "extra") {
    return fmt::format(
        "<g class=\"extra\"><path d=\"M{0} {1}h.8v.8h-.8z\"/><path class=\"cross\" d=\"M{2} {3}l.5 "
        ".5m0-.5l-.5 "
        ".5\"/></g>",
        x - 0.4, y - 0.4, x - 0.25, y - 0.25);
  }
  return fmt::format("<path class=\"other\" d=\"M{} {}h.84v.84z\"/>", x - 0.42, y - 0.42);
}

}  // namespace

std::string lattice_svg(const Example& e, int row, const std::string& title) {
  if (e.expected.rgb.empty() || e.expected.width != e.frame.x || e.expected.height != e.frame.y) return "";
  const Part part = shown_part(e);
  if (part.x1 < part.x0 || part.y1 < part.y0) return "";
  const auto drawn = [&](const Framebuffer& picture, int x, int y) {
    const std::size_t at = 3 * picture.pixel(x, y);
    return at + 2 < picture.rgb.size() &&
           (picture.rgb[at] != e.background[0] || picture.rgb[at + 1] != e.background[1] ||
            picture.rgb[at + 2] != e.background[2]);
  };
  const int width = part.x1 - part.x0 + 1, height = part.y1 - part.y0 + 1;
  std::string svg =
      fmt::format("<svg class=\"lattice\" role=\"img\" aria-label=\"{}\" viewBox=\"{} {} {} {}\">", title,
                  part.x0 - 1.8, -part.y1 - 0.6, width + 1.4, height + 1.1);
  svg += fmt::format("<path class=\"expected\" d=\"{}\"/>",
                     squares(part, [&](int x, int y) { return drawn(e.expected, x, y); }));
  svg += fmt::format("<path class=\"got\" d=\"{}\"/>",
                     squares(part, [&](int x, int y) { return drawn(e.got, x, y); }));
  std::string grid;
  for (int x = part.x0; x <= part.x1 + 1; ++x)
    grid += fmt::format("M{} {}v{}", x - 0.5, -part.y1 - 0.5, height);
  for (int y = part.y0 - 1; y <= part.y1; ++y)
    grid += fmt::format("M{} {}h{}", part.x0 - 0.5, -y - 0.5, width);
  svg += fmt::format("<path class=\"grid\" d=\"{}\"/>", grid);
  if (row >= part.y0 && row <= part.y1)
    svg += fmt::format("<rect class=\"row\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"1\"/>", part.x0 - 0.5,
                       -row - 0.5, width);
  std::size_t corners = 0;
  for (const TestPolygon& polygon : e.polygons) {
    corners += polygon.size();
    if (corners > 4096 || polygon.empty()) break;
    svg += "<polygon class=\"outline\" points=\"";
    for (const ScreenVertex& v : polygon) svg += fmt::format("{},{} ", v.x, -std::int64_t{v.y});
    svg += "\"/>";
  }
  for (const WrongPixel& p : e.pixels) {
    if (p.x >= part.x0 && p.x <= part.x1 && p.y >= part.y0 && p.y <= part.y1) svg += mark(p);
  }
  const int step = std::max(width, height) > 16 ? 5 : 1;
  for (int x = part.x0; x <= part.x1; ++x) {
    if (x % step == 0) svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", x, -part.y0 + 1.1, x);
  }
  for (int y = part.y0; y <= part.y1; ++y) {
    if (y % step == 0) svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", part.x0 - 0.95, -y + 0.18, y);
  }
  return svg + "</svg>";
}

}  // namespace farop::conformance_report
