/* SPDX-License-Identifier: MIT
 * farop/rasterizer.h - the binary contract between FAROP and a rasterizer.
 *
 * A rasterizer is a shared library that exports ONE function,
 * farop_rasterizer_entry, and links against nothing of FAROP.  FAROP clips,
 * lights and projects the scene, then calls polygon() once for every polygon
 * that survived; the rasterizer turns it into pixels.
 *
 *   entry --> create --> begin_frame --> polygon ... polygon --> end_frame --> destroy
 *                            ^                                       |
 *                            +------------- next frame --------------+
 *
 * This header is C99 and C++11.  All strings are UTF-8, NUL-terminated.
 *
 * THREADS.  FAROP makes every call for one instance from one thread, one call
 * at a time.  A rasterizer may start threads of its own; they may call
 * host->log() and nothing else, and must be idle before end_frame() returns.
 *
 * LIFETIME.  The table returned by the entry lives until the process ends.
 * The host lives as long as the process.  farop_frame and the memory it points
 * to live from begin_frame() to the return of end_frame(), or of the call that
 * failed.  farop_polygon and all it points to live only until polygon()
 * returns: copy what you keep.
 *
 * MEMORY.  Whoever allocates frees.  No block ever changes owner.
 *
 * ERRORS.  Never let a C++ exception, a Rust panic or a longjmp leave a
 * function of the table.  Return a negative status; log one line first unless
 * the status says it all.  After a negative status from begin_frame(),
 * polygon() or end_frame() the frame is lost: FAROP reports what it was told
 * and then calls either begin_frame() for a new frame or destroy().
 *
 * FLOATING POINT.  Return with the rounding mode and the flush-to-zero bits as
 * you found them (so do not link with -ffast-math).
 *
 * GROWTH.  Structs passed one at a time begin with struct_size and grow only
 * at the end, in minor versions.  Structs that stand in arrays (farop_vertex,
 * farop_vec3) never grow; a new attribute is a new parallel array.  Use
 * FAROP_HAS() before touching a member that is younger than version 1.0.
 */
#ifndef FAROP_RASTERIZER_H
#define FAROP_RASTERIZER_H

#include <stddef.h>
#include <stdint.h>

#define FAROP_ABI_MAJOR 1u /* changes when an old plugin could misbehave */
#define FAROP_ABI_MINOR 0u /* changes when something was appended        */
#define FAROP_ABI_VERSION ((FAROP_ABI_MAJOR << 16) | FAROP_ABI_MINOR)

#if defined(_WIN32)
#define FAROP_CALL __cdecl
#define FAROP_EXPORT __declspec(dllexport)
#else
#define FAROP_CALL
#define FAROP_EXPORT __attribute__((visibility("default")))
#endif

/* True when the sender of *ptr knew the member. */
#define FAROP_HAS(type, ptr, member) ((ptr)->struct_size >= offsetof(type, member) + sizeof((ptr)->member))

