// SPDX-License-Identifier: GPL-3.0-or-later
// hostile.h - what the hostile plug-ins share, so that each file shows its deed and nothing else.
//
// The rasterizer below is right: n-gons under fill rule lb, exact integer planes for depth and colour, a
// z-buffer. It matters that it is: "right picture, hostile deed" must be judged by the deed.
//
// A plug-in is   static farop_status deed(const farop_polygon* polygon) { ... }
//                HOSTILE_PLUGIN(.before = deed)
//
// The deed is done once per process: on the polygon HOSTILE_POLYGON of the first frame that has so many,
// either before that polygon is drawn or after. So the report can be checked for naming the polygon.
//
// What a wall should have stopped and did not is said on stderr in one line that starts with "hostile-hole:
// "; what a plug-in found and should not have seen, in one that starts with "hostile-leak: "; what it tried
// to find and did not, in one that starts with "hostile-refused: ".
//
// Every deed is bounded: nothing here can take the machine down if a wall, or the whole cage, is missing.
// Loops end after HOSTILE_LONGEST_SECONDS, children after 5 s, and the bounds on numbers and sizes stand in
// each file.
#ifndef FAROP_TESTS_HOSTILE_H
#define FAROP_TESTS_HOSTILE_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE 1
#endif
#include <errno.h>
#include <farop/rasterizer.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#define HOSTILE_POLYGON 2               // the third call of polygon() in a frame
#define HOSTILE_LONGEST_SECONDS 600     // "for ever" ends here
#define HOSTILE_MARKER "farop-hostile"  // name of every child process and thread: what to scan for afterwards
#define HOSTILE_CANARY \
  "farop-canary"        // the one file name that the writing plug-ins touch; see hostile_canary()
#define HOSTILE_SKIP 1  // a hook returns this: do not draw this polygon, and report success

// Makes the compiler believe that the value is used and that memory may have changed.
#define HOSTILE_USE(value) __asm__ volatile("" : : "r"(value) : "memory")

// All hooks are optional. A negative status is handed on to the host.
struct hostile_hooks {
  farop_status (*begin)(const farop_frame* frame);       // each frame, once the depth buffer is ready
  farop_status (*before)(const farop_polygon* polygon);  // the deed, before the polygon is drawn ...
  farop_status (*after)(const farop_polygon* polygon);   // ... or after
  farop_status (*each)(const farop_polygon* polygon);    // every polygon, before it is drawn
  int (*pixel)(int32_t x, int32_t y, uint8_t* rgb);  // every pixel that won the depth test; 0: leave it out
  farop_status (*end)(void);                         // in end_frame
};

static struct hostile_state {
  const struct hostile_hooks* hooks;
  const farop_host* host;
  farop_rasterizer table;
  farop_frame frame;   // a copy of the current frame
  int32_t* depth;      // width x height
  uint8_t* crossings;  // parity of the crossings in each column of the current row, width + 1
  uint32_t frames;     // begun so far in this process
  uint32_t polygons;   // seen in this frame
  int done;            // the deed
  int silent;          // draw nothing from now on
} hostile;

// ---- the rasterizer
// -----------------------------------------------------------------------------------------

static inline int64_t hostile_floor_div(int64_t a, int64_t b) {
  int64_t q = a / b;
  return (a % b != 0 && (a < 0) != (b < 0)) ? q - 1 : q;
}

static inline int64_t hostile_clamp(int64_t value, int64_t low, int64_t high) {
  return value < low ? low : (value > high ? high : value);
}

// One attribute as a plane through three corners, kept within the range of the polygon's own corners.
struct hostile_plane {
  int64_t a, b, c, at, low, high;
};

static inline int32_t hostile_attribute(const farop_vertex* v, int which) {
  return which == 0 ? v->z : (which == 1 ? v->r : (which == 2 ? v->g : v->b));
}

