/* SPDX-License-Identifier: GPL-3.0-or-later
 * SIPP 3.1's C interface, rendered by FAROP. For programs in C, from K&R C (gcc -std=gnu89) onwards:
 *
 *     cc teapot.c $(pkg-config --cflags --libs sipp) -lm -o teapot
 *
 * Everything is late bound: shader parameters, matrices, lights and cameras are read when something is
 * rendered. One thread at a time. Messages go to stderr; functions that return pointers then return a null
 * pointer. FAROP's document "SIPP programs in C" tells what differs from the original. */
#ifndef SIPP_H
#define SIPP_H

#include <stdio.h>
#include <string.h>
#include <sys/types.h>

#include "geometric.h"

#ifndef __u_char_defined
typedef unsigned char u_char;
#define __u_char_defined
#endif

/* `bool` is an int for the library, whatever it is for the program. */
typedef int Sipp_bool;
#if !defined(__cplusplus) && !defined(bool) && !(defined(__STDC_VERSION__) && __STDC_VERSION__ >= 202311L)
typedef int bool;
#endif
#ifndef TRUE
#define TRUE 1
#endif
#ifndef FALSE
#define FALSE 0
#endif

/* Uniform in [-1, 1), from drand48(), which noise and shadows draw from too. */
#define RANDOM() (2.0 * sipp_random() - 1.0)

/* Modes of rendering. */
#define PHONG 0
#define GOURAUD 1
#define FLAT 2
#define LINE 3
/* Order of the rows of an image. */
#define TOP_TO_BOTTOM 0
#define BOTTOM_TO_TOP 1
/* Fields: rows of one parity, counted from 0 at the top. */
#define EVEN 0
#define ODD 1
#define BOTH 2
/* Lights. */
#define LIGHT_DIRECTION 0
#define LIGHT_POINT 1
#define SPOT_SHARP 2
#define SPOT_SOFT 3

typedef struct {
  double red, grn, blu;
} Color;

typedef struct {
  Vector position, lookat, up;
  double focal_ratio; /* tangent of half the angle of view across the smaller side of the image */
} Camera;

/* Parameters of basic_shader(). */
typedef struct {
  double ambient, specular;
  double c3; /* width of the highlight: 0 tight, 1 broad */
  Color color, opacity;
} Surf_desc;

/* May precede a description or the data of a deformation: see sipp_surface_desc_headers(). */
typedef struct {
  int ref_count;
  void (*free_func)(); /* gets the address of the header; null: the memory is nobody's business here */
  void* client_data;
} Surf_desc_hdr;

#define SIPP_SURF_HDR_ALLOC(type) ((Surf_desc_hdr*)smalloc((int)(sizeof(Surf_desc_hdr) + sizeof(type))))
#define SIPP_SURFP_HDR(type, hdr) ((type*)((Surf_desc_hdr*)(hdr) + 1))

#ifdef __cplusplus
typedef void Shader(...);
#else
typedef void Shader();
#endif
typedef void FFD_func _ANSI_ARGS_((void* data, Vector* pos, Vector* tex, Vector* new_pos, Vector* new_tex));
typedef void Update_func _ANSI_ARGS_((void* client_data));

typedef struct SippSurface Surface; /* opaque */

typedef struct SippObject {
  Surface** surfaces;
  int num_surfaces;
  int max_surfaces;
  struct SippObject** sub_objs;
  int num_sub_objs;
  int max_sub_objs;
  Transf_mat transf;
  int ref_count;
} Object;

typedef struct SippLightsource {
  Color color;
  Sipp_bool active;
  int type;
  void* info;   /* the library's */
  void* shadow; /* the library's */
  struct SippLightsource* next;
} Lightsource;

EXTERN char* SIPP_VERSION;
EXTERN Object* sipp_world;
EXTERN Camera* sipp_camera; /* the active one */

/* Setup. sipp_init() comes first; called again it starts over with an empty world. */
EXTERN void sipp_init _ANSI_ARGS_((void));
EXTERN void sipp_show_backfaces _ANSI_ARGS_((Sipp_bool flag));
EXTERN void sipp_render_direction _ANSI_ARGS_((int direction));
EXTERN void sipp_background _ANSI_ARGS_((double red, double grn, double blu));
/* `func` is called whenever more than `period` points were shaded or pixels delivered; null: not at all. */
EXTERN void sipp_set_update_callback _ANSI_ARGS_((Update_func * func, void* client_data, int period));
/* Shadows of spots that have them switched on, by depth maps of size x size (0: 256), made anew for every
 * image. */
EXTERN void sipp_shadows _ANSI_ARGS_((Sipp_bool flag, int size));
/* These return the old value. */
EXTERN Sipp_bool sipp_user_refcount _ANSI_ARGS_((Sipp_bool flag));
/* TRUE: descriptions (data of deformations) that are given from now on are addresses of headers. */
EXTERN Sipp_bool sipp_surface_desc_headers _ANSI_ARGS_((Sipp_bool flag));
EXTERN Sipp_bool sipp_ffd_desc_headers _ANSI_ARGS_((Sipp_bool flag));

