// SPDX-License-Identifier: GPL-3.0-or-later
// Counters and clocks of a run, one set per stage.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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
  PolygonCounts& operator+=(const PolygonCounts& c) {
    loaded += c.loaded;
    back_facing += c.back_facing;
    degenerate += c.degenerate;
    totally_clipped += c.totally_clipped;
    rendered += c.rendered;
    partly_clipped += c.partly_clipped;
    split_to_triangles += c.split_to_triangles;
    triangles += c.triangles;
    vertices += c.vertices;
    return *this;
  }
};

/// Seconds of one stage. Cycles and instructions in user mode, where the machine lets us count them.
struct StageTime {
  double elapsed = 0, user = 0, system = 0;
  std::optional<std::uint64_t> cycles, instructions;

  StageTime& operator+=(const StageTime& o);
};

/// The clocks and counters as they stand: elapsed on the steady clock, the others of the whole process.
StageTime read_clocks();
/// From one reading to a later one.
StageTime time_between(const StageTime& begin, const StageTime& end);

/// What goes on beside each other in a picture of a run.
enum class TraceTrack { stages = 1, rasterizer = 2 };

/// Slices of stages in the order they ended, for a picture of the run along its time.
class TraceLog {
 public:
  struct Slice {
    const char* stage;
    double begin, end;  ///< seconds on the steady clock
    TraceTrack track = TraceTrack::stages;
  };
  /// Beyond so many slices only the number of those left out grows: some 32 MB at most.
  static constexpr std::size_t k_max_slices = 1'000'000;

  void add(const Slice& slice) {
    if (slices_.size() < k_max_slices) {
      slices_.push_back(slice);
    } else {
      ++left_out_;
    }
  }
  const std::vector<Slice>& slices() const { return slices_; }
  std::uint64_t left_out() const { return left_out_; }

 private:
  std::vector<Slice> slices_;
  std::uint64_t left_out_ = 0;
};

/// Adds the time of a stage in slices: start() ... stop() any number of times. CPU time is that of the whole
/// process.
class StageTimer {
 public:
  /// From now on every slice also goes to `log`, under this name; both must outlive the timer.
  void trace_to(TraceLog* log, const char* stage, TraceTrack track = TraceTrack::stages) {
    log_ = log, stage_ = stage, track_ = track;
  }
  void start();
  void stop();
  bool ran() const { return ran_; }
  const StageTime& total() const { return total_; }

 private:
  StageTime total_;
  StageTime begun_;
  bool ran_ = false;
  TraceLog* log_ = nullptr;
  const char* stage_ = "";
  TraceTrack track_ = TraceTrack::stages;
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
