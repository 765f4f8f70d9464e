/* SPDX-License-Identifier: GPL-3.0-or-later
 * The binary layout of version 1 of the rasterizer interface, on every 64-bit platform. Compiled once per
 * language standard that the header promises; a structure that moved does not compile. */
#include <farop/rasterizer.h>
#include <string.h>

#define CONCAT_(a, b) a##b
#define CONCAT(a, b) CONCAT_(a, b)
/* C99 and C++98 know no static assertion: a negative array size does as well. */
#define HOLDS(condition) typedef char CONCAT(holds_, __LINE__)[(condition) ? 1 : -1]
#define SIZE(type, bytes) HOLDS(sizeof(type) == (bytes))
#define AT(type, member, offset) HOLDS(offsetof(type, member) == (offset))

SIZE(farop_vec3, 12);
SIZE(farop_vertex, 16);
SIZE(farop_material, 48);
SIZE(farop_polygon, 64);
SIZE(farop_frame, 56);
SIZE(farop_host, 40);
SIZE(farop_rasterizer, 72);

AT(farop_vertex, z, 8);
AT(farop_vertex, r, 12);
AT(farop_vertex, reserved, 15);
AT(farop_material, id, 4);
AT(farop_material, ambient, 20);
AT(farop_material, opacity, 36);
AT(farop_polygon, vertices, 8);
AT(farop_polygon, material, 40);
AT(farop_polygon, index, 48);
AT(farop_polygon, flags, 52);
AT(farop_polygon, object_id, 60);
AT(farop_frame, z_near, 16);
AT(farop_frame, max_vertices, 24);
AT(farop_frame, row_bytes, 32);
AT(farop_frame, pixels, 40);
AT(farop_frame, background, 48);
AT(farop_host, name, 8);
AT(farop_host, log, 16);
AT(farop_host, extension, 32);
AT(farop_rasterizer, name, 8);
AT(farop_rasterizer, wants, 24);
AT(farop_rasterizer, create, 32);
AT(farop_rasterizer, end_frame, 64);
HOLDS(FAROP_ABI_VERSION == 0x10000u);

int main(void) {
  farop_frame frame;
  memset(&frame, 0, sizeof frame);
  frame.struct_size = (uint32_t)(offsetof(farop_frame, row_bytes));
  /* A sender that ends before row_bytes has max_vertices and not row_bytes. */
  return FAROP_HAS(farop_frame, &frame, max_vertices) && !FAROP_HAS(farop_frame, &frame, row_bytes) ? 0 : 1;
}
