// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance_report/example_data.h"

#include <algorithm>
#include <cstdlib>

#include "core/diagnostics.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;
using Json = nlohmann::ordered_json;

constexpr std::size_t k_most_corners = 20000, k_example_text_limit = 4096;

Json measured_depth(const WrongPixel& p) {
  const auto z = std::ranges::find(p.values, "z", &ExactValue::name);
  return z == p.values.end() || !z->got ? Json(nullptr) : Json(*z->got);
}

}  // namespace

Json viewer_data(const Example& e) {
  Json json{{"w", e.frame.x},
            {"h", e.frame.y},
            {"c", e.frame.color},
            {"case", printable(e.from_case, k_example_text_limit)}};
  Json& polygons = json["polygons"] = Json::array();
  std::size_t corners = 0;
  for (const TestPolygon& polygon : e.polygons) {
    corners += polygon.size();
    if (corners > k_most_corners) break;
    Json list = Json::array();
    for (const ScreenVertex& v : polygon) list.push_back({v.x, v.y, v.z, v.r, v.g, v.b});
    polygons.push_back(std::move(list));
  }
  Json& wrong = json["wrong"] = Json::array();
  for (const WrongPixel& p : e.pixels) wrong.push_back({p.x, p.y, p.kind, measured_depth(p)});
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

Framebuffer difference_picture(const Example& e) {
  if (e.expected.rgb.empty() || e.got.rgb.size() != e.expected.rgb.size()) return {};
  Framebuffer picture{e.expected.width, e.expected.height, {}, {}};
  picture.rgb.resize(e.expected.rgb.size());
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    if (std::equal(&e.got.rgb[i], &e.got.rgb[i] + 3, &e.expected.rgb[i])) continue;
    for (std::size_t c = i; c < i + 3; ++c)
      picture.rgb[c] =
          static_cast<std::uint8_t>(64 + std::min(191, std::abs(int{e.got.rgb[c]} - int{e.expected.rgb[c]})));
  }
  return picture;
}

}  // namespace farop::conformance_report
