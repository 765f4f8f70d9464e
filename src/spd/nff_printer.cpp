// SPDX-License-Identifier: GPL-3.0-or-later
#include "spd/nff_printer.h"

#include <fmt/format.h>

#include <charconv>
#include <vector>

namespace farop {
namespace {

constexpr std::size_t k_block_bytes = std::size_t{1} << 16;
constexpr std::size_t k_longest_number = 13;  // -1.23457e-308
constexpr double k_same_corner = 1e-6;

/// Six significant digits, what printf's %g writes in the C locale; returns the end.
char* print_number(char* at, double value) {
  return std::to_chars(at, at + k_longest_number, value, std::chars_format::general, 6).ptr;
}

}  // namespace

CornerLine::CornerLine(const V3d& position) {
  char* at = chars_.data();
  for (const double value : {position.x, position.y, position.z}) {
    at = print_number(at, value);
    *at++ = ' ';
  }
  at[-1] = '\n';
  size_ = static_cast<std::size_t>(at - chars_.data());
}

NffPrinter::NffPrinter(const SceneForm& form, std::uint64_t total_objects, const TextFunction& out,
                       const ProgressFunction& progress)
    : form_(form), total_objects_(total_objects), out_(out), progress_(progress) {
  text_.reserve(k_block_bytes + k_block_bytes / 4);
}

void NffPrinter::background(const Rgb& color) {
  line("b", {color.r, color.g, color.b});
}

void NffPrinter::view(const PrintedView& view) {
  text_ += "v\n";
  line("from", {view.from.x, view.from.y, view.from.z});
  line("at", {view.at.x, view.at.y, view.at.z});
  line("up", {view.up.x, view.up.y, view.up.z});
  line("angle", {view.angle});
  line("hither", {view.hither});
  text_ += fmt::format("resolution {} {}\n", view.columns, view.rows);
}

void NffPrinter::light(const V3d& position) {
  line("l", {position.x, position.y, position.z});
}

void NffPrinter::fill(const Material& m) {
  line("f", {m.color.r, m.color.g, m.color.b, m.kd, m.ks, m.shine, m.transmittance, m.refraction});
}

void NffPrinter::sphere(const Sphere& sphere) {
  if (form_.tessellate) {
    farop::tessellate(sphere, form_.resolution, [this](const auto& triangle) { patch(triangle); });
    return;
  }
  line("s", {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius});
  end_object();
}

void NffPrinter::cone(const Cone& cone) {
  if (form_.tessellate) {
    farop::tessellate(cone, form_.resolution, [this](const auto& triangle) { patch(triangle); });
    return;
  }
  line("c", {cone.base.x, cone.base.y, cone.base.z, cone.base_radius,  //
             cone.apex.x, cone.apex.y, cone.apex.z, cone.apex_radius});
  end_object();
}

void NffPrinter::polygon(std::span<const V3d> corners) {
  std::vector<V3d> kept(corners.begin(), corners.end());
  for (std::size_t i = 0; i < kept.size();) {
    const V3d& next = kept[(i + 1) % kept.size()];
    if (kept.size() > 1 && (next - kept[i]).length() < k_same_corner)
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
  if (kept.size() < 3) return;
  begin_polygon(kept.size());
  for (const V3d& position : kept) corner(CornerLine(position));
  end_polygon();
}

void NffPrinter::patch(const TessellationCorner (&triangle)[3]) {
  text_ += "pp 3\n";
  for (const auto& [p, n] : triangle) line("", {p.x, p.y, p.z, n.x, n.y, n.z});
  end_object();
}

void NffPrinter::begin_polygon(std::size_t corners) {
  text_.append("p ").append(fmt::format_int(corners).c_str()) += '\n';
}

void NffPrinter::triangle(const CornerLine& a, const CornerLine& b, const CornerLine& c) {
  begin_polygon(3);
  for (const CornerLine* line : {&a, &b, &c}) corner(*line);
  end_polygon();
}

void NffPrinter::line(std::string_view keyword, std::initializer_list<double> values) {
  text_ += keyword;
  bool separate = !keyword.empty();
  for (const double value : values) {
    if (separate) text_ += ' ';
    separate = true;
    char digits[k_longest_number];
    text_.append(digits, print_number(digits, value));
  }
  text_ += '\n';
}

void NffPrinter::end_object() {
  ++objects_;
  if (text_.size() >= k_block_bytes) finish();
}

void NffPrinter::finish() {
  if (!text_.empty()) out_(text_);
  text_.clear();
  if (progress_) progress_(objects_, total_objects_);
}

}  // namespace farop