static inline struct hostile_plane hostile_plane_of(const farop_polygon* p, const farop_vertex* const* corner,
                                                    int which) {
  struct hostile_plane plane;
  int64_t x1 = corner[1]->x - corner[0]->x, y1 = corner[1]->y - corner[0]->y;
  int64_t x2 = corner[2]->x - corner[0]->x, y2 = corner[2]->y - corner[0]->y;
  plane.at = hostile_attribute(corner[0], which);
  int64_t d1 = hostile_attribute(corner[1], which) - plane.at,
          d2 = hostile_attribute(corner[2], which) - plane.at;
  plane.a = d1 * y2 - d2 * y1;
  plane.b = x1 * d2 - x2 * d1;
  plane.c = x1 * y2 - x2 * y1;
  plane.low = plane.high = plane.at;
  for (uint32_t i = 0; i < p->vertex_count; ++i) {
    int64_t value = hostile_attribute(&p->vertices[i], which);
    if (value < plane.low) plane.low = value;
    if (value > plane.high) plane.high = value;
  }
  return plane;
}

static inline int64_t hostile_value(const struct hostile_plane* p, int64_t dx, int64_t dy) {
  return hostile_clamp(p->at + hostile_floor_div(p->a * dx + p->b * dy, p->c), p->low, p->high);
}

static inline void hostile_draw_row(const struct hostile_plane* plane, const farop_vertex* origin,
                                    int32_t y) {
  const farop_frame* f = &hostile.frame;
  int inside = 0;
  for (int32_t x = 0; x < f->width; ++x) {
    inside ^= hostile.crossings[x];
    if (!inside) continue;
    int32_t* depth = &hostile.depth[(size_t)y * (size_t)f->width + (size_t)x];
    int64_t dx = x - origin->x, dy = y - origin->y;
    int32_t z = (int32_t)hostile_value(&plane[0], dx, dy);
    if (z >= *depth) continue;
    uint8_t rgb[3];
    for (int i = 0; i < 3; ++i) rgb[i] = (uint8_t)hostile_value(&plane[i + 1], dx, dy);
    if (hostile.hooks->pixel && !hostile.hooks->pixel(x, y, rgb)) continue;
    *depth = z;
    memcpy(f->pixels + y * f->row_bytes + 3 * (int64_t)x, rgb, 3);
  }
}

static inline void hostile_draw(const farop_polygon* p) {
  const farop_frame* f = &hostile.frame;
  const farop_vertex* v = p->vertices;
  const farop_vertex* corner[3] = {v, v, v};
  int64_t largest = 0;  // of the fan's triangles: the steadiest plane if rounding has bent the polygon
  int32_t low = v[0].y, high = v[0].y;
  for (uint32_t i = 1; i < p->vertex_count; ++i) {
    if (v[i].y < low) low = v[i].y;
    if (v[i].y > high) high = v[i].y;
    if (i + 1 == p->vertex_count) break;
    int64_t area = (int64_t)(v[i].x - v[0].x) * (v[i + 1].y - v[0].y) -
                   (int64_t)(v[i + 1].x - v[0].x) * (v[i].y - v[0].y);
    if (area < 0) area = -area;
    if (area <= largest) continue;
    largest = area;
    corner[1] = &v[i];
    corner[2] = &v[i + 1];
  }
  if (largest == 0) return;
  struct hostile_plane plane[4];
  for (int i = 0; i < 4; ++i) plane[i] = hostile_plane_of(p, corner, i);
  if (low < 0) low = 0;
  if (high > f->height) high = f->height;
  for (int32_t y = low; y < high; ++y) {
    memset(hostile.crossings, 0, (size_t)f->width + 1);
    for (uint32_t i = 0; i < p->vertex_count; ++i) {
      const farop_vertex* from = &v[i];
      const farop_vertex* to = &v[i + 1 == p->vertex_count ? 0 : i + 1];
      if (from->y > to->y) {
        const farop_vertex* t = from;
        from = to;
        to = t;
      }
      if (y < from->y || y >= to->y) continue;
      int64_t rise = to->y - from->y;
      int64_t first = from->x - hostile_floor_div(-((int64_t)(y - from->y) * (to->x - from->x)), rise);
      hostile.crossings[hostile_clamp(first, 0, f->width)] ^= 1;
    }
    hostile_draw_row(plane, corner[0], y);
  }
}

