// SPDX-License-Identifier: GPL-3.0-or-later
// A picture against what it has to look like, sample by sample.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/expectation.h"
#include "core/framebuffer.h"

namespace farop::conformance {

enum class Wrong : std::uint8_t { missing, extra, owner, color };

struct WrongSample {
  int x = 0, y = 0;
  Wrong kind = Wrong::missing;
  int expected_owner = -1, got_owner = -1;  ///< numbers of polygons; -1 background, -2 nobody's colour
  Color got{};
};

enum class PrecisionAsk : std::uint8_t { normal, nearest, exact };

struct JudgeOptions {
  Color background{};
  /// Samples on some polygon's boundary are not judged: the rasterizer's fill rule is known to be wrong
  /// there.
  bool skip_boundary = false;
  bool free_interpolation = false;
  PrecisionAsk precision = PrecisionAsk::normal;
};

struct Judged {
  std::uint64_t judged = 0, ambiguous = 0;
  std::vector<WrongSample> wrong;
  std::uint64_t drifted = 0;    ///< colours between the two tolerances
  std::uint64_t truncated = 0;  ///< constant colours that came out one less
  double worst_color = 0;       ///< largest error of a right owner's colour
};

Color pixel_at(const Framebuffer& picture, int x, int y);

Judged judge(const Expectation& expected, const Framebuffer& picture, const JudgeOptions& options);

/// The colour to be expected of a polygon at a sample, rounded to nearest.
Color exact_color(const ExactPolygon& polygon, int color_resolution, int x, int y);

/// What a right picture looks like: nearest owner's rounded colours.
Framebuffer ideal_picture(const Expectation& expected, const Color& background);

}  // namespace farop::conformance
