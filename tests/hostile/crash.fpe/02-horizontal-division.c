// SPDX-License-Identifier: GPL-3.0-or-later
// Does: computes dx/dy in integers for every edge, horizontal ones too.
// Why:  dies in some cases only: the runner is restarted and the other cases still run.
// only: x86_64
#include "../hostile.h"

static volatile int32_t slope_sum;

static farop_status each(const farop_polygon* p) {
  for (uint32_t i = 0; i < p->vertex_count; ++i) {
    const farop_vertex *a = &p->vertices[i], *b = &p->vertices[(i + 1) % p->vertex_count];
    volatile int32_t dy = b->y - a->y;
    slope_sum += (b->x - a->x) / dy;
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.each = each)
