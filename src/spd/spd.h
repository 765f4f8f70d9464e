// SPDX-License-Identifier: GPL-3.0-or-later
// Test scenes that are computed: the Standard Procedural Databases and three closed solids, printed as NFF.
//
// The 13 databases are those of SPD 3.14 (E. Haines, "A Proposal for Standard Graphics Environments", IEEE
// CG&A 7(11), 1987; released as CC0): same entities in the same order, numbers equal to six digits. The
// solids are the test objects of Lenz Cesar and Ferreira de Oliveira's scan-line paper (1995) by face count;
// their dimensions are ours.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/progress.h"

namespace farop {

/// Entities of a scene, by NFF keyword.
struct SpdCounts {
  std::uint64_t polygons = 0;  ///< `p`
  std::uint64_t patches = 0;   ///< `pp`
  std::uint64_t spheres = 0;   ///< `s`
  std::uint64_t cones = 0;     ///< `c`
  std::uint64_t fills = 0;     ///< `f`
  std::uint64_t lights = 0;    ///< `l`

  friend bool operator==(const SpdCounts&, const SpdCounts&) = default;
};

struct SpdSceneInfo {
  std::string_view name;
  std::string_view description;  ///< one line, no final stop
  int default_size = 1;
  int max_size = 1;           ///< sizes run from 1; the largest one still has fewer than 10^12 objects
  bool size_ignored = false;  ///< the scene has one size only; any size >= 1 is taken
};

/// All scenes: the 13 databases, then the solids hollow-cube, solid-torus, solid-cylinder.
std::span<const SpdSceneInfo> spd_scenes();

/// Resolution of `--tessellate` unless given.
constexpr int k_spd_default_resolution = 3;

struct SpdRequest {
  std::string name;
  std::optional<int> size;  ///< nothing: the scene's default
  /// Spheres and cones as `pp` triangles in the same places. No effect on scenes without any.
  bool tessellate = false;
  std::optional<int> resolution;  ///< R of the triangles, 1..k_max_detail; jacks always takes 2
};

/// What write_spd() will print. Throws like it.
SpdCounts spd_counts(const SpdRequest& request);

/// Receives NFF text in blocks of whole entities.
using TextFunction = std::function<void(std::string_view)>;

/// Prints a scene, block by block: memory does not grow with the size. `progress` counts objects (polygons,
/// patches, spheres, cones). What `out` throws passes through. Throws Error(ExitStatus::usage), before any
/// output, for an unknown name, a size below 1 or above max_size, a resolution out of range.
void write_spd(const SpdRequest& request, const TextFunction& out, const ProgressFunction& progress = {});

}  // namespace farop
