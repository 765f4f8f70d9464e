// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/plugin_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/limits.h"
#include "plugin/polygon_chunk.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace farop {
namespace {

constexpr std::uint32_t k_precise_polygons = 4096, k_later_period = 64;
constexpr std::uint32_t k_known_flags = FAROP_POLYGON_CONVEX | FAROP_POLYGON_BACK_FACING;
constexpr std::uint8_t k_rubbish = 0xA5;

/// Rounding mode, and where there is one the switch for denormal numbers.
struct FloatSettings {
  int rounding = std::fegetround();
#if defined(__SSE__)
  unsigned control = _mm_getcsr() & 0xFFC0u;
#endif
  friend bool operator==(const FloatSettings&, const FloatSettings&) = default;
  void restore() const {
    std::fesetround(rounding);
#if defined(__SSE__)
    _mm_setcsr((_mm_getcsr() & ~0xFFC0u) | control);
#endif
  }
};

bool is_finite(const farop_vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_unit(const farop_vec3& v) {
  const double square = double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z;
  return std::abs(square - 1) < 1e-3;
}
bool is_fraction(float value) {
  return value >= 0 && value <= 1;
}

/// The same bytes.
template <class T>
bool are_alike(const T* a, const T* b, std::size_t count) {
  return count == 0 || std::memcmp(a, b, count * sizeof(T)) == 0;
}
template <class T>
const T* copy(std::vector<T>& to, const T* from, std::size_t count) {
  if (from == nullptr) return nullptr;
  to.assign(from, from + count);
  return to.data();
}
template <class T>
void spoil(std::vector<T>& array) {
  if (!array.empty()) std::memset(static_cast<void*>(array.data()), k_rubbish, array.size() * sizeof(T));
}

}  // namespace

PluginCheck::PluginCheck(const farop_rasterizer& inner, Report report)
    : inner_(inner), table_(inner), report_(std::move(report)) {
  table_.create = nullptr;
  table_.destroy = [](void* self) { of(self).destroy(); };
  table_.begin_frame = [](void* self, const farop_frame* frame) { return of(self).begin_frame(*frame); };
  table_.polygon = [](void* self, const farop_polygon* polygon) { return of(self).polygon(*polygon); };
  table_.end_frame = [](void* self) { return of(self).end_frame(); };
}

// ---- reporting ------------------------------------------------------------------------------------------

void PluginCheck::owed(const char* verdict, const std::string& message) {
  if (!said_.insert(verdict + message.substr(0, message.find(':'))).second) return;
  ContractFinding finding;
  finding.verdict = verdict;
  finding.message = message;
  finding.polygon = polygon_;
  if (polygon_) finding.message += fmt::format(" (polygon {})", *polygon_);
  report_(finding);
}

void PluginCheck::broken(const char* promise) {
  if (!said_.insert(std::string("host ") + promise).second) return;
  ContractFinding finding;
  finding.of_host = true;
  finding.verdict = "harness.error";
  finding.message = std::string("farop broke its own promise: ") + promise;
  finding.polygon = polygon_;
  if (polygon_) finding.message += fmt::format(" (polygon {})", *polygon_);
  report_(finding);
}

// ---- calls ----------------------------------------------------------------------------------------------

/// Any function of the rasterizer, and what every one of them owes.
template <class Call>
farop_status PluginCheck::call(const char* function, const Call& call) {
  const FloatSettings before;
  const farop_status status = call();
  if (FloatSettings() != before) {
    before.restore();
    owed("abi.float-state",
         fmt::format("{}() changed the rounding mode or how denormal numbers are treated", function));
  }
  if (status > FAROP_OK || status < FAROP_E_INTERNAL) {
    owed("abi.status", fmt::format("{}() returned no status of the interface: {}", function, status));
  }
  return status;
}

farop_status PluginCheck::create(const farop_host* host) {
  promised(state_ == State::made, "create() is the first call, and called once");
  state_ = State::idle;
  if (inner_.create == nullptr) return FAROP_OK;
  return call("create", [&] { return inner_.create(host, &inner_self_); });
}

farop_status PluginCheck::begin_frame(const farop_frame& frame) {
  promised(state_ == State::idle || state_ == State::lost,
           "begin_frame() follows create(), end_frame() or a failure");
  frame_ = given_ = frame;
  look_at_frame(frame);
  state_ = State::in_frame;
  next_index_ = 0;
  front_sign_ = 0;
  remember_padding();
  const farop_status status = call("begin_frame", [&] { return inner_.begin_frame(inner_self_, &given_); });
  look_beside_pixels();
  if (status < 0) state_ = State::lost;
  return status;
}

farop_status PluginCheck::polygon(const farop_polygon& polygon) {
  polygon_ = polygon.index;
  promised(state_ == State::in_frame, "polygon() lies between begin_frame() and end_frame()");
  promised(polygon.index == next_index_, "polygons are numbered 0, 1, 2 ... within the frame");
  next_index_ = polygon.index + 1;
  look_at_polygon(polygon);
  const farop_status status = call_with_copies(polygon);
  if (polygon.index < k_precise_polygons || polygon.index % k_later_period == 0) look_beside_pixels();
  if (status < 0) state_ = State::lost;
  polygon_.reset();
  return status;
}

farop_status PluginCheck::call_with_copies(const farop_polygon& polygon) {
  const std::size_t count = polygon.vertex_count;
  farop_polygon mine = polygon;
  mine.vertices = copy(vertices_, polygon.vertices, count);
  mine.normals = copy(normals_, polygon.normals, count);
  mine.eye_positions = copy(eye_positions_, polygon.eye_positions, count);
  mine.vertex_ids = copy(vertex_ids_, polygon.vertex_ids, count);
  if (polygon.material != nullptr) material_ = *polygon.material, mine.material = &material_;
  const farop_polygon sent = mine;

  const farop_status status = call("polygon", [&] { return inner_.polygon(inner_self_, &mine); });

  const bool alike =
      are_alike(&mine, &sent, 1) && are_alike(vertices_.data(), polygon.vertices, count) &&
      (polygon.normals == nullptr || are_alike(normals_.data(), polygon.normals, count)) &&
      (polygon.eye_positions == nullptr || are_alike(eye_positions_.data(), polygon.eye_positions, count)) &&
      (polygon.vertex_ids == nullptr || are_alike(vertex_ids_.data(), polygon.vertex_ids, count)) &&
      (polygon.material == nullptr || are_alike(&material_, polygon.material, 1));
  if (!alike) owed("oob.write-input", "it changed the polygon that it was given");
  spoil(vertices_), spoil(normals_), spoil(eye_positions_), spoil(vertex_ids_);
  return status;
}

farop_status PluginCheck::end_frame() {
  promised(state_ == State::in_frame, "end_frame() follows begin_frame() and its polygons");
  const farop_status status = call("end_frame", [&] { return inner_.end_frame(inner_self_); });
  look_beside_pixels();
  state_ = status < 0 ? State::lost : State::idle;
  watched_.clear();
  return status;
}

void PluginCheck::destroy() {
  promised(state_ != State::made && state_ != State::destroyed, "destroy() is called once, after create()");
  state_ = State::destroyed;
  if (inner_.destroy == nullptr) return;
  call("destroy", [&] {
    inner_.destroy(inner_self_);
    return FAROP_OK;
  });
}

// ---- what the host promises -----------------------------------------------------------------------------

void PluginCheck::look_at_frame(const farop_frame& frame) {
  promised(frame.struct_size == sizeof frame, "farop_frame.struct_size is its size");
  promised(frame.width >= 1 && frame.width <= k_max_resolution && frame.height >= 1 &&
               frame.height <= k_max_resolution,
           "a frame has 1 .. 32767 pixels a side");
  promised(frame.subpixel_bits >= 0 && frame.subpixel_bits <= k_max_subpixel_bits, "0 .. 8 sub-pixel bits");
  promised(frame.z_near >= 0 && frame.z_near < frame.z_far && frame.z_far < k_max_depth_resolution,
           "0 <= z_near < z_far < 2^30");
  promised(frame.row_bytes >= 3 * std::int64_t{frame.width}, "row_bytes has room for the pixels");
  const bool elsewhere = (inner_.wants & FAROP_DRAWS_ELSEWHERE) != 0;
  promised((frame.pixels == nullptr) == elsewhere, "pixels are there unless FAROP_DRAWS_ELSEWHERE is set");
  promised(frame.background[3] == 0 && frame.reserved == 0, "reserved members of the frame are 0");
  promised(frame.number == last_number_ + 1, "frames are numbered 0, 1, 2 ...");
  last_number_ = frame.number;
}

void PluginCheck::look_at_polygon(const farop_polygon& polygon) {
  promised(polygon.struct_size == sizeof polygon, "farop_polygon.struct_size is its size");
  promised(polygon.vertex_count >= 3, "a polygon has 3 corners or more");
  promised(polygon.vertex_count <= frame_.max_vertices, "no polygon has more than max_vertices corners");
  promised((inner_.wants & FAROP_WANT_TRIANGLES) == 0 || polygon.vertex_count == 3,
           "nothing but triangles where FAROP_WANT_TRIANGLES is set");
  promised((polygon.flags & ~k_known_flags) == 0, "flags are those of the interface");
  promised(polygon.vertices != nullptr, "vertices are there");
  if (polygon.vertices == nullptr || polygon.vertex_count == 0) return;
  look_at_corners(polygon);
  look_at_winding(polygon);
  look_at_extras(polygon);
}

void PluginCheck::look_at_corners(const farop_polygon& polygon) {
  const std::int32_t right = (frame_.width - 1) << frame_.subpixel_bits;
  const std::int32_t top = (frame_.height - 1) << frame_.subpixel_bits;
  for (std::uint32_t i = 0; i < polygon.vertex_count; ++i) {
    const farop_vertex& v = polygon.vertices[i];
    promised(v.x >= 0 && v.x <= right && v.y >= 0 && v.y <= top, "corners lie on the frame");
    promised(v.z >= frame_.z_near && v.z <= frame_.z_far, "depths lie between z_near and z_far");
    promised(v.reserved == 0, "reserved bytes of corners are 0");
  }
}

void PluginCheck::look_at_winding(const farop_polygon& polygon) {
  const std::span<const farop_vertex> corners(polygon.vertices, polygon.vertex_count);
  promised(((polygon.flags & FAROP_POLYGON_CONVEX) != 0) == is_convex(corners),
           "FAROP_POLYGON_CONVEX says what the corners say");
  std::int64_t area = 0, length = 0;  // twice the area
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const farop_vertex &a = corners[i], &b = corners[i + 1 < corners.size() ? i + 1 : 0];
    area += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
    length += std::abs(b.x - a.x) + std::abs(b.y - a.y);
  }
  // Rounding moves every corner by half a unit at most: it cannot have turned over one of more area.
  if (std::abs(area) <= length + polygon.vertex_count) return;
  const int back = (polygon.flags & FAROP_POLYGON_BACK_FACING) != 0 ? -1 : 1;
  const int sign = (area > 0 ? 1 : -1) * back;
  if (front_sign_ == 0) front_sign_ = sign;  // it depends on whether rows count upwards
  promised(sign == front_sign_, "front faces turn one way, back faces the other");
}

