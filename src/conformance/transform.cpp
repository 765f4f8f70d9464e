// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/transform.h"

#include <fmt/format.h>

namespace farop::conformance {

Framebuffer Transform::undo(const Framebuffer& picture, const Color& background) const {
  if (verdict.empty()) return picture;
  Framebuffer out = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      int from_x = transpose ? y : x, from_y = transpose ? x : y;
      if (flip_x) from_x = picture.width - 1 - from_x;
      if (flip_y) from_y = picture.height - 1 - from_y;
      from_x += shift_x, from_y += shift_y;
      Color c = background;
      if (from_x >= 0 && from_x < picture.width && from_y >= 0 && from_y < picture.height) {
        const std::uint8_t* p = &picture.rgb[3 * picture.pixel(from_x, from_y)];
        c = {p[0], p[1], p[2]};
        if (c != background) c = {p[channels[0]], p[channels[1]], p[channels[2]]};
      }
      for (std::size_t k = 0; k < 3; ++k) out.rgb[3 * out.pixel(x, y) + k] = c[k];
    }
  }
  return out;
}

std::vector<Transform> whole_frame_transforms() {
  std::vector<Transform> all;
  const auto add = [&](std::string verdict, std::string message, std::string hint) -> Transform& {
    Transform& t = all.emplace_back();
    t.verdict = std::move(verdict), t.message = std::move(message), t.hint = std::move(hint);
    return t;
  };
  add("frame.flip-y", "pictures are upside down",
      "row 0 is at the bottom: pixel (x, y) is at pixels + y * row_bytes + 3 * x")
      .flip_y = true;
  add("frame.flip-x", "pictures are mirrored", "x grows to the right").flip_x = true;
  add("frame.transposed", "x and y are exchanged", "pixel (x, y) is at pixels + y * row_bytes + 3 * x")
      .transpose = true;
  constexpr std::array<std::array<int, 3>, 5> orders = {
      {{2, 1, 0}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}}};
  for (const auto& order : orders) {
    Transform& t =
        add("frame.channels", "colour channels are exchanged", "a pixel is three bytes: red, green, blue");
    t.channels = order;
    for (const int k : order) t.detail += "rgb"[k];
  }
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      if (x == 0 && y == 0) continue;
      Transform& t = add("frame.shift", fmt::format("everything is displaced by ({}, {})", x, y),
                         "check where rounding happens, and where you index the buffer");
      t.detail = fmt::format("{},{}", x, y);
      t.shift_x = x, t.shift_y = y;
    }
  }
  return all;
}

}  // namespace farop::conformance
