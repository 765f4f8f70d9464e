// SPDX-License-Identifier: GPL-3.0-or-later
// Honest: fills triangles flat under a left-bottom rule, one z-buffer, one instance.
#include <farop/rasterizer.h>
#include <stdlib.h>

typedef struct {
  farop_frame frame;
  int32_t* depth;
} filler;

static farop_status create(const farop_host* host, void** self) {
  host->log(host, FAROP_LOG_INFO, "filler: ready");
  *self = calloc(1, sizeof(filler));
  return *self ? FAROP_OK : FAROP_E_MEMORY;
}

static void destroy(void* self) {
  free(((filler*)self)->depth);
  free(self);
}

static farop_status begin_frame(void* self, const farop_frame* f) {
  filler* s = self;
  size_t count = (size_t)f->width * (size_t)f->height;
  int32_t* depth = realloc(s->depth, count * sizeof *depth);
  if (!depth) return FAROP_E_MEMORY;
  for (size_t i = 0; i < count; ++i) depth[i] = f->z_far + 1;
  s->depth = depth;
  s->frame = *f;
  return FAROP_OK;
}

static int64_t edge(farop_vertex a, farop_vertex b, int64_t x, int64_t y) {
  return (int64_t)(b.y - a.y) * (x - a.x) - (int64_t)(b.x - a.x) * (y - a.y);
}

static int owns(farop_vertex a, farop_vertex b) {
  return a.y < b.y || (a.y == b.y && b.x < a.x);
}

static farop_status polygon(void* self, const farop_polygon* p) {
  filler* s = self;
  const farop_frame* f = &s->frame;
  const int bits = f->subpixel_bits;
  for (uint32_t i = 2; i < p->vertex_count; ++i) {
    farop_vertex v[3] = {p->vertices[0], p->vertices[i - 1], p->vertices[i]};
    int64_t area = edge(v[0], v[1], v[2].x, v[2].y);
    if (area == 0) continue;
    if (area < 0) {
      farop_vertex t = v[1];
      v[1] = v[2];
      v[2] = t;
    }
    int32_t low = v[0].y, high = v[0].y;
    for (int k = 1; k < 3; ++k) {
      if (v[k].y < low) low = v[k].y;
      if (v[k].y > high) high = v[k].y;
    }
    for (int32_t y = low >> bits; y <= high >> bits && y < f->height; ++y)
      for (int32_t x = 0; x < f->width; ++x) {
        int64_t sx = (int64_t)x << bits, sy = (int64_t)y << bits;
        int64_t w0 = edge(v[1], v[2], sx, sy), w1 = edge(v[2], v[0], sx, sy), w2 = edge(v[0], v[1], sx, sy);
        if (w0 < !owns(v[1], v[2]) || w1 < !owns(v[2], v[0]) || w2 < !owns(v[0], v[1])) continue;
        int32_t* d = s->depth + (size_t)y * (size_t)f->width + x;
        if (v[0].z >= *d) continue;
        uint8_t* px = f->pixels + y * f->row_bytes + 3 * (int64_t)x;
        *d = v[0].z;
        px[0] = v[0].r;
        px[1] = v[0].g;
        px[2] = v[0].b;
      }
  }
  return FAROP_OK;
}

static farop_status end_frame(void* self) {
  (void)self;
  return FAROP_OK;
}

const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {sizeof table,
                                         FAROP_ABI_VERSION,
                                         "filler",
                                         "an honest triangle filler",
                                         FAROP_WANT_VERTEX_IDS | FAROP_WANT_MATERIAL,
                                         0,
                                         create,
                                         destroy,
                                         begin_frame,
                                         polygon,
                                         end_frame};
  (void)host;
  return &table;
}
