// SPDX-License-Identifier: GPL-3.0-or-later
// A host for the tests: loads a rasterizer into this process, draws pictures with it and watches its manners.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "farop/rasterizer.h"

namespace farop::test {

struct PluginFrame {
  int width = 64, height = 64, subpixel_bits = 0;
  std::int32_t z_far = 65535;
  int padding = 5;  ///< bytes behind every row, filled with a pattern and verified after end_frame()
  std::array<std::uint8_t, 3> background{};
  std::uint32_t max_vertices = 0;  ///< announced to begin_frame(); 0: what the polygons need
};

/// What polygon() is called with. Normals, eye positions and material are never there, as from a flat file;
/// `ids` reach a rasterizer that wants them, unless empty.
struct PluginPolygon {
  std::vector<farop_vertex> corners;
  std::vector<std::uint32_t> ids;  ///< as many as corners, or none
  std::uint32_t flags = 0, surface_id = 0, object_id = 0;
};

/// R, G, B of every pixel; row 0 is the bottom row; no padding.
struct PluginPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  std::array<std::uint8_t, 3> at(int x, int y) const {
    const std::uint8_t* p = &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                      static_cast<std::size_t>(x))];
    return {p[0], p[1], p[2]};
  }
  friend bool operator==(const PluginPicture&, const PluginPicture&) = default;
};

/// One instance of the rasterizer in a shared library. The library stays loaded until the process ends.
class PluginDriver {
 public:
  /// `library` is a path. Throws std::runtime_error when it cannot be loaded, its table breaks the interface
  /// or create() fails.
  explicit PluginDriver(const std::string& library, std::map<std::string, std::string> options = {});
  PluginDriver(const PluginDriver&) = delete;
  PluginDriver& operator=(const PluginDriver&) = delete;
  ~PluginDriver();

  /// One frame, begin_frame() to end_frame(). Throws std::runtime_error, with the last log line in its text,
  /// on a status other than FAROP_OK, on writes outside the picture (padding; an apron below and above), on
  /// changed arguments and on a changed rounding mode. May be called again after that.
  PluginPicture draw(const PluginFrame& frame, std::span<const PluginPolygon> polygons);

  std::string last_log;           ///< last line logged during the last call; empty: none
  std::vector<std::string> logs;  ///< all lines logged during the last call
  const farop_rasterizer& table() const { return *table_; }

 private:
  struct Host;
  struct Library;
  static Library& open(const std::string& path, const std::map<std::string, std::string>& options);
  void forget_log();
  void collect_log();
  [[noreturn]] void fail(const std::string& what);
  void check(farop_status status, const char* call);
  void draw_polygon(const PluginPolygon& polygon, std::uint32_t index);

  Library* library_ = nullptr;
  Host* host_ = nullptr;
  const farop_rasterizer* table_ = nullptr;
  void* self_ = nullptr;
  std::uint32_t frame_number_ = 0;
};

}  // namespace farop::test