void PluginCheck::look_at_extras(const farop_polygon& polygon) {
  const auto asked = [&](std::uint32_t wish) { return (inner_.wants & wish) != 0; };
  promised(polygon.normals == nullptr || asked(FAROP_WANT_NORMALS), "no normals unless asked for");
  promised(polygon.eye_positions == nullptr || asked(FAROP_WANT_EYE_POSITIONS),
           "no eye positions unless asked for");
  promised(polygon.vertex_ids == nullptr || asked(FAROP_WANT_VERTEX_IDS), "no vertex ids unless asked for");
  promised(polygon.material == nullptr || asked(FAROP_WANT_MATERIAL), "no material unless asked for");
  for (std::uint32_t i = 0; i < polygon.vertex_count; ++i) {
    if (polygon.normals != nullptr) promised(is_unit(polygon.normals[i]), "normals have unit length");
    if (polygon.eye_positions != nullptr) {
      promised(is_finite(polygon.eye_positions[i]), "eye positions are finite");
    }
  }
  if (polygon.material == nullptr) return;
  const farop_material& m = *polygon.material;
  promised(m.struct_size == sizeof m, "farop_material.struct_size is its size");
  bool fractions = is_fraction(m.ambient) && is_fraction(m.diffuse) && is_fraction(m.specular);
  for (int i = 0; i < 3; ++i) fractions = fractions && is_fraction(m.color[i]) && is_fraction(m.opacity[i]);
  promised(fractions, "components of materials lie in 0 .. 1");
  promised(std::isfinite(m.shininess) && m.shininess >= 0, "shininess is 0 or more");
}

