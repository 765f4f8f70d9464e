// SPDX-License-Identifier: GPL-3.0-or-later
// trapezoid - a z-buffer that cuts every polygon into trapezoids.
//
// The method of A. von Wangenheim's lecture "Computação Gráfica", INE 5341, UFSC (chapters z-Buffer and
// Conversão por Varredura; it follows K. Joy's On-Line Computer Graphics Notes, UC Davis). Depth buffers were
// first described by E. Catmull, "A Subdivision Algorithm for Computer Display of Curved Surfaces", PhD
// thesis, University of Utah, 1974.
//
//   for every polygon
//     for every trapezoid: a horizontal line through every corner, from the top down
//       two edge trackers follow its left and its right side
//       for every line: fill the pixels between the trackers that are nearer than what is there
//
// Where it departs from the lecture, and why:
//   - The lecture fills from floor(x_left) to floor(x_right), so that neighbours overlap along their common
//     edge. Here a polygon keeps its left and its bottom edge and leaves the right and the top one to its
//     neighbours: the pixels ceil(x_left) .. ceil(x_right) - 1 on the lines y_min <= y < y_top.
//   - x is followed in whole numbers with a remainder, so ceil(x) is never wrong, however long the edge.
//   - Depth steps along a line by (z_right - z_left) / (x_right - x_left). In a plane this is the lecture's
//     -n_x / n_z; rounding to pixels has bent most polygons a little, and colours never had a plane.
//   - Smaller depths are nearer here. The lecture's figures use both signs.
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>

#include "farop/rasterizer.h"

enum { DEPTH, RED, GREEN, BLUE, ATTRIBUTES };

// The edge tracker: where an edge crosses a line. It is made on the edge's upper corner and goes down.
// The crossing is x - rest / dy with 0 <= rest < dy, so x is the first pixel that is not left of it.
typedef struct {
  int y_top, y_min;                           // crosses the lines y_min <= y < y_top
  int x_top, dx, dy;                          // upper corner; from there dx to the right and dy down. dy > 0
  int x, rest;                                // on the current line
  int x_inc, rest_inc;                        // one line down is x_inc - rest_inc / dy = dx / dy further
  double value[ATTRIBUTES], inc[ATTRIBUTES];  // on the current line; per line down
} edge;

typedef struct {
  const farop_host* host;
  const farop_frame* frame;
  int32_t* depth;  // width x height, row by row, like the picture
  size_t pixels;   // room in depth
  edge* edges;
  edge **table, **active;  // see polygon()
  uint32_t corners;        // room in the three
} trapezoid;

static farop_status refuse(const trapezoid* self, farop_status status, const char* why) {
  self->host->log(self->host, FAROP_LOG_ERROR, why);
  return status;
}

// ---- edge trackers
// ------------------------------------------------------------------------------------------

static void start_edge(edge* e, const farop_vertex* top, const farop_vertex* bottom) {
  e->y_top = top->y;
  e->y_min = bottom->y;
  e->x_top = top->x;
  e->dx = bottom->x - top->x;
  e->dy = top->y - bottom->y;
  e->x = top->x;  // corners are whole numbers: the lecture's correction x_d of the start is zero
  e->rest = 0;
  e->x_inc = e->dx / e->dy;
  if (e->x_inc * e->dy < e->dx) e->x_inc++;  // division in C rounds towards zero, this has to round up
  e->rest_inc = e->x_inc * e->dy - e->dx;

  const double per_line = 1.0 / e->dy;
  const double from[ATTRIBUTES] = {top->z, top->r, top->g, top->b};
  const double to[ATTRIBUTES] = {bottom->z, bottom->r, bottom->g, bottom->b};
  for (int a = 0; a < ATTRIBUTES; a++) {
    e->value[a] = from[a];
    e->inc[a] = (to[a] - from[a]) * per_line;
  }
}

static inline void step_down(edge* e) {
  e->x += e->x_inc;
  e->rest += e->rest_inc;
  if (e->rest >= e->dy) {
    e->rest -= e->dy;
    e->x--;
  }
  for (int a = 0; a < ATTRIBUTES; a++) e->value[a] += e->inc[a];
}

// Negative, zero, positive: edge a crosses line y left of b, at the same point, right of it. Exact.
static int compare_on_line(const edge* a, const edge* b, int y) {
  const int64_t x_a = (int64_t)a->x_top * a->dy + (int64_t)a->dx * (a->y_top - y);  // times a->dy
  const int64_t x_b = (int64_t)b->x_top * b->dy + (int64_t)b->dx * (b->y_top - y);
  const int64_t left = x_a * b->dy, right = x_b * a->dy;  // below 2^47
  return (left > right) - (left < right);
}

// ---- filling
// ------------------------------------------------------------------------------------------------

