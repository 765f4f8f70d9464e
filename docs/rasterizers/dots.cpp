// SPDX-License-Identifier: GPL-3.0-or-later
// A start in C++: one pixel per corner. Build: c++ -std=c++17 -O2 -fPIC -shared -I plugins/include dots.cpp
// -o dots.so
#include <farop/rasterizer.h>

#include <exception>
#include <new>

namespace {

class Rasterizer {
 public:
  explicit Rasterizer(const farop_host* host) : host_(host) {}

  void begin_frame(const farop_frame& frame) {
    frame_ = &frame;
    // YOUR PART 3, beginning: the depth buffer. Keep one depth for each pixel, and set all of them farther
    // than frame.z_far here, because every picture starts empty.
  }

  // Any polygon, concave ones too. Only triangles come if you set `wants` below to FAROP_WANT_TRIANGLES.
  void polygon(const farop_polygon& p) {
    // YOUR PART 1: scan conversion, in place of this loop. Enter the edges into a table by the row of their
    // lower end; then, row by row upwards, the edges that cross a row, sorted by column, bound its spans in
    // pairs. A sample on a left or bottom edge is inside and one on a right or top edge is not, so that
    // neighbours share no pixel and leave none out.
    for (uint32_t i = 0; i < p.vertex_count; ++i) {
      const farop_vertex& v = p.vertices[i];
      // YOUR PART 2: interpolation. Depth and colour change by the same step from row to row along an edge,
      // and from column to column along a span: compute the steps once, then add, and round to whole numbers
      // last.
      set_pixel(v.x >> frame_->subpixel_bits, v.y >> frame_->subpixel_bits, v.z, v.r, v.g, v.b);
    }
  }

  void end_frame() {}

  // Runs `body`; no exception may leave, so it becomes a status and a line of the log.
  template <class Body>
  farop_status guarded(Body body) const noexcept {
    try {
      body();
      return FAROP_OK;
    } catch (const std::bad_alloc&) {
      return FAROP_E_MEMORY;
    } catch (const std::exception& error) {
      host_->log(host_, FAROP_LOG_ERROR, error.what());
      return FAROP_E_INTERNAL;
    }
  }

 private:
  // Row 0 is the bottom row. Corners always lie on the frame, and so does all that lies between them: no
  // bounds to check.
  void set_pixel(int column, int row, int /*depth*/, uint8_t r, uint8_t g, uint8_t b) {
    // YOUR PART 3, end: the depth test. Leave the pixel alone unless its depth is smaller than what is kept
    // for it; if it is, keep it: whatever order the polygons come in, the nearest one is seen.
    uint8_t* const pixel = frame_->pixels + row * frame_->row_bytes + 3 * column;
    pixel[0] = r, pixel[1] = g, pixel[2] = b;
  }

  const farop_host* host_;
  const farop_frame* frame_ = nullptr;  // from begin_frame() to end_frame()
};

Rasterizer& of(void* self) { return *static_cast<Rasterizer*>(self); }

farop_status create(const farop_host* host, void** self) {
  *self = new (std::nothrow) Rasterizer(host);
  return *self == nullptr ? FAROP_E_MEMORY : FAROP_OK;
}
void destroy(void* self) { delete &of(self); }
farop_status begin_frame(void* self, const farop_frame* frame) {
  return of(self).guarded([&] { of(self).begin_frame(*frame); });
}
farop_status polygon(void* self, const farop_polygon* p) {
  return of(self).guarded([&] { of(self).polygon(*p); });
}
farop_status end_frame(void* self) {
  return of(self).guarded([&] { of(self).end_frame(); });
}

}  // namespace

const farop_rasterizer* farop_rasterizer_entry(const farop_host*) {
  static farop_rasterizer table{};  // what stays 0 is left out
  table.struct_size = sizeof table;
  table.abi_version = FAROP_ABI_VERSION;
  table.name = "dots_cpp";
  table.summary = "one pixel per corner";  // your name, your algorithm
  table.wants = 0;
  table.create = create;
  table.destroy = destroy;
  table.begin_frame = begin_frame;
  table.polygon = polygon;
  table.end_frame = end_frame;
  return &table;
}
