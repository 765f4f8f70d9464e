// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace farop {

/// tiled: tiles, vectors, threads. plain: one sample after another, the readable definition of the same
/// picture.
enum class RasterPath : std::uint8_t { tiled, plain };

/// How the internal rasterizer works, never what it draws.
struct RasterTuning {
  RasterPath path = RasterPath::tiled;
  int threads = 0;  ///< at most; 0: as many as the machine gives this process
  int tile_size =
      64;  ///< side of a tile in samples, 8..64; rounded down to whole pixels under super-sampling
  /// Triangles wait for the end of the frame until they take this much; then what is there is drawn.
  std::size_t waiting_bytes = std::size_t{128} << 20;
};

}  // namespace farop
