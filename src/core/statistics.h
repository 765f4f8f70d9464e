// SPDX-License-Identifier: GPL-3.0-or-later
// Counters and clocks of a run, one set per stage.
#pragma once

#include <chrono>
#include <cstdint>

namespace farop {

/// Counts of the geometry stage. In every run loaded = back_facing + degenerate + totally_clipped + rendered.
struct PolygonCounts {
  std::uint64_t loaded = 0;
  std::uint64_t back_facing = 0;
  std::uint64_t degenerate = 0;
  std::uint64_t totally_clipped = 0;
  std::uint64_t rendered = 0;
  std::uint64_t partly_clipped = 0;      ///< part of rendered
  std::uint64_t split_to_triangles = 0;  ///< rendered polygons of more than three vertices that were split
  std::uint64_t triangles = 0;           ///< all triangles handed over when triangulating
  std::uint64_t vertices = 0;            ///< polygon corners that were lit and projected

  friend bool operator==(const PolygonCounts&, const PolygonCounts&) = default;
};

/// Seconds of one stage.
struct StageTime {
  double elapsed = 0, user = 0, system = 0;

  StageTime& operator+=(const StageTime& o) {
    elapsed += o.elapsed, user += o.user, system += o.system;
    return *this;
  }
};

/// Adds the time of a stage in slices: start() ... stop() any number of times. CPU time is that of the whole
/// process.
class StageTimer {
 public:
  void start();
  void stop();
  bool ran() const { return ran_; }
  const StageTime& total() const { return total_; }

 private:
  StageTime total_;
  StageTime begun_;
  bool ran_ = false;
};

/// Runs a StageTimer for the length of a block.
class TimedSlice {
 public:
  explicit TimedSlice(StageTimer& timer) : timer_(timer) { timer_.start(); }
  ~TimedSlice() { timer_.stop(); }
  TimedSlice(const TimedSlice&) = delete;
  TimedSlice& operator=(const TimedSlice&) = delete;

 private:
  StageTimer& timer_;
};

/// Largest resident size of this process so far, in bytes.
std::uint64_t peak_memory_bytes();

}  // namespace farop
