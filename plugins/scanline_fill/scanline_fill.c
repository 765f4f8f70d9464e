// SPDX-License-Identifier: GPL-3.0-or-later
// scanline_fill - area filling by scan lines in whole numbers only, with depth.
//
// The algorithm of the lecture slides "Preenchimento de Áreas, Algoritmo Scanline" after D. Hearn and M. P.
// Baker, Computer Graphics, 2nd ed., Prentice Hall 1994, chapter 3-11. The ordered edge list goes back to C.
// Wylie, G. Romney, D. Evans and A. Erdahl, "Half-tone Perspective Drawings by Computer", AFIPS Fall Joint
// Computer Conference 1967.
//
//   edge table:        a bucket for every scan line, with the edges that begin there (their lower end)
//   active edge table: the edges that cross the current line, from left to right
//   for every line, from the bottom up
//     move the line's bucket into the active edge table
//     fill between the first and the second crossing, the third and the fourth, ... (parity rule)
//     drop the edges that end on the next line, step the others to it
//
// The cases that every lecture warns of need no code of their own once an edge lives on the lines
// y_min <= y < y_max: horizontal edges live on none; a corner where both edges begin counts twice, one where
// both end not at all, one that is passed through once; neighbours share no pixel and leave none out.
//
// There is no floating point anywhere. The slides keep the crossing as x_int + x_frac / dy. Depth and colour
// are kept the same way, as whole numbers with a numerator below a common denominator, so that they are
// exact: a constant colour stays constant, no value leaves the range of the corners, and two polygons in one
// plane get the same depths. Every value is rounded to nearest once, where it is used.
//
// The option trace=yes logs every line of the fill:
//     farop render scene.nff --rasterizer scanline_fill --plugin-option trace=yes --verbose
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "farop/rasterizer.h"

enum { DEPTH, RED, GREEN, BLUE, ATTRIBUTES };

// One row of the slides' table. Frames have at most 32767 x 32767 pixels and depths stay below 2^30:
// coordinates and their differences fit 15 bits, a depth times dy fits 45.
typedef struct edge {
  struct edge* next;
  int y_max;                   // the first line above the edge
  int dx, dy;                  // from the lower to the upper end; dy > 0
  int x_int, x_frac;           // crosses the current line at x_int + x_frac / dy, 0 <= x_frac < dy
  int step_int, step_frac;     // dx / dy, split the same way
  int64_t value[ATTRIBUTES];   // on the current line, times dy
  int64_t change[ATTRIBUTES];  // from line to line, times dy
} edge;

typedef struct {
  const farop_host* host;
  const farop_frame* frame;
  bool trace;
  int32_t* depth;  // width x height, row by row, like the picture
  size_t pixels;   // room in depth
  edge** bucket;   // one for every line; all empty between two polygons
  int lines;       // room in bucket
  edge* edges;
  uint32_t corners;  // room in edges
} scanline_fill;

static farop_status refuse(const scanline_fill* self, farop_status status, const char* why) {
  self->host->log(self->host, FAROP_LOG_ERROR, why);
  return status;
}

// ---- edges
// --------------------------------------------------------------------------------------------------

static void start_edge(edge* e, const farop_vertex* low, const farop_vertex* high) {
  e->y_max = high->y;
  e->dx = high->x - low->x;
  e->dy = high->y - low->y;
  e->x_int = low->x;
  e->x_frac = 0;
  e->step_int = e->dx / e->dy;
  if (e->step_int * e->dy > e->dx)
    e->step_int--;  // division in C rounds towards zero, this has to round down
  e->step_frac = e->dx - e->step_int * e->dy;
  const int64_t from[ATTRIBUTES] = {low->z, low->r, low->g, low->b};
  const int64_t to[ATTRIBUTES] = {high->z, high->r, high->g, high->b};
  for (int a = 0; a < ATTRIBUTES; a++) {
    e->value[a] = from[a] * e->dy;
    e->change[a] = to[a] - from[a];
  }
}

// The slides add dx to x_frac and then carry into x_int until x_frac < dy: up to dx / dy times on every line.
// With the whole part of dx / dy set aside there is one carry at most.
static inline void step_up(edge* e) {
  e->x_int += e->step_int;
  e->x_frac += e->step_frac;
  if (e->x_frac >= e->dy) {
    e->x_frac -= e->dy;
    e->x_int++;
  }
  for (int a = 0; a < ATTRIBUTES; a++) e->value[a] += e->change[a];
}

// Left to right by the crossing; edges through one point by their direction, so that they are in order on the
// next line too.
static inline bool is_right_of(const edge* a, const edge* b) {
  if (a->x_int != b->x_int) return a->x_int > b->x_int;
  const int64_t frac_a = (int64_t)a->x_frac * b->dy, frac_b = (int64_t)b->x_frac * a->dy;
  if (frac_a != frac_b) return frac_a > frac_b;
  return (int64_t)a->dx * b->dy > (int64_t)b->dx * a->dy;
}