// Whole numbers for the innermost loop: depth with 24 fractional bits, colours with 22. The loss over the
// widest line is less than 1/100. The half makes dropping the fraction round to nearest: a plane through
// lattice points then has the same depths in every polygon, whatever edge it is entered from.
enum { DEPTH_BITS = 24, COLOR_BITS = 22 };

static inline int64_t fixed_depth(double value) {
  return (int64_t)(value * (double)(1 << DEPTH_BITS));
}

static inline int32_t fixed_color(double value) {
  return (int32_t)(value * (double)(1 << COLOR_BITS));
}

// The pixels of line y between two trackers that stand on it.
static inline void fill_line(const trapezoid* self, int y, const edge* left, const edge* right) {
  const int count = right->x - left->x;
  if (count <= 0) return;

  // 1 / (x_right - x_left), with one division of exact numbers: a difference of two rounded crossings
  // would have no digits left where the sides almost meet.
  const int64_t both = (int64_t)left->dy * right->dy;
  const int64_t width = count * both + (int64_t)left->rest * right->dy - (int64_t)right->rest * left->dy;
  const double per_pixel = (double)both / (double)width;
  const double to_first = (double)left->rest / left->dy;  // from the crossing to the first pixel
  double start[ATTRIBUTES], step[ATTRIBUTES];
  for (int a = 0; a < ATTRIBUTES; a++) {
    step[a] = (right->value[a] - left->value[a]) * per_pixel;
    start[a] = left->value[a] + step[a] * to_first;
    if (count == 1) step[a] = 0;  // not needed, and can be huge where the sides almost meet
  }

  int64_t z = fixed_depth(start[DEPTH]) + (1 << (DEPTH_BITS - 1));
  const int64_t dz = fixed_depth(step[DEPTH]);
  // Unsigned, as the number after the last pixel may wrap around.
  const uint32_t half = 1u << (COLOR_BITS - 1);
  uint32_t r = (uint32_t)fixed_color(start[RED]) + half, dr = (uint32_t)fixed_color(step[RED]);
  uint32_t g = (uint32_t)fixed_color(start[GREEN]) + half, dg = (uint32_t)fixed_color(step[GREEN]);
  uint32_t b = (uint32_t)fixed_color(start[BLUE]) + half, db = (uint32_t)fixed_color(step[BLUE]);

  int32_t* depth = self->depth + (size_t)y * (size_t)self->frame->width + left->x;
  uint8_t* pixel = self->frame->pixels + y * self->frame->row_bytes + 3 * left->x;
  for (int i = 0; i < count; i++) {
    const int32_t here = (int32_t)(z >> DEPTH_BITS);
    if (here < depth[i]) {  // of equal depths the first drawn stays
      depth[i] = here;
      pixel[0] = (uint8_t)(r >> COLOR_BITS);
      pixel[1] = (uint8_t)(g >> COLOR_BITS);
      pixel[2] = (uint8_t)(b >> COLOR_BITS);
    }
    z += dz;
    r += dr;
    g += dg;
    b += db;
    pixel += 3;
  }
}

// The lines y_bottom <= y < y_top between two trackers that stand on line y_top.
static void fill_trapezoid(const trapezoid* self, int y_top, int y_bottom, edge* left, edge* right) {
  for (int y = y_top - 1; y >= y_bottom; y--) {
    step_down(left);
    step_down(right);
    fill_line(self, y, left, right);
  }
}

// ---- cutting into trapezoids
// --------------------------------------------------------------------------------

// From left to right in the layer of trapezoids y_bottom <= y < y_top: by the crossings with its lowest line.
// Sides that meet there are told apart on its highest, else it would seem that they cross.
static bool is_left_of(const edge* a, const edge* b, int y_bottom, int y_top) {
  const int order = compare_on_line(a, b, y_bottom);
  return order != 0 ? order < 0 : compare_on_line(a, b, y_top - 1) < 0;
}

static bool starts_above(const edge* a, const edge* b, int unused_1, int unused_2) {
  (void)unused_1, (void)unused_2;
  return a->y_top > b->y_top;
}

// D. L. Shell, "A High-Speed Sorting Procedure", Communications of the ACM 2(7), 1959: short, needs no
// memory, and for the few edges of most polygons it is an insertion sort.
static inline void sort_edges(edge** list, int count, bool (*before)(const edge*, const edge*, int, int),
                              int y_bottom, int y_top) {
  int gap = 1;
  while (gap < count / 9) gap = 3 * gap + 1;
  for (; gap > 0; gap /= 3) {
    for (int i = gap; i < count; i++) {
      edge* const moving = list[i];
      int place = i;
      while (place >= gap && before(moving, list[place - gap], y_bottom, y_top)) {
        list[place] = list[place - gap];
        place -= gap;
      }
      list[place] = moving;
    }
  }
}

