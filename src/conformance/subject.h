// SPDX-License-Identifier: GPL-3.0-or-later
// What is being tested, whatever it is: a library, a program, pictures made elsewhere.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conformance/drawing.h"
#include "core/framebuffer.h"

namespace farop::conformance {

/// What a rasterizer did wrong beside its picture.
struct SubjectFailure {
  std::string verdict;  ///< crash.*, oob.*, limit.*, abi.*, unsupported, skip.*
  std::string message, hint;
  std::optional<std::uint32_t> polygon;
  std::vector<std::string> trace;
  bool warning = false;
};

struct Delivered {
  std::optional<Framebuffer> picture;
  std::optional<SubjectFailure> failure;  ///< then there is no picture
  std::vector<SubjectFailure> remarks;    ///< found beside a picture
  double seconds = 0;                     ///< inside the rasterizer; 0: not known
};

/// One life of a rasterizer. draw() throws Error(surroundings) for what the machine cannot do.
class Subject {
 public:
  virtual ~Subject() = default;
  virtual Delivered draw(const Drawing& drawing) = 0;
};

/// Starts lives.
class SubjectMaker {
 public:
  virtual ~SubjectMaker() = default;
  /// `memory`: 0 as it comes; others fill fresh memory with that byte, where that can be done.
  virtual std::unique_ptr<Subject> make(std::uint8_t memory) const = 0;
  /// With no-man's-land behind the corners of every polygon, which vanish when its call returns: slow.
  virtual std::unique_ptr<Subject> make_guarded() const { return make(0); }
  virtual bool can_guard() const { return false; }
  /// The drawing in the form that the rasterizer gets: as triangles where it wants those.
  virtual Drawing as_given(const Drawing& drawing) const { return drawing; }
  virtual Color background() const { return k_black; }
  /// Pictures come with the time that they took.
  virtual bool timed() const { return false; }
  /// Several lives at a time are possible.
  virtual bool parallel() const { return true; }
  /// Colours have 8 bits whatever the colour resolution.
  virtual bool eight_bit_colors() const { return false; }
  /// Pictures may come with Framebuffer::depth: where one does, depth is read there instead of probed.
  virtual bool may_deliver_depth() const { return false; }

  static constexpr Color k_black{};
};

}  // namespace farop::conformance
