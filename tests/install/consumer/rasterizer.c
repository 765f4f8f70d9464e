/* SPDX-License-Identifier: GPL-3.0-or-later
 * A stranger's rasterizer: it only has to build against the installed header. */
#include <farop/rasterizer.h>

static farop_status begin_frame(void* self, const farop_frame* frame) {
  (void)self;
  return frame->width > 0 ? FAROP_OK : FAROP_E_INVALID;
}
static farop_status polygon(void* self, const farop_polygon* p) {
  (void)self;
  return p->vertex_count >= 3 ? FAROP_OK : FAROP_E_INVALID;
}
static farop_status end_frame(void* self) {
  (void)self;
  return FAROP_OK;
}

const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {
      sizeof table, FAROP_ABI_VERSION, "own",   "draws nothing", 0, 0, NULL,
      NULL,         begin_frame,       polygon, end_frame};
  (void)host;
  return &table;
}
