// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/judge.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace farop::conformance {
namespace {

enum class Match : std::uint8_t { within, drifted, no };

/// One channel of a polygon at a sample, against what was delivered (0..255).
class ChannelJudge {
 public:
  ChannelJudge(const ExactPolygon& polygon, int color_resolution, const JudgeOptions& options)
      : polygon_(polygon), scale_(255), unit_(color_resolution - 1), options_(options) {}

  Match match(Attribute a, int x, int y, int got) {
    const auto [low, high] = polygon_.range(a);
    if (const auto& plane = polygon_.plane(a); plane)
      return compare(plane->at(x, y), polygon_.tolerance(a), got);
    // Values on no plane: the scan line's or those of any triangulation; never beyond the corners'.
    const Tolerance& tolerance = polygon_.tolerance(a);
    const Rational out{Wide{got} * unit_, scale_};
    if (out < Rational{low, 1} - tolerance.bound || Rational{high, 1} + tolerance.bound < out)
      return Match::no;
    if (!options_.free_interpolation || polygon_.corners.size() != 4) return Match::within;
    const auto row = scan_line_value(polygon_.corners, a, x, y);
    // On edges that belong to it under other rules only, the scan line has no value: the range has to do.
    if (!row || compare(*row, tolerance, got) != Match::no) return Match::within;
    for (std::size_t first = 0; first < 2; ++first) {
      for (std::size_t half = 0; half < 2; ++half) {
        const auto corner_at = [&](std::size_t i) { return polygon_.corners[(first + i) % 4]; };
        const TestPolygon t = {corner_at(0), corner_at(1 + half), corner_at(2 + half)};
        const auto plane = plane_through(t, a);
        if (!plane || !inside(t, x, y)) continue;
        if (compare(plane->at(x, y), tolerance_of(t, *plane), got) != Match::no) return Match::within;
      }
    }
    return Match::no;
  }

  double worst = 0;
  bool one_less = false;

 private:
  static bool inside(const TestPolygon& t, int x, int y) {
    int sides = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const ScreenVertex &a = t[i], &b = t[(i + 1) % 3];
      const std::int64_t side = std::int64_t{b.x - a.x} * (y - a.y) - std::int64_t{b.y - a.y} * (x - a.x);
      sides |= side > 0 ? 1 : side < 0 ? 2 : 0;
    }
    return sides != 3;
  }

  Match compare(const Rational& value, const Tolerance& tolerance, int got) {
    // In units of the flat file: got * (CRES-1) / 255. A picture of 255 levels rounds once more.
    const Rational out{Wide{got} * unit_, scale_};
    const Rational error = absolute(out - value);
    const double size = error.value();
    Rational near = tolerance.unremarkable, far = tolerance.bound;
    if (unit_ != scale_) near = near + Rational{unit_, 2 * scale_}, far = far + Rational{unit_, 2 * scale_};
    if (options_.precision != PrecisionAsk::normal) {
      near = near - Rational{1, 2};
      far = near;
    }
    if (!(error <= far)) return Match::no;
    worst = std::max(worst, size);
    if (value.denominator == 1 && value.numerator == got + 1) one_less = true;
    return error <= near ? Match::within : Match::drifted;
  }

  const ExactPolygon& polygon_;
  Wide scale_, unit_;
  const JudgeOptions& options_;
};

struct ColorMatch {
  Match match = Match::no;
  double worst = 0;
  bool one_less = false;
};

ColorMatch color_match(const ExactPolygon& polygon, int color_resolution, const JudgeOptions& options, int x,
                       int y, const Color& got) {
  ChannelJudge judge(polygon, color_resolution, options);
  ColorMatch result{Match::within, 0, false};
  bool constant = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const Attribute a = k_channels[c];
    const Match match = judge.match(a, x, y, got[c]);
    if (match == Match::no) return {};
    if (match == Match::drifted) result.match = Match::drifted;
    constant = constant && polygon.range(a).first == polygon.range(a).second;
  }
  result.worst = judge.worst;
  result.one_less = constant && judge.one_less;
  return result;
}

}  // namespace