static bool is_in_order_on_line(edge* const* list, int count, int y) {
  for (int i = 1; i < count; i++) {
    if (compare_on_line(list[i - 1], list[i], y) > 0) return false;
  }
  return true;
}

static void fill_polygon(trapezoid* self, int edge_count) {
  edge** const active = self->active;  // the edges that cross the layer
  int active_count = 0, next = 0;      // table[next] is the highest edge not reached yet
  int y = INT_MIN;                     // the top of the layer: what is above is drawn
  while (active_count > 0 || next < edge_count) {
    if (active_count == 0) y = self->table[next]->y_top;
    while (next < edge_count && self->table[next]->y_top == y) active[active_count++] = self->table[next++];

    // The layer reaches down to the next corner.
    int y_bottom = next < edge_count ? self->table[next]->y_top : INT_MIN;
    for (int i = 0; i < active_count; i++) {
      if (active[i]->y_min > y_bottom) y_bottom = active[i]->y_min;
    }
    sort_edges(active, active_count, is_left_of, y_bottom, y);
    if (!is_in_order_on_line(active, active_count, y - 1)) {
      // Edges cross inside the layer (rounding to pixels can do that to a thin polygon), so these are no
      // trapezoids. A layer of a single line always works.
      y_bottom = y - 1;
      sort_edges(active, active_count, is_left_of, y_bottom, y);
    }

    // Odd-even rule: inside is between the first and the second side, the third and the fourth, ...
    for (int i = 0; i + 1 < active_count; i += 2) fill_trapezoid(self, y, y_bottom, active[i], active[i + 1]);

    y = y_bottom;
    int kept = 0;
    for (int i = 0; i < active_count; i++) {
      if (active[i]->y_min < y) active[kept++] = active[i];
    }
    active_count = kept;
  }
}

// ---- the interface
// ------------------------------------------------------------------------------------------

static farop_status polygon(void* instance, const farop_polygon* p) {
  trapezoid* const self = instance;
  const int width = self->frame->width, height = self->frame->height;
  if (p->vertex_count > self->corners) {
    return refuse(self, FAROP_E_INVALID, "trapezoid: more corners than begin_frame() announced");
  }
  int count = 0;
  const farop_vertex* from = &p->vertices[p->vertex_count - 1];
  for (uint32_t i = 0; i < p->vertex_count; i++) {
    const farop_vertex* const to = &p->vertices[i];
    if (to->x < 0 || to->x >= width || to->y < 0 || to->y >= height) {
      return refuse(self, FAROP_E_INVALID, "trapezoid: a corner outside the frame");
    }
    // Horizontal edges cross no line: the sides that end on them say all there is to say.
    if (from->y > to->y) start_edge(&self->edges[count++], from, to);
    if (from->y < to->y) start_edge(&self->edges[count++], to, from);
    from = to;
  }
  for (int i = 0; i < count; i++) self->table[i] = &self->edges[i];
  sort_edges(self->table, count, starts_above, 0, 0);
  fill_polygon(self, count);
  return FAROP_OK;
}

static farop_status begin_frame(void* instance, const farop_frame* frame) {
  trapezoid* const self = instance;
  if (frame->subpixel_bits != 0) {
    return refuse(self, FAROP_E_UNSUPPORTED, "trapezoid: whole pixels only, run it without --subpixel-bits");
  }
  const size_t pixels = (size_t)frame->width * (size_t)frame->height;
  if (pixels > self->pixels) {
    int32_t* const depth = realloc(self->depth, pixels * sizeof *depth);
    if (!depth) return FAROP_E_MEMORY;
    self->depth = depth;
    self->pixels = pixels;
  }
  if (frame->max_vertices > self->corners) {
    const size_t n = frame->max_vertices;
    edge* const edges = realloc(self->edges, n * sizeof *edges);
    if (edges) self->edges = edges;
    edge** const table = realloc(self->table, n * sizeof *table);
    if (table) self->table = table;
    edge** const active = realloc(self->active, n * sizeof *active);
    if (active) self->active = active;
    if (!edges || !table || !active) return FAROP_E_MEMORY;
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
  trapezoid* const self = calloc(1, sizeof *self);
  if (!self) return FAROP_E_MEMORY;
  self->host = host;
  *instance = self;
  return FAROP_OK;
}

static void destroy(void* instance) {
  trapezoid* const self = instance;
  free(self->depth);
  free(self->edges);
  free(self->table);
  free(self->active);
  free(self);
}

const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {
      .struct_size = sizeof table,
      .abi_version = FAROP_ABI_VERSION,
      .name = "trapezoid",
      .summary = "z-buffer by trapezoids, Gouraud (Wangenheim, Joy)",
      .create = create,
      .destroy = destroy,
      .begin_frame = begin_frame,
      .polygon = polygon,
      .end_frame = end_frame,
  };
  (void)host;
  return &table;
}