static bool is_sorted(const edge* list) {
  for (; list && list->next; list = list->next) {
    if (is_right_of(list, list->next)) return false;
  }
  return true;
}

static edge* merge(edge* a, edge* b) {
  edge* merged = NULL;
  edge** end = &merged;
  while (a && b) {
    edge** const first = is_right_of(a, b) ? &b : &a;
    *end = *first;
    end = &(*first)->next;
    *first = (*first)->next;
  }
  *end = a ? a : b;
  return merged;
}

static edge* sort_by_x(edge* list) {
  if (is_sorted(list)) return list;
  edge *middle = list, *end = list->next;  // the end walks twice as fast
  while (end && end->next) {
    middle = middle->next;
    end = end->next->next;
  }
  edge* const second_half = middle->next;
  middle->next = NULL;
  return merge(sort_by_x(list), sort_by_x(second_half));
}

// ---- spans
// --------------------------------------------------------------------------------------------------

// An attribute along a span: value + frac / denominator on the current pixel, 0 <= frac < denominator.
typedef struct {
  int64_t value, frac, step, step_frac;
} ramp;

// What the four ramps of a span have in common.
typedef struct {
  int64_t width;        // x_right - x_left, times left->dy * right->dy; > 0, below 2^45
  int64_t to_first;     // from the left crossing to the first pixel, times 2 * left->dy
  int64_t denominator;  // 2 * left->dy * width, below 2^61
} span;

// Nothing here overflows: |value_right - value_left| < 2^30 and to_first / (2 left->dy) <= x_right - x_left,
// hence |difference| < 2^60, to_first * step < 2^46 + 2^31 and to_first * rest < 2^61.
static inline ramp start_ramp(const span* s, const edge* left, const edge* right, int attribute) {
  const int64_t v_left = left->value[attribute], v_right = right->value[attribute];
  const int64_t difference = v_right * left->dy - v_left * right->dy;
  if (difference == 0) {
    return (ramp){(2 * v_left + left->dy) / (2 * left->dy), 0, 0, 0};  // flat: nothing to follow
  }
  int64_t step = difference / s->width;
  if (step * s->width > difference) step--;
  const int64_t rest = difference - step * s->width;
  // value_left + 1/2 + to_first * difference / width; the half makes rounding down round to nearest.
  const int64_t part = s->to_first * rest;
  const int64_t start = 2 * v_left + left->dy + s->to_first * step + part / s->width;
  return (ramp){start / (2 * left->dy), start % (2 * left->dy) * s->width + part % s->width, step,
                rest * 2 * left->dy};
}

static inline void next_pixel(ramp* r, int64_t denominator) {
  r->value += r->step;
  r->frac += r->step_frac;
  if (r->frac >= denominator) {
    r->frac -= denominator;
    r->value++;
  }
}

static void trace_span(const scanline_fill* self, int y, const edge* left, const edge* right, int first,
                       int end) {
  char line[160];
  const int used = snprintf(line, sizeof line, "y %d: x from %d + %d/%d to %d + %d/%d, ", y, left->x_int,
                            left->x_frac, left->dy, right->x_int, right->x_frac, right->dy);
  if (first < end) {
    snprintf(line + used, sizeof line - (size_t)used, "pixels %d..%d", first, end - 1);
  } else {
    snprintf(line + used, sizeof line - (size_t)used, "no pixel");
  }
  self->host->log(self->host, FAROP_LOG_INFO, line);
}

// The pixels of line y from the left crossing, when it is one, to before the right one.
static void fill_span(const scanline_fill* self, int y, const edge* left, const edge* right) {
  const int first = left->x_int + (left->x_frac > 0), end = right->x_int + (right->x_frac > 0);
  if (self->trace) trace_span(self, y, left, right, first, end);
  if (first >= end) return;

  const int64_t both = (int64_t)left->dy * right->dy;
  span s;
  s.width = (right->x_int - left->x_int) * both + (int64_t)right->x_frac * left->dy -
            (int64_t)left->x_frac * right->dy;
  s.to_first = left->x_frac > 0 ? 2 * (int64_t)(left->dy - left->x_frac) : 0;
  s.denominator = 2 * left->dy * s.width;
  ramp z = start_ramp(&s, left, right, DEPTH);
  ramp r = start_ramp(&s, left, right, RED);
  ramp g = start_ramp(&s, left, right, GREEN);
  ramp b = start_ramp(&s, left, right, BLUE);

  int32_t* depth = self->depth + (size_t)y * (size_t)self->frame->width;
  uint8_t* pixel = self->frame->pixels + y * self->frame->row_bytes + 3 * first;
  for (int x = first; x < end; x++) {
    if (z.value < depth[x]) {  // of equal depths the first drawn stays
      depth[x] = (int32_t)z.value;
      pixel[0] = (uint8_t)r.value;
      pixel[1] = (uint8_t)g.value;
      pixel[2] = (uint8_t)b.value;
    }
    next_pixel(&z, s.denominator);
    next_pixel(&r, s.denominator);
    next_pixel(&g, s.denominator);
    next_pixel(&b, s.denominator);
    pixel += 3;
  }
}

