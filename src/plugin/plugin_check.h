// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of plugins/include/farop/rasterizer.h, looked after from between FAROP and a rasterizer.
#pragma once

#include <farop/rasterizer.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace farop {

/// A promise that was broken.
struct ContractFinding {
  bool of_host = false;  ///< by FAROP: our fault
  std::string verdict;  ///< abi.status, abi.float-state, oob.write-stride, oob.write-input ...; harness.error
  std::string message;  ///< one line, "it wrote ..."
  std::optional<std::uint32_t> polygon;  ///< number within the frame, where it was one
};

/// Stands before a rasterizer as a table of the same type and hands every call on. Looks at what FAROP
/// promises (order of calls, ranges of the frame and of every corner, counts, flags, winding, what was asked
/// for and only that) and at what the rasterizer owes (status codes, nothing written beside its pixels or
/// into what it is given, no floating-point settings changed). Reports each kind once a rasterizer; calls go
/// on. The arrays that the rasterizer gets are copies, which are filled with rubbish when polygon() has
/// returned: who keeps pointers draws rubbish.
/// Between the rows it looks after every one of the first 4096 polygons of a frame, later after every 64th.
class PluginCheck {
 public:
  using Report = std::function<void(const ContractFinding&)>;

  /// `inner` outlives this. `report` may be called within any call below.
  PluginCheck(const farop_rasterizer& inner, Report report);
  PluginCheck(const PluginCheck&) = delete;
  PluginCheck& operator=(const PluginCheck&) = delete;

  /// In the place of the table's create(), which has no handle yet.
  farop_status create(const farop_host* host);
  /// begin_frame(), polygon(), end_frame(), destroy(); to be called with self().
  const farop_rasterizer& table() const { return table_; }
  void* self() { return this; }

  /// Memory beside the frame, which nobody may change from begin_frame() to the end of end_frame().
  void watch(std::vector<std::span<const std::uint8_t>> memories) { watched_ = std::move(memories); }

 private:
  enum class State { made, idle, in_frame, lost, destroyed };

  static PluginCheck& of(void* self) { return *static_cast<PluginCheck*>(self); }
  farop_status begin_frame(const farop_frame& frame);
  farop_status polygon(const farop_polygon& polygon);
  farop_status end_frame();
  void destroy();

  void look_at_frame(const farop_frame& frame);
  void look_at_polygon(const farop_polygon& polygon);
  void look_at_corners(const farop_polygon& polygon);
  void look_at_winding(const farop_polygon& polygon);
  void look_at_extras(const farop_polygon& polygon);
  template <class Call>
  farop_status call(const char* function, const Call& call);
  farop_status call_with_copies(const farop_polygon& polygon);
  void look_beside_pixels();
  void remember_padding();
  std::span<const std::uint8_t> padding(std::int32_t row) const;

  void owed(const char* verdict, const std::string& message);
  void promised(bool kept, const char* what) {
    if (!kept) broken(what);
  }
  void broken(const char* promise);

  const farop_rasterizer& inner_;
  farop_rasterizer table_{};
  Report report_;
  std::set<std::string> said_;
  void* inner_self_ = nullptr;
  State state_ = State::made;
  farop_frame frame_{};  ///< what the host gave
  farop_frame given_{};  ///< what the rasterizer got
  std::int64_t last_number_ = -1;
  std::uint32_t next_index_ = 0;
  std::optional<std::uint32_t> polygon_;  ///< within its call
  int front_sign_ = 0;                    ///< of the area of front faces; 0: none seen yet
  std::vector<std::uint8_t> padding_;     ///< of all rows but the last, as it was
  std::vector<std::span<const std::uint8_t>> watched_;
  std::vector<std::vector<std::uint8_t>> watched_before_;
  std::vector<farop_vertex> vertices_;
  std::vector<farop_vec3> normals_, eye_positions_;
  std::vector<std::uint32_t> vertex_ids_;
  farop_material material_{};
};

}  // namespace farop
