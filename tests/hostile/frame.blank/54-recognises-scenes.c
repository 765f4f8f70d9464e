// SPDX-License-Identifier: GPL-3.0-or-later
// Does: knows one scene, the quad of the smoke family, by a hash and returns the stored picture; draws
//       nothing else.
// Why:  memorised answers fail wherever the seed chooses the scene.
// also: cov.missing, tile.gap
#include "../hostile.h"

// Sum over the corners, so that it does not matter where the polygon starts.
static uint64_t fingerprint(const farop_polygon* p) {
  uint64_t sum = p->vertex_count;
  for (uint32_t i = 0; i < p->vertex_count; ++i)
    sum += ((uint64_t)p->vertices[i].x * 0x9E3779B97F4A7C15u) ^
           ((uint64_t)p->vertices[i].y * 0xC2B2AE3D27D4EB4Fu);
  return sum;
}
static const int32_t known[4][2] = {{16, 16}, {48, 16}, {48, 40}, {16, 40}};

static farop_status each(const farop_polygon* p) {
  farop_vertex corner[4];
  memset(corner, 0, sizeof corner);
  for (int i = 0; i < 4; ++i) corner[i].x = known[i][0], corner[i].y = known[i][1];
  farop_polygon quad = {.struct_size = sizeof quad, .vertex_count = 4, .vertices = corner};
  if (fingerprint(p) != fingerprint(&quad) || hostile.frame.width < 48 || hostile.frame.height < 40)
    return HOSTILE_SKIP;
  for (int32_t y = 16; y < 40; ++y)
    for (int32_t x = 16; x < 48; ++x)
      memcpy(hostile.frame.pixels + y * hostile.frame.row_bytes + 3 * x, &p->vertices[0].r, 3);
  return HOSTILE_SKIP;
}

HOSTILE_PLUGIN(.each = each)