// ---- the fill
// -----------------------------------------------------------------------------------------------

// Drops what ends on line y and steps the rest to it.
static edge* go_to_line(edge* active, int y) {
  edge** link = &active;
  while (*link) {
    edge* const e = *link;
    if (e->y_max <= y) {
      *link = e->next;
    } else {
      step_up(e);
      link = &e->next;
    }
  }
  return sort_by_x(active);  // edges may have crossed
}

static farop_status polygon(void* instance, const farop_polygon* p) {
  scanline_fill* const self = instance;
  const int width = self->frame->width, height = self->frame->height;
  if (p->vertex_count > self->corners) {
    return refuse(self, FAROP_E_INVALID, "scanline_fill: more corners than begin_frame() announced");
  }
  int y_low = height, y_high = 0;
  for (uint32_t i = 0; i < p->vertex_count; i++) {
    const farop_vertex* const v = &p->vertices[i];
    if (v->x < 0 || v->x >= width || v->y < 0 || v->y >= height) {
      return refuse(self, FAROP_E_INVALID, "scanline_fill: a corner outside the frame");
    }
    if (v->y < y_low) y_low = v->y;
    if (v->y > y_high) y_high = v->y;
  }

  edge* e = self->edges;
  const farop_vertex* from = &p->vertices[p->vertex_count - 1];
  for (uint32_t i = 0; i < p->vertex_count; i++) {
    const farop_vertex* const to = &p->vertices[i];
    if (from->y != to->y) {
      const farop_vertex *const low = from->y < to->y ? from : to, *const high = from->y < to->y ? to : from;
      start_edge(e, low, high);
      e->next = self->bucket[low->y];
      self->bucket[low->y] = e++;
    }
    from = to;
  }

  edge* active = NULL;
  for (int y = y_low; y < y_high; y++) {
    if (self->bucket[y]) {
      active = merge(active, sort_by_x(self->bucket[y]));
      self->bucket[y] = NULL;
    }
    for (const edge* left = active; left; left = left->next->next) fill_span(self, y, left, left->next);
    active = go_to_line(active, y + 1);
  }
  return FAROP_OK;
}

// ---- the interface
// ------------------------------------------------------------------------------------------

static farop_status begin_frame(void* instance, const farop_frame* frame) {
  scanline_fill* const self = instance;
  if (frame->subpixel_bits != 0) {
    return refuse(self, FAROP_E_UNSUPPORTED,
                  "scanline_fill: whole pixels only, run it without --subpixel-bits");
  }
  const size_t pixels = (size_t)frame->width * (size_t)frame->height;
  if (pixels > self->pixels) {
    int32_t* const depth = realloc(self->depth, pixels * sizeof *depth);
    if (!depth) return FAROP_E_MEMORY;
    self->depth = depth;
    self->pixels = pixels;
  }
  if (frame->height > self->lines) {
    edge** const bucket = realloc(self->bucket, (size_t)frame->height * sizeof *bucket);
    if (!bucket) return FAROP_E_MEMORY;
    for (int y = 0; y < frame->height; y++) bucket[y] = NULL;
    self->bucket = bucket;
    self->lines = frame->height;
  }
  if (frame->max_vertices > self->corners) {
    edge* const edges = realloc(self->edges, frame->max_vertices * sizeof *edges);
    if (!edges) return FAROP_E_MEMORY;
    self->edges = edges;
    self->corners = frame->max_vertices;
  }
  // Farther than the farthest: a polygon on the far plane has to show.
  for (size_t i = 0; i < pixels; i++) self->depth[i] = INT32_MAX;
  self->frame = frame;
  return FAROP_OK;
}

static farop_status end_frame(void* instance) {
  (void)instance;  // everything was drawn when it came
  return FAROP_OK;
}

static farop_status create(const farop_host* host, void** instance) {
  scanline_fill* const self = calloc(1, sizeof *self);
  if (!self) return FAROP_E_MEMORY;
  self->host = host;
  const char* const trace = host->option(host, "trace");
  self->trace = trace && strcmp(trace, "yes") == 0;
  *instance = self;
  return FAROP_OK;
}

static void destroy(void* instance) {
  scanline_fill* const self = instance;
  free(self->depth);
  free(self->bucket);
  free(self->edges);
  free(self);
}

const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {
      .struct_size = sizeof table,
      .abi_version = FAROP_ABI_VERSION,
      .name = "scanline_fill",
      .summary = "scan-line area fill in whole numbers, with depth, Gouraud (Hearn and Baker)",
      .create = create,
      .destroy = destroy,
      .begin_frame = begin_frame,
      .polygon = polygon,
      .end_frame = end_frame,
  };
  (void)host;
  return &table;
}
