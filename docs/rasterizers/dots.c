// SPDX-License-Identifier: GPL-3.0-or-later
// A start in C: one pixel per corner. Build: cc -O2 -fPIC -shared -I plugins/include dots.c -o dots.so
#include <farop/rasterizer.h>
#include <stddef.h>

static const farop_frame* frame;  // from begin_frame() to end_frame(); no create(): all instances share it

static farop_status begin_frame(void* self, const farop_frame* f) {
  (void)self;
  frame = f;
  // YOUR PART 3, beginning: the depth buffer. Keep one depth for each pixel, and set all of them farther than
  // frame->z_far here, because every picture starts empty.
  return FAROP_OK;
}

// Row 0 is the bottom row. Corners always lie on the frame, and so does all that lies between them: no bounds
// to check.
static void set_pixel(int column, int row, int depth, uint8_t r, uint8_t g, uint8_t b) {
  // YOUR PART 3, end: the depth test. Leave the pixel alone unless `depth` is smaller than what is kept for
  // it; if it is, keep it: whatever order the polygons come in, the nearest one is seen.
  (void)depth;
  uint8_t* const pixel = frame->pixels + row * frame->row_bytes + 3 * column;
  pixel[0] = r, pixel[1] = g, pixel[2] = b;
}

// Any polygon, concave ones too. Only triangles come if you set `wants` below to FAROP_WANT_TRIANGLES.
static farop_status polygon(void* self, const farop_polygon* p) {
  (void)self;
  // YOUR PART 1: scan conversion, in place of this loop. Enter the edges into a table by the row of their
  // lower end; then, row by row upwards, the edges that cross a row, sorted by column, bound its spans in
  // pairs. A sample on a left or bottom edge is inside and one on a right or top edge is not, so that
  // neighbours share no pixel and leave none out.
  for (uint32_t i = 0; i < p->vertex_count; i++) {
    const farop_vertex v = p->vertices[i];
    // YOUR PART 2: interpolation. Depth and colour change by the same step from row to row along an edge, and
    // from column to column along a span: compute the steps once, then add, and round to whole numbers last.
    set_pixel(v.x >> frame->subpixel_bits, v.y >> frame->subpixel_bits, v.z, v.r, v.g, v.b);
  }
  return FAROP_OK;
}

static farop_status end_frame(void* self) {
  (void)self;
  return FAROP_OK;
}

const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {.struct_size = sizeof table,
                                         .abi_version = FAROP_ABI_VERSION,
                                         .name = "dots_c",
                                         .summary = "one pixel per corner",  // your name, your algorithm
                                         .wants = 0,
                                         .begin_frame = begin_frame,
                                         .polygon = polygon,
                                         .end_frame = end_frame};
  (void)host;
  return &table;
}
