/* SPDX-License-Identifier: GPL-3.0-or-later
 * SIPP's primitives: new objects around the origin, identity matrix. Null for sizes or resolutions that make
 * none. Last arguments: description and shader, and the texture mapping. */
#ifndef SIPP_PRIMITIVES_H
#define SIPP_PRIMITIVES_H

#include "sipp.h"

#define WORLD 0
#define CYLINDRICAL 1
#define SPHERICAL 2
#define NATURAL 3

#define SIPP_LOOK_ void *description, Shader *shader, int texture

EXTERN Object* sipp_torus _ANSI_ARGS_((double big_radius, double small_radius, int res_big, int res_small,
                                       SIPP_LOOK_));
EXTERN Object* sipp_cone _ANSI_ARGS_((double bottom_radius, double top_radius, double length, int res,
                                      SIPP_LOOK_));
EXTERN Object* sipp_cylinder _ANSI_ARGS_((double radius, double length, int res, SIPP_LOOK_));
EXTERN Object* sipp_ellipsoid _ANSI_ARGS_((double x_radius, double y_radius, double z_radius, int res,
                                           SIPP_LOOK_));
EXTERN Object* sipp_sphere _ANSI_ARGS_((double radius, int res, SIPP_LOOK_));
/* Points counter-clockwise seen from +z; their z does not count. */
EXTERN Object* sipp_prism _ANSI_ARGS_((int count, Vector* points, double length, SIPP_LOOK_));
EXTERN Object* sipp_block _ANSI_ARGS_((double x_size, double y_size, double z_size, SIPP_LOOK_));
EXTERN Object* sipp_cube _ANSI_ARGS_((double size, SIPP_LOOK_));
EXTERN Object* sipp_bezier_file _ANSI_ARGS_((FILE * file, int res, SIPP_LOOK_));
/* Indices from 0: 16 a patch, 4 a curve. */
EXTERN Object* sipp_bezier_patches _ANSI_ARGS_((int vertex_count, Vector* vertices, int patch_count,
                                                int* indices, int res, SIPP_LOOK_));
EXTERN Object* sipp_bezier_rotcurve _ANSI_ARGS_((int vertex_count, Vector* vertices, int curve_count,
                                                 int* indices, int res, SIPP_LOOK_));
EXTERN Object* sipp_teapot _ANSI_ARGS_((int res, SIPP_LOOK_));
EXTERN Object* sipp_teapot_body _ANSI_ARGS_((int res, SIPP_LOOK_));
EXTERN Object* sipp_teapot_lid _ANSI_ARGS_((int res, SIPP_LOOK_));
EXTERN Object* sipp_teapot_spout _ANSI_ARGS_((int res, SIPP_LOOK_));
EXTERN Object* sipp_teapot_handle _ANSI_ARGS_((int res, SIPP_LOOK_));

#endif