#ifdef __cplusplus
extern "C" {
#endif

/* ---- small words ---------------------------------------------------------- */

typedef int32_t farop_status;
enum {
  FAROP_OK = 0,
  FAROP_E_MEMORY = -1,      /* an allocation failed                         */
  FAROP_E_UNSUPPORTED = -2, /* a legal request this rasterizer cannot serve */
  FAROP_E_INVALID = -3,     /* the host broke this contract                 */
  FAROP_E_INTERNAL = -4     /* anything else; the log says what             */
};

typedef int32_t farop_log_level;
enum { FAROP_LOG_DEBUG = 0, FAROP_LOG_INFO = 1, FAROP_LOG_WARNING = 2, FAROP_LOG_ERROR = 3 };

/* Eye space: origin at the eye, x right, y up, z along the view direction, so
 * that z is the distance in front of the eye (left-handed); scene units.  The
 * vector to the eye is -position; a normal that faces the viewer has
 * normal . position < 0. */
typedef struct farop_vec3 {
  float x, y, z;
} farop_vec3;

/* One corner on the screen.  16 bytes, frozen for major version 1.
 * x, y  column and row in units of 1/2^subpixel_bits pixel, row 0 at the bottom;
 *       a whole number names the centre of a pixel (with --y-down the rows
 *       count from the top, here and in memory).  Always on the frame:
 *       0 <= x <= (width - 1) << subpixel_bits, and likewise y, so a
 *       rasterizer that stays between its corners needs no clipping.
 * z     depth, frame->z_near (closest) .. frame->z_far (farthest).
 * r,g,b lit colour, 0..255, linear ramp (no gamma); reserved is 0. */
typedef struct farop_vertex {
  int32_t x, y, z;
  uint8_t r, g, b, reserved;
} farop_vertex;

/* Surface of the polygon before lighting.  Components 0..1 unless said. */
typedef struct farop_material {
  uint32_t struct_size;
  uint32_t id;      /* same id <=> same surface of the scene                 */
  float color[3];   /* red, green, blue                                      */
  float ambient;    /* Ka                                                    */
  float diffuse;    /* Kd                                                    */
  float specular;   /* Ks                                                    */
  float shininess;  /* Phong exponent, >= 0                                  */
  float opacity[3]; /* red, green, blue; 1 = opaque, 0 = invisible (1 - T)   */
} farop_material;

enum {
  FAROP_POLYGON_CONVEX = 1u << 0,     /* convex in screen coordinates         */
  FAROP_POLYGON_BACK_FACING = 1u << 1 /* with --two-sided, and from flat files */
};

/* vertex_ids entry of a corner that clipping made. */
#define FAROP_NO_VERTEX_ID 0xFFFFFFFFu

/* One polygon, no holes; clipping a concave one may leave bridges (an edge
 * walked twice).  A front-facing one runs counter-clockwise as seen on the
 * screen, which with y pointing up means
 *     sum of (x[i] * y[i+1] - x[i+1] * y[i])  >  0   (< 0 under --y-down).
 * Rounding to the pixel grid may leave zero area: draw nothing, return FAROP_OK.
 * It may also turn over or cross a polygon thinner than a pixel: the odd-even
 * count still says what is inside; go by flags for facing, not by the sum.
 * Arrays have vertex_count entries; an optional array is NULL unless the
 * rasterizer asked for it and the scene has it (a flat file has none). */
typedef struct farop_polygon {
  uint32_t struct_size;
  uint32_t vertex_count;           /* 3 .. frame->max_vertices               */
  const farop_vertex* vertices;    /* never NULL                             */
  const farop_vec3* normals;       /* FAROP_WANT_NORMALS: unit length        */
  const farop_vec3* eye_positions; /* FAROP_WANT_EYE_POSITIONS               */
  const uint32_t* vertex_ids;      /* FAROP_WANT_VERTEX_IDS: equal id <=> the
                                      very same corner of the same surface
                                      of the same object                     */
  const farop_material* material;  /* FAROP_WANT_MATERIAL                    */
  uint32_t index;                  /* 0, 1, 2 ... within the frame: the
                                      record's number in the flat file       */
  uint32_t flags;                  /* FAROP_POLYGON_*                        */
  uint32_t surface_id, object_id;  /* always set; 0 from a flat file         */
} farop_polygon;

/* What is to be drawn on.  The host owns pixels and has already filled it with
 * the background; the rasterizer may read and write it until end_frame()
 * returns.  Pixel (x, y) is the three bytes R, G, B at
 * pixels + y * row_bytes + 3 * x.  Bytes past 3 * width of a row are not yours. */
typedef struct farop_frame {
  uint32_t struct_size;
  int32_t width, height; /* pixels, 1 .. 32767                           */
  int32_t subpixel_bits; /* 0 .. 8; 0 = whole pixels                     */
  int32_t z_near, z_far; /* 0 <= z_near < z_far < 2^30; usually 0, 65535 */
  uint32_t max_vertices; /* an upper bound for this frame                */
  uint32_t number;       /* 0, 1, 2 ... since create()                   */
  int64_t row_bytes;     /* >= 3 * width, always positive                */
  uint8_t* pixels;       /* NULL when FAROP_DRAWS_ELSEWHERE was set      */
  uint8_t background[4]; /* R, G, B, 0                                   */
  uint32_t reserved;     /* 0                                            */
} farop_frame;

/* ---- what the host offers ------------------------------------------------- */

typedef struct farop_host {
  uint32_t struct_size;
  uint32_t abi_version; /* FAROP_ABI_VERSION the host was built with          */
  const char* name;     /* e.g. "farop 1.2.0"; for messages, not for tests    */

  /* Writes one line.  Any thread, any time. */
  void(FAROP_CALL* log)(const struct farop_host* host, farop_log_level level, const char* text);

  /* Value of `--plugin-option key=value`, or NULL.  Valid for the process. */
  const char*(FAROP_CALL* option)(const struct farop_host* host, const char* key);

  /* Optional service by name, e.g. "farop.tiles/1", or NULL.  Experiments
   * start here and move into this struct once they have proved themselves. */
  const void*(FAROP_CALL* extension)(const struct farop_host* host, const char* id);
} farop_host;

/* ---- what the rasterizer offers ------------------------------------------- */

enum {
  FAROP_WANT_TRIANGLES = 1u << 0,     /* send nothing but triangles           */
  FAROP_WANT_NORMALS = 1u << 1,       /* fill farop_polygon.normals           */
  FAROP_WANT_EYE_POSITIONS = 1u << 2, /* fill farop_polygon.eye_positions     */
  FAROP_WANT_VERTEX_IDS = 1u << 3,    /* fill farop_polygon.vertex_ids        */
  FAROP_WANT_MATERIAL = 1u << 4,      /* fill farop_polygon.material          */
  FAROP_DRAWS_ELSEWHERE = 1u << 5     /* own window or device: no pixel buffer */
};

typedef struct farop_rasterizer {
  uint32_t struct_size; /* sizeof(farop_rasterizer) when you compiled         */
  uint32_t abi_version; /* FAROP_ABI_VERSION when you compiled                */
  const char* name;     /* short id, [a-z0-9_-]+, shown by `farop plugins`    */
  const char* summary;  /* one line: author, algorithm                        */
  uint32_t wants;       /* FAROP_WANT_* | FAROP_DRAWS_ELSEWHERE               */
  uint32_t reserved;    /* 0                                                  */

  /* Optional (NULL = no state).  On success stores the handle that all other
   * calls get as `self`; on failure stores nothing and needs no destroy(). */
  farop_status(FAROP_CALL* create)(const farop_host* host, void** self);
  /* Optional.  Called once for every successful create(). */
  void(FAROP_CALL* destroy)(void* self);

  /* Required. */
  farop_status(FAROP_CALL* begin_frame)(void* self, const farop_frame* frame);
  farop_status(FAROP_CALL* polygon)(void* self, const farop_polygon* polygon);
  /* Required.  All pixels must be in place when it returns; the timer stops. */
  farop_status(FAROP_CALL* end_frame)(void* self);
} farop_rasterizer;

/* The one exported symbol.  Called once, before anything else.  Returns a table
 * with static lifetime, or NULL after logging why this host will not do. */
FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host);
#define FAROP_ENTRY_SYMBOL "farop_rasterizer_entry"

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* FAROP_RASTERIZER_H */
