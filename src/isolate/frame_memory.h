// SPDX-License-Identifier: GPL-3.0-or-later
// The memory of a frame, with random bytes wherever the rasterizer must not write.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "isolate/isolation.h"
#include "isolate/shared_memory.h"
#include "plugin/plugin_rasterizer.h"

namespace farop::isolate {

/// Where a byte that lies `offset` bytes from the first pixel would be: "pixel (3, 12), 2 rows below the
/// frame".
std::string place_of(std::int64_t offset, const farop_frame& frame);
/// Verdict of writing there: oob.write-before, -stride, -after; empty: it is a pixel of the frame.
std::string write_verdict(std::int64_t offset, const farop_frame& frame);

/// Memory of one frame at a time. Two take turns, so that each side of the frame has its turn to touch the
/// no-man's-land that the runner maps around the memory; on the other side is an apron of random bytes.
class FrameMemory {
 public:
  enum class Touches { end, begin };
  FrameMemory(Touches touches, std::uint64_t seed) : touches_(touches), seed_(seed) {}

  /// Makes room for `frame` (row_bytes is set here), with random bytes around and between its rows; the
  /// runner fills in the background. True: the memory is new.
  bool prepare(farop_frame& frame);
  /// For a runner that has not had this memory: what an earlier one may have left in it does not count.
  void distrust() { is_intact_ = false; }
  const SharedMemory& memory() const { return memory_; }
  std::uint64_t offset() const { return offset_; }  ///< of the first pixel
  std::uint64_t bytes() const { return bytes_; }    ///< from the first pixel to the end of the last

  /// Fetches what the rasterizer has drawn; `pixels` of the frame is set to the copy, which lives until the
  /// next prepare(). Findings: what was written beside the pixels, at most one of a kind.
  /// A frame that is never fetched may have spoiled everything: the next prepare() starts from nothing.
  std::vector<PluginFinding> fetch(farop_frame& frame);

 private:
  /// The random bytes from byte `at` of the memory on.
  void make(std::uint64_t at, std::span<std::byte> bytes) const;

  Touches touches_;
  std::uint64_t seed_;
  SharedMemory memory_;
  std::uint64_t offset_ = 0, bytes_ = 0;
  std::pair<std::int32_t, std::int32_t> size_;  ///< of the frame
  bool is_intact_ = false;       ///< the random bytes are there, as they were at the last fetch()
  std::vector<std::byte> sent_;  ///< made once; empty for large frames
  std::vector<std::byte> got_;
};

}  // namespace farop::isolate