static inline farop_status FAROP_CALL hostile_begin_frame(void* self, const farop_frame* frame) {
  (void)self;
  if (frame->subpixel_bits != 0) return FAROP_E_UNSUPPORTED;
  size_t count = (size_t)frame->width * (size_t)frame->height;
  free(hostile.depth);
  free(hostile.crossings);
  hostile.depth = (int32_t*)malloc(count * sizeof *hostile.depth);
  hostile.crossings = (uint8_t*)malloc((size_t)frame->width + 1);
  if (!hostile.depth || !hostile.crossings) return FAROP_E_MEMORY;
  for (size_t i = 0; i < count; ++i) hostile.depth[i] = frame->z_far + 1;
  hostile.frame = *frame;
  hostile.polygons = 0;
  farop_status status = hostile.hooks->begin ? hostile.hooks->begin(frame) : FAROP_OK;
  ++hostile.frames;
  return status < 0 ? status : FAROP_OK;
}

static inline farop_status FAROP_CALL hostile_polygon(void* self, const farop_polygon* polygon) {
  (void)self;
  const struct hostile_hooks* hooks = hostile.hooks;
  int now = hostile.polygons++ == HOSTILE_POLYGON && !hostile.done;
  farop_status status = FAROP_OK;
  if (now) hostile.done = 1;
  if (now && hooks->before) status = hooks->before(polygon);
  if (status == FAROP_OK && hooks->each) status = hooks->each(polygon);
  if (status == FAROP_OK && !hostile.silent) hostile_draw(polygon);
  if (status >= 0 && now && hooks->after) status = hooks->after(polygon);
  return status < 0 ? status : FAROP_OK;
}

static inline farop_status FAROP_CALL hostile_end_frame(void* self) {
  (void)self;
  return hostile.hooks->end ? hostile.hooks->end() : FAROP_OK;
}

// The table is not constant: some plug-ins return it damaged.
static inline farop_rasterizer* hostile_start(const farop_host* host, const struct hostile_hooks* hooks) {
  hostile.host = host;
  hostile.hooks = hooks;
  farop_rasterizer* table = &hostile.table;
  table->struct_size = sizeof *table;
  table->abi_version = FAROP_ABI_VERSION;
  table->name = "hostile";
  table->summary = "a right picture and a test of the walls";
  table->begin_frame = hostile_begin_frame;
  table->polygon = hostile_polygon;
  table->end_frame = hostile_end_frame;
  return table;
}

#define HOSTILE_PLUGIN(...)                                                                        \
  FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) { \
    static const struct hostile_hooks hooks = {__VA_ARGS__};                                       \
    return hostile_start(host, &hooks);                                                            \
  }

// ---- for the deeds
// ------------------------------------------------------------------------------------------

// Seconds on the monotonic clock; answered without entering the kernel where there is a vDSO.
static inline double hostile_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline void hostile_sleep(double seconds) {
  struct timespec t = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
  nanosleep(&t, NULL);
}

static inline void hostile_spin(double seconds) {
  for (double end = hostile_now() + seconds; hostile_now() < end;)
    for (int i = 0; i < 100000; ++i) HOSTILE_USE(i);
}

// A null pointer that the compiler cannot know to be one: it removes functions that it proves to fail.
static inline void hostile_crash(void) {
  static volatile int* volatile nowhere;
  *nowhere = 1;
}

// For ever, as far as any harness can tell; then the process ends, so that a forgotten one does not burn on.
__attribute__((noreturn)) static inline void hostile_loop(void) {
  hostile_spin(HOSTILE_LONGEST_SECONDS);
  _exit(1);
}

// The option `suite` keeps tests that run at the same time apart: it is part of the names below.
static inline const char* hostile_suite(void) {
  const char* suite = hostile.host ? hostile.host->option(hostile.host, "suite") : NULL;
  return suite ? suite : "";
}