/* Surfaces. Vertices counter-clockwise seen from the front. */
EXTERN void vertex_push _ANSI_ARGS_((double x, double y, double z));
EXTERN void vertex_tx_push _ANSI_ARGS_((double x, double y, double z, double u, double v, double w));
EXTERN void vertex_n_push _ANSI_ARGS_((double x, double y, double z, double nx, double ny, double nz));
EXTERN void vertex_tx_n_push _ANSI_ARGS_((double x, double y, double z, double u, double v, double w,
                                          double nx, double ny, double nz));
EXTERN void polygon_push _ANSI_ARGS_((void));
/* Null when no polygon was pushed. */
EXTERN Surface* surface_create _ANSI_ARGS_((void* description, Shader* shader));
EXTERN Surface* surface_basic_create _ANSI_ARGS_((double ambient, double red, double grn, double blu,
                                                  double specular, double c3, double opacity_red,
                                                  double opacity_grn, double opacity_blu));
EXTERN void surface_set_shader _ANSI_ARGS_((Surface * surface, void* description, Shader* shader));
EXTERN void surface_basic_shader _ANSI_ARGS_((Surface * surface, double ambient, double red, double grn,
                                              double blu, double specular, double c3, double opacity_red,
                                              double opacity_grn, double opacity_blu));
/* A deformation, applied to all vertices whenever something is rendered; null: none. */
EXTERN void surface_set_ffd _ANSI_ARGS_((Surface * surface, FFD_func* func, void* data));
EXTERN void surface_unref _ANSI_ARGS_((Surface * surface));
EXTERN void surface_desc_unref _ANSI_ARGS_((Surf_desc_hdr * header));

/* Objects. */
EXTERN Object* object_create _ANSI_ARGS_((void));
/* A new node that shares surfaces and sub-objects; identity matrix. */
EXTERN Object* object_instance _ANSI_ARGS_((Object * object));
/* Nodes are copied, surfaces shared; all matrices of the copy are identities. */
EXTERN Object* object_dup _ANSI_ARGS_((Object * object));
/* Surfaces are copied too. */
EXTERN Object* object_deep_dup _ANSI_ARGS_((Object * object));
EXTERN void object_unref _ANSI_ARGS_((Object * object));
EXTERN void object_delete _ANSI_ARGS_((Object * object)); /* the same */
EXTERN void object_add_surface _ANSI_ARGS_((Object * object, Surface* surface));
EXTERN Sipp_bool object_sub_surface _ANSI_ARGS_((Object * object, Surface* surface));
EXTERN void object_add_subobj _ANSI_ARGS_((Object * object, Object* sub_object));
EXTERN Sipp_bool object_sub_subobj _ANSI_ARGS_((Object * object, Object* sub_object));
EXTERN void object_set_transf _ANSI_ARGS_((Object * object, Transf_mat* matrix));
/* Null `matrix`: allocates the result. */
EXTERN Transf_mat* object_get_transf _ANSI_ARGS_((Object * object, Transf_mat* matrix));
EXTERN void object_clear_transf _ANSI_ARGS_((Object * object));
EXTERN void object_transform _ANSI_ARGS_((Object * object, Transf_mat* matrix));
EXTERN void object_rot_x _ANSI_ARGS_((Object * object, double angle));
EXTERN void object_rot_y _ANSI_ARGS_((Object * object, double angle));
EXTERN void object_rot_z _ANSI_ARGS_((Object * object, double angle));
EXTERN void object_rot _ANSI_ARGS_((Object * object, Vector* point, Vector* vector, double angle));
EXTERN void object_scale _ANSI_ARGS_((Object * object, double sx, double sy, double sz));
EXTERN void object_move _ANSI_ARGS_((Object * object, double dx, double dy, double dz));

/* Lights. Of a directional one x y z is the direction towards it. */
EXTERN Lightsource* lightsource_create _ANSI_ARGS_((double x, double y, double z, double red, double grn,
                                                    double blu, int type));
/* `opening`: full angle of the cone, degrees. */
EXTERN Lightsource* spotlight_create _ANSI_ARGS_((double x, double y, double z, double to_x, double to_y,
                                                  double to_z, double opening, double red, double grn,
                                                  double blu, int type, Sipp_bool shadow));