// ---- what the rasterizer owes ---------------------------------------------------------------------------

/// Of all rows but the last: behind that the memory may end.
std::span<const std::uint8_t> PluginCheck::padding(std::int32_t row) const {
  const std::int64_t pixels = 3 * std::int64_t{frame_.width};
  return {frame_.pixels + row * frame_.row_bytes + pixels,
          static_cast<std::size_t>(frame_.row_bytes - pixels)};
}

void PluginCheck::remember_padding() {
  padding_.clear();
  for (std::int32_t row = 0; frame_.pixels != nullptr && row + 1 < frame_.height; ++row) {
    const auto bytes = padding(row);
    padding_.insert(padding_.end(), bytes.begin(), bytes.end());
  }
  watched_before_.clear();
  for (const auto& memory : watched_) watched_before_.emplace_back(memory.begin(), memory.end());
}

void PluginCheck::look_beside_pixels() {
  if (!are_alike(&given_, &frame_, 1)) {
    owed("oob.write-input", "it changed the farop_frame that it was given");
    given_ = frame_;
  }
  bool changed = false;
  const std::uint8_t* before = padding_.data();
  for (std::int32_t row = 0; !padding_.empty() && row + 1 < frame_.height; ++row) {
    const auto bytes = padding(row);
    if (!are_alike(bytes.data(), before, bytes.size())) {
      changed = true;
      owed("oob.write-stride", fmt::format("it wrote behind the last pixel of a row: row {}", row));
    }
    before += bytes.size();
  }
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const auto& memory = watched_[i];
    if (are_alike(memory.data(), watched_before_[i].data(), memory.size())) continue;
    changed = true;
    const bool first = memory.data() < frame_.pixels;
    owed(first ? "oob.write-before" : "oob.write-after",
         first ? "it wrote before the first row" : "it wrote behind the last row");
  }
  if (changed) remember_padding();
}

}  // namespace farop
