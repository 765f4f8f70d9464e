// SPDX-License-Identifier: GPL-3.0-or-later
// Mesa's llvmpipe behind OSMesa: the renderer on a CPU that everybody has.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "triangle_scenes.h"

namespace farop::bench {

/// One picture size, one scene at a time. Window coordinates are handed over as they are: no transformation
/// but the scaling to GL's cube.
class Llvmpipe {
 public:
  /// `threads` 1: all in the calling thread. Only one number of threads a process: Mesa reads it once.
  explicit Llvmpipe(int threads);
  ~Llvmpipe();
  Llvmpipe(const Llvmpipe&) = delete;
  Llvmpipe& operator=(const Llvmpipe&) = delete;

  /// Nothing went wrong, and it is llvmpipe.
  bool works() const;
  const std::string& name() const { return name_; }
  /// Copies the scene into a vertex buffer; not timed.
  void load(const TriangleScene& scene);
  /// Clears, draws the loaded scene with Gouraud shading and depth test, waits until it is done.
  void draw();
  /// r g b a, bottom row first.
  const std::vector<std::uint8_t>& pixels() const { return pixels_; }

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  std::string name_;
  std::vector<std::uint8_t> pixels_;
  int corners_ = 0;
};

}  // namespace farop::bench
