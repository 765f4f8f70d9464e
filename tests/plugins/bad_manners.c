// SPDX-License-Identifier: GPL-3.0-or-later
// A rasterizer for the tests of the test driver: breaks the one rule that the option "sin" names.
#include <fenv.h>
#include <stdlib.h>
#include <string.h>

#include "farop/rasterizer.h"

typedef struct {
  const char* sin;
  const farop_host* host;
  const farop_frame* frame;
} instance;

static int has(const instance* self, const char* sin) {
  return strcmp(self->sin, sin) == 0;
}

static farop_status create(const farop_host* host, void** self) {
  const char* const sin = host->option(host, "sin");
  if (sin && strcmp(sin, "create") == 0) {
    host->log(host, FAROP_LOG_ERROR, "no mood");
    return FAROP_E_INTERNAL;
  }
  instance* const made = malloc(sizeof *made);
  if (!made) return FAROP_E_MEMORY;
  *made = (instance){sin ? sin : "", host, NULL};
  *self = made;
  return FAROP_OK;
}

static void destroy(void* self) {
  free(self);
}

static farop_status begin_frame(void* self, const farop_frame* frame) {
  instance* const s = self;
  s->frame = frame;
  if (has(s, "frame")) ((farop_frame*)frame)->width = 1;
  return FAROP_OK;
}

static farop_status polygon(void* self, const farop_polygon* p) {
  instance* const s = self;
  uint8_t* const pixels = s->frame->pixels;
  if (has(s, "corner")) ((farop_vertex*)p->vertices)[1].x++;
  if (has(s, "padding")) pixels[3 * s->frame->width] ^= 1;
  if (has(s, "before")) pixels[-1] ^= 1;
  if (has(s, "behind")) pixels[s->frame->height * s->frame->row_bytes] ^= 1;
  if (has(s, "rounding")) fesetround(FE_UPWARD);
  if (has(s, "status")) {
    s->host->log(s->host, FAROP_LOG_INFO, "first line");
    s->host->log(s->host, FAROP_LOG_ERROR, "second line");
    return FAROP_E_INVALID;
  }
  pixels[0] = 77;
  return FAROP_OK;
}

static farop_status end_frame(void* self) {
  (void)self;
  return FAROP_OK;
}

const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {
      sizeof table, FAROP_ABI_VERSION, "bad_manners", "breaks one rule", 0,        0,
      create,       destroy,           begin_frame,   polygon,           end_frame};
  (void)host;
  return &table;
}