EXTERN void light_destruct _ANSI_ARGS_((Lightsource * light));
EXTERN void lightsource_put _ANSI_ARGS_((Lightsource * light, double x, double y, double z));
EXTERN void spotlight_pos _ANSI_ARGS_((Lightsource * light, double x, double y, double z));
EXTERN void spotlight_at _ANSI_ARGS_((Lightsource * light, double x, double y, double z));
EXTERN void spotlight_opening _ANSI_ARGS_((Lightsource * light, double opening));
EXTERN void spotlight_shadows _ANSI_ARGS_((Lightsource * light, Sipp_bool flag));
EXTERN void light_color _ANSI_ARGS_((Lightsource * light, double red, double grn, double blu));
EXTERN void light_active _ANSI_ARGS_((Lightsource * light, Sipp_bool flag));
/* What arrives at `position` (0..1) and the unit vector from there to the light. */
EXTERN double light_eval _ANSI_ARGS_((Lightsource * light, Vector* position, Vector* to_light));

/* Cameras. */
EXTERN Camera* camera_create _ANSI_ARGS_((void));
EXTERN void camera_destruct _ANSI_ARGS_((Camera * camera));
EXTERN void camera_position _ANSI_ARGS_((Camera * camera, double x, double y, double z));
EXTERN void camera_look_at _ANSI_ARGS_((Camera * camera, double x, double y, double z));
EXTERN void camera_up _ANSI_ARGS_((Camera * camera, double x, double y, double z));
EXTERN void camera_focal _ANSI_ARGS_((Camera * camera, double ratio));
EXTERN void camera_params _ANSI_ARGS_((Camera * camera, double x, double y, double z, double to_x,
                                       double to_y, double to_z, double up_x, double up_y, double up_z,
                                       double ratio));
EXTERN void camera_use _ANSI_ARGS_((Camera * camera));

/* Rendering. Files are PPM, in LINE mode PBM. Pixels: (void *data, int x, int y, u_char r, u_char g, u_char
 * b), rows counted from the top; lines: (void *data, int x1, int y1, int x2, int y2). */
EXTERN void render_image_file _ANSI_ARGS_((int width, int height, FILE* file, int mode, int oversampling));
EXTERN void render_image_func _ANSI_ARGS_((int width, int height, void (*func)(), void* data, int mode,
                                           int oversampling));
EXTERN void render_field_file _ANSI_ARGS_((int width, int height, FILE* file, int mode, int oversampling,
                                           int field));
EXTERN void render_field_func _ANSI_ARGS_((int width, int height, void (*func)(), void* data, int mode,
                                           int oversampling, int field));
/* From the update callback, a shader or a pixel function: gives up what is being rendered. */
EXTERN void sipp_render_terminate _ANSI_ARGS_((void));
/* Depth maps of the world as it is now, used until they are destroyed (0: 256). */
EXTERN void shadowmaps_create _ANSI_ARGS_((int size));
EXTERN void shadowmaps_destruct _ANSI_ARGS_((void));

EXTERN void basic_shader _ANSI_ARGS_((Vector * position, Vector* normal, Vector* texture, Vector* view_vec,
                                      Lightsource* lights, Surf_desc* description, Color* color,
                                      Color* opacity));

/* Memory. Running out of it ends the program with a message. */
EXTERN void* smalloc _ANSI_ARGS_((size_t size));
EXTERN void* scalloc _ANSI_ARGS_((size_t size, size_t item_size));
EXTERN void* srealloc _ANSI_ARGS_((void* memory, size_t size));
EXTERN void sfree _ANSI_ARGS_((void* memory));
EXTERN double sipp_random _ANSI_ARGS_((void)); /* uniform in [0, 1) */

/* FAROP's own. Every following render call writes the scene into `file` instead of drawing it, as NFF or as
 * screen-coordinate flat file by its suffix (.nff, .scr); from the second one on numbered. Null: draw again.
 * Returns FALSE for another suffix. The environment variable FAROP_CAPTURE does the same for programs as they
 * are. */
EXTERN Sipp_bool farop_sipp_capture _ANSI_ARGS_((CONST char* file));
/* TRUE: draw as well. Environment: FAROP_CAPTURE_DRAW=1. */
EXTERN void farop_sipp_capture_draw _ANSI_ARGS_((Sipp_bool flag));

/* Names from before 3.0. */
#define object_install(object) object_add_subobj(sipp_world, object);
#define object_uninstall(object) object_sub_subobj(sipp_world, object);
#define view_from(x, y, z) camera_position(sipp_camera, x, y, z)
#define view_at(x, y, z) camera_look_at(sipp_camera, x, y, z)
#define view_up(x, y, z) camera_up(sipp_camera, x, y, z)
#define view_focal(ratio) camera_focal(sipp_camera, ratio)
#define viewpoint(x, y, z, to_x, to_y, to_z, up_x, up_y, up_z, ratio) \
  camera_params(sipp_camera, x, y, z, to_x, to_y, to_z, up_x, up_y, up_z, ratio)
#define lightsource_push(x, y, z, i) lightsource_create(x, y, z, i, i, i, LIGHT_DIRECTION)
#define render_image_pixmap(width, height, data, func, mode, oversampling) \
  render_image_func(width, height, func, data, mode, oversampling)

#endif
