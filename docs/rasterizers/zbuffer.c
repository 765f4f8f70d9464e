// SPDX-License-Identifier: GPL-3.0-or-later
// A z-buffer for triangles. Build: cc -O2 -fPIC -shared -I plugins/include zbuffer.c -o zbuffer.so
#include <farop/rasterizer.h>
#include <stdlib.h>
#define MIN(a, b, c) ((a) < (b) ? ((a) < (c) ? (a) : (c)) : ((b) < (c) ? (b) : (c)))
#define MAX(a, b, c) (-MIN(-(a), -(b), -(c)))
static const farop_frame* frame;
static int32_t* depth;

static farop_status begin_frame(void* self, const farop_frame* f) {
  const size_t count = (size_t)f->width * (size_t)f->height;
  int32_t* const room = realloc(depth, count * sizeof *depth);
  if (!room) return FAROP_E_MEMORY;
  for (size_t i = 0; i < count; i++) room[i] = INT32_MAX;  // beyond the far plane
  return (void)self, frame = f, depth = room, FAROP_OK;
}
static int64_t edge(farop_vertex a, farop_vertex b, int x, int y) {  // > 0: (x, y) lies left of a -> b
  return (int64_t)(b.x - a.x) * (y - a.y) - (int64_t)(b.y - a.y) * (x - a.x);
}  // Samples on an edge that goes up (a right one) or, level, to the left (a top one) are the neighbour's:
static int lost(farop_vertex a, farop_vertex b) { return a.y < b.y || (a.y == b.y && a.x > b.x); }
static farop_status polygon(void* self, const farop_polygon* p) {
  farop_vertex a = p->vertices[0], b = p->vertices[1], c = p->vertices[2];
  if (edge(a, b, c.x, c.y) < 0) a = p->vertices[1], b = p->vertices[0];  // counter-clockwise from here on
  const int64_t area = edge(a, b, c.x, c.y);
  const int bits = frame->subpixel_bits, pixel = 1 << bits;
  for (int y = MIN(a.y, b.y, c.y) & -pixel; area != 0 && y <= MAX(a.y, b.y, c.y); y += pixel) {
    for (int x = MIN(a.x, b.x, c.x) & -pixel; x <= MAX(a.x, b.x, c.x); x += pixel) {
      const int64_t u = edge(b, c, x, y), v = edge(c, a, x, y), w = edge(a, b, x, y);
      if (u < lost(b, c) || v < lost(c, a) || w < lost(a, b)) continue;
      const double A = (double)u / (double)area, B = (double)v / (double)area, C = (double)w / (double)area;
      const int32_t z = (int32_t)(A * a.z + B * b.z + C * c.z + 0.5);
      int32_t* const nearest = depth + (int64_t)(y >> bits) * frame->width + (x >> bits);
      if (z >= *nearest) continue;  // of equal depths the first drawn stays
      *nearest = z;
      uint8_t* const rgb = frame->pixels + (y >> bits) * frame->row_bytes + 3 * (x >> bits);
      rgb[0] = (uint8_t)(A * a.r + B * b.r + C * c.r + 0.5);
      rgb[1] = (uint8_t)(A * a.g + B * b.g + C * c.g + 0.5);
      rgb[2] = (uint8_t)(A * a.b + B * b.b + C * c.b + 0.5);
    }
  }
  return (void)self, FAROP_OK;
}
static farop_status end_frame(void* self) { return (void)self, FAROP_OK; }
const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {
      sizeof table, FAROP_ABI_VERSION, "zbuffer_c", "z-buffer in C", FAROP_WANT_TRIANGLES, 0, NULL,
      NULL,         begin_frame,       polygon,     end_frame};
  return (void)host, &table;
}
