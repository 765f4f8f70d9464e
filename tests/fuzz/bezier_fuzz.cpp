// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes, read as a description of Bezier patches or curves, end in a shape of the size that the
// description says or in exactly one error.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "parse_sipp/bezier_file.h"

namespace farop::sipp {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "violated: %s\n", what);
  std::abort();
}

bool finite(const V3d& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace
}  // namespace farop::sipp

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace farop;
  using namespace farop::sipp;
  WordReader reader({reinterpret_cast<const char*>(data), size}, "fuzz.bez");
  DiagnosticList list;
  const auto description = read_bezier_file(reader, list);
  require(list.count(Severity::error) == (description ? 0 : 1), "a description, or one error");
  for (const Diagnostic& d : list.items) require(!to_text(d).empty(), "every report has a text");
  if (!description) return 0;
  const std::size_t corners = description->curves ? 4 : 16;
  require(description->indices.size() % corners == 0, "whole patches and curves");
  for (const int i : description->indices) {
    require(i >= 0 && static_cast<std::size_t>(i) < description->points.size(), "indices of points");
  }
  constexpr int resolution = 3;
  ShapeLook look;
  look.max_polygons = 20'000;
  try {
    const auto object = bezier(*description, resolution, look);
    if (!object) return 0;
    std::size_t polygons = 0;
    for (const auto& surface : object->surfaces) {
      polygons += surface->polygons.size();
      for (const V3d& p : surface->positions) require(finite(p), "finite positions");
      for (const V3d& n : surface->averaged_normals) require(finite(n), "finite normals");
    }
    const std::size_t each = description->curves ? 4 * resolution * resolution : resolution * resolution;
    require(polygons == description->indices.size() / corners * each, "as many polygons as the table says");
  } catch (const Error&) {  // too many polygons
  }
  return 0;
}