// FOLDER/farop-canary, or FOLDER/farop-canary-SUITE, and `suffix` behind it.
static inline void hostile_canary(char* path, size_t size, const char* folder, const char* suffix) {
  const char* suite = hostile_suite();
  snprintf(path, size, "%s/" HOSTILE_CANARY "%s%s%s", folder, *suite ? "-" : "", suite, suffix);
}

// Names the calling thread: farop-hostile, or hostile-SUITE (up to 15 characters fit).
static inline void hostile_mark(void) {
  char name[16] = HOSTILE_MARKER;
  const char* suite = hostile_suite();
  if (*suite) snprintf(name, sizeof name, "hostile-%s", suite);
  prctl(PR_SET_NAME, name);
}

static inline void hostile_say(const char* text) {
  if (write(STDERR_FILENO, text, strlen(text)) < 0) return;  // a closed or full pipe is not our concern
}

static inline void hostile_found(const char* kind, const char* what, const char* detail) {
  char line[512];
  snprintf(line, sizeof line, "%s: %s%s%s\n", kind, what, detail ? ": " : "", detail ? detail : "");
  hostile_say(line);
}

// `result` is what a system call returned that a wall has to refuse.
static inline void hostile_must_fail(const char* what, long result) {
  if (result >= 0) hostile_found("hostile-hole", what, NULL);
}

// True for a child of the judge: it leads a session of its own, or may not even ask. Deeds aimed at the
// parent are not done otherwise: a plug-in that is loaded by hand must not hit somebody's shell.
static inline int hostile_caged(void) {
  long session = syscall(SYS_getsid, 0);
  return session < 0 || session == getpid();
}

// The judge's process id, or 0 where there is none to aim at (loaded by hand; parent outside the pid
// namespace).
static inline pid_t hostile_judge(void) {
  pid_t parent = getppid();
  return hostile_caged() && parent > 1 ? parent : 0;
}

// fstat by its own number: libc uses another call that a filter may not know.
static inline int hostile_fstat(int fd, struct stat* out) {
  return (int)syscall(SYS_fstat, fd, out);
}

// A socket, or something in a cage that does not let us ask. Never a descriptor of a process outside a cage.
static inline int hostile_is_control(int fd) {
  struct stat s;
  if (hostile_fstat(fd, &s) == 0) return S_ISSOCK(s.st_mode) && hostile_caged();
  return errno != EBADF;
}

// Shared memory without a name: the frame or the scene, never a file of somebody.
static inline int hostile_is_memory(int fd) {
  struct stat s;
  return hostile_fstat(fd, &s) == 0 && S_ISREG(s.st_mode) && s.st_nlink == 0;
}

// The pages that hold the frame; the first and the last may hold something else too.
static inline void hostile_frame_pages(uintptr_t* first, size_t* bytes) {
  uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
  uintptr_t start = (uintptr_t)hostile.frame.pixels;
  uintptr_t end = start + (uintptr_t)(hostile.frame.row_bytes * hostile.frame.height);
  *first = start / page * page;
  *bytes = (end + page - 1) / page * page - *first;
}

static inline uint8_t* hostile_frame_end(void) {
  return hostile.frame.pixels + hostile.frame.row_bytes * hostile.frame.height;
}

// Says that a deed came to nothing, so that a test can tell that from one that was never tried.
static inline void hostile_refused(const char* what) {
  hostile_found("hostile-refused", what, strerror(errno));
}

// Reads the start of a file and says that it could, or could not. What is in it is shown to nobody, the
// author of the test included.
static inline void hostile_read(const char* path) {
  int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) {
    hostile_refused(path);
    return;
  }
  char text[64];
  ssize_t n = read(fd, text, sizeof text);
  close(fd);
  if (n > 0) hostile_found("hostile-leak", path, "opened and read");
}

#endif  // FAROP_TESTS_HOSTILE_H
