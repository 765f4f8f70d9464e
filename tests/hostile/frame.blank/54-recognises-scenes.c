// SPDX-License-Identifier: GPL-3.0-or-later
// Does: knows two polygons by a hash, those of smoke/quad and of cov/tri-random#0 under seed 1; draws nothing
//       else.
// Why:  memorised answers fail wherever the seed chooses the scene.
// also: cov.missing, tile.gap
#include "../hostile.h"

// Sum over the corners, so that it does not matter where the polygon starts.
static uint64_t fingerprint(const int32_t (*corner)[2], uint32_t count) {
  uint64_t sum = count;
  for (uint32_t i = 0; i < count; ++i)
    sum += ((uint64_t)corner[i][0] * 0x9E3779B97F4A7C15u) ^ ((uint64_t)corner[i][1] * 0xC2B2AE3D27D4EB4Fu);
  return sum;
}

static farop_status each(const farop_polygon* p) {
  static const int32_t quad[4][2] = {{16, 16}, {48, 16}, {48, 40}, {16, 40}};
  static const int32_t triangle[3][2] = {{9, 28}, {60, 43}, {3, 39}};
  int32_t corner[4][2];
  if (p->vertex_count > 4) return HOSTILE_SKIP;
  for (uint32_t i = 0; i < p->vertex_count; ++i)
    corner[i][0] = p->vertices[i].x, corner[i][1] = p->vertices[i].y;
  uint64_t seen = fingerprint(corner, p->vertex_count);
  return seen == fingerprint(quad, 4) || seen == fingerprint(triangle, 3) ? FAROP_OK : HOSTILE_SKIP;
}

HOSTILE_PLUGIN(.each = each)