Color pixel_at(const Framebuffer& picture, int x, int y) {
  const std::uint8_t* p = &picture.rgb[3 * picture.pixel(x, y)];
  return {p[0], p[1], p[2]};
}

Color exact_color(const ExactPolygon& polygon, int color_resolution, int x, int y) {
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& plane = polygon.plane(k_channels[c]);
    const auto row = plane ? std::nullopt : scan_line_value(polygon.corners, k_channels[c], x, y);
    const double value = plane ? plane->at(x, y).value() : row ? row->value() : 0;
    color[c] = static_cast<std::uint8_t>(
        std::clamp(std::floor(value * 255 / (color_resolution - 1) + 0.5), 0.0, 255.0));
  }
  return color;
}

Judged judge(const Expectation& expected, const Framebuffer& picture, const JudgeOptions& options) {
  Judged result;
  const Resolution& frame = expected.drawing().frame;
  const auto& polygons = expected.polygons();
  for (int y = 0; y < frame.y; ++y) {
    for (int x = 0; x < frame.x; ++x) {
      if (options.skip_boundary && expected.on_boundary(x, y)) continue;
      const Color got = pixel_at(picture, x, y);
      const auto covering = expected.covering(x, y);
      const auto matches = [&](std::uint32_t k) {
        return color_match(polygons[k], frame.color, options, x, y, got);
      };
      const auto owner_of = [&]() -> int {
        if (got == options.background) return -1;
        for (const std::uint32_t k : covering) {
          if (matches(k).match != Match::no) return static_cast<int>(k);
        }
        for (std::uint32_t k = 0; k < polygons.size() && polygons.size() <= 64; ++k) {
          const bool constant = std::ranges::all_of(polygons[k].corners, [&](const ScreenVertex& v) {
            return v.r == got[0] && v.g == got[1] && v.b == got[2];
          });
          if (constant) return static_cast<int>(k);
        }
        return -2;
      };
      ++result.judged;
      if (covering.empty()) {
        if (got != options.background) result.wrong.push_back({x, y, Wrong::extra, -1, owner_of(), got});
        continue;
      }
      const bool alone = covering.size() == 1;
      const std::vector<std::uint32_t> admissible =
          alone ? std::vector<std::uint32_t>{covering[0]} : expected.admissible(x, y);
      if (admissible.size() > 1) ++result.ambiguous;
      ColorMatch best;
      for (const std::uint32_t k : admissible) {
        const ColorMatch match = matches(k);
        if (match.match == Match::no) continue;
        if (best.match == Match::no || match.worst < best.worst) best = match;
      }
      if (best.match != Match::no) {
        result.worst_color = std::max(result.worst_color, best.worst);
        if (best.match == Match::drifted) ++result.drifted;
        if (best.one_less) ++result.truncated;
        continue;
      }
      const int wanted = alone ? static_cast<int>(covering[0]) : expected.nearest(x, y);
      const int owner = owner_of();
      const Wrong kind = owner == -1                     ? Wrong::missing
                         : owner >= 0 && owner != wanted ? Wrong::owner
                                                         : Wrong::color;
      result.wrong.push_back({x, y, kind, wanted, owner, got});
    }
  }
  return result;
}

Framebuffer ideal_picture(const Expectation& expected, const Color& background) {
  const Resolution& frame = expected.drawing().frame;
  Framebuffer picture;
  picture.width = frame.x, picture.height = frame.y;
  for (int y = 0; y < frame.y; ++y) {
    for (int x = 0; x < frame.x; ++x) {
      const int k = expected.nearest(x, y);
      const Color c = k < 0
                          ? background
                          : exact_color(expected.polygons()[static_cast<std::size_t>(k)], frame.color, x, y);
      picture.rgb.insert(picture.rgb.end(), c.begin(), c.end());
    }
  }
  return picture;
}

}  // namespace farop::conformance
