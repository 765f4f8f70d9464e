/* SPDX-License-Identifier: GPL-3.0-or-later
 * A rasterizer that marks every corner and checks what it is told, built against the header of 1.0 and
 * against one that has grown. Draws the corner's colour; the pixel at 0,0 turns red when something is not as
 * the header says. */
#include <farop/rasterizer.h>

static farop_frame frame; /* as much of it as was known at compile time */

static farop_status begin_frame(void* self, const farop_frame* f) {
  (void)self;
  if (f->struct_size < sizeof(uint32_t) || !FAROP_HAS(farop_frame, f, background)) return FAROP_E_INVALID;
  frame.width = f->width;
  frame.height = f->height;
  frame.row_bytes = f->row_bytes;
  frame.pixels = f->pixels;
  return f->z_near < f->z_far ? FAROP_OK : FAROP_E_INVALID;
}

static farop_status polygon(void* self, const farop_polygon* p) {
  (void)self;
  for (uint32_t i = 0; i < p->vertex_count; ++i) {
    const farop_vertex* v = &p->vertices[i];
    uint8_t* pixel = frame.pixels + v->y * frame.row_bytes + 3 * v->x;
    pixel[0] = v->r, pixel[1] = v->g, pixel[2] = v->b;
  }
  if (!FAROP_HAS(farop_polygon, p, object_id) || p->object_id != 9 || p->vertex_ids == NULL)
    frame.pixels[0] = 255;
  return FAROP_OK;
}

static farop_status end_frame(void* self) {
  (void)self;
  return FAROP_OK;
}

FAROP_EXPORT const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static farop_rasterizer table;
  if (host->abi_version >> 16 != FAROP_ABI_MAJOR || !FAROP_HAS(farop_host, host, extension)) return NULL;
  table.struct_size = sizeof table;
  table.abi_version = FAROP_ABI_VERSION;
  table.name = "growth";
  table.wants = FAROP_WANT_VERTEX_IDS;
  table.begin_frame = begin_frame;
  table.polygon = polygon;
  table.end_frame = end_frame;
  return &table;
}
