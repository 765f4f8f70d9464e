/* SPDX-License-Identifier: GPL-3.0-or-later
 * SIPP's vectors and matrices. Row vectors; a matrix has three columns, its rows 0..2 are the images of the
 * axes, row 3 is the translation. Operations on matrices apply after what is there already. Angles in
 * radians.
 *
 * The macros take structures, not pointers, result first; a result may also be an argument. Those that set
 * something are blocks, usable with and without a semicolon. */
#ifndef SIPP_GEOMETRIC_H
#define SIPP_GEOMETRIC_H

#include <math.h>

#ifdef __cplusplus
#define SIPP_LINKAGE extern "C"
#else
#define SIPP_LINKAGE extern
#endif
#if defined(__GNUC__)
#define SIPP_PUBLIC __attribute__((visibility("default")))
#else
#define SIPP_PUBLIC
#endif
#ifndef EXTERN
#define EXTERN SIPP_LINKAGE SIPP_PUBLIC
#endif
#ifndef _ANSI_ARGS_
#define _ANSI_ARGS_(arguments) arguments /* NOLINT: SIPP has this name */
#endif
#ifndef CONST
#define CONST const
#endif
#ifndef M_PI
#define M_PI 3.14159265358979323846
#endif

typedef struct {
  double x, y, z;
} Vector;

typedef struct {
  double mat[4][3];
} Transf_mat;

EXTERN Transf_mat ident_matrix;

#define MakeVector(V, xx, yy, zz) \
  {                               \
    (V).x = (xx);                 \
    (V).y = (yy);                 \
    (V).z = (zz);                 \
  }
#define VecNegate(A) \
  {                  \
    (A).x = -(A).x;  \
    (A).y = -(A).y;  \
    (A).z = -(A).z;  \
  }
#define VecDot(A, B) ((A).x * (B).x + (A).y * (B).y + (A).z * (B).z)
#define VecLen(A) (sqrt((double)VecDot(A, A)))
#define VecCopy(B, A) \
  { (B) = (A); }
#define VecAdd(C, A, B)    \
  {                        \
    (C).x = (A).x + (B).x; \
    (C).y = (A).y + (B).y; \
    (C).z = (A).z + (B).z; \
  }
#define VecSub(C, A, B)    \
  {                        \
    (C).x = (A).x - (B).x; \
    (C).y = (A).y - (B).y; \
    (C).z = (A).z - (B).z; \
  }
#define VecScalMul(C, a, A)       \
  {                               \
    double sipp_factor_ = (a);    \
    (C).x = sipp_factor_ * (A).x; \
    (C).y = sipp_factor_ * (A).y; \
    (C).z = sipp_factor_ * (A).z; \
  }
#define VecAddS(C, a, A, B)               \
  {                                       \
    double sipp_factor_ = (a);            \
    (C).x = sipp_factor_ * (A).x + (B).x; \
    (C).y = sipp_factor_ * (A).y + (B).y; \
    (C).z = sipp_factor_ * (A).z + (B).z; \
  }
#define VecComb(C, a, A, b, B)                          \
  {                                                     \
    double sipp_first_ = (a), sipp_second_ = (b);       \
    (C).x = sipp_first_ * (A).x + sipp_second_ * (B).x; \
    (C).y = sipp_first_ * (A).y + sipp_second_ * (B).y; \
    (C).z = sipp_first_ * (A).z + sipp_second_ * (B).z; \
  }
#define VecCross(C, A, B)                           \
  {                                                 \
    double sipp_x_ = (A).y * (B).z - (A).z * (B).y; \
    double sipp_y_ = (A).z * (B).x - (A).x * (B).z; \
    double sipp_z_ = (A).x * (B).y - (A).y * (B).x; \
    (C).x = sipp_x_;                                \
    (C).y = sipp_y_;                                \
    (C).z = sipp_z_;                                \
  }
#define VecMax(C, A, B)                    \
  {                                        \
    (C).x = (A).x > (B).x ? (A).x : (B).x; \
    (C).y = (A).y > (B).y ? (A).y : (B).y; \
    (C).z = (A).z > (B).z ? (A).z : (B).z; \
  }
#define VecMin(C, A, B)                    \
  {                                        \
    (C).x = (A).x < (B).x ? (A).x : (B).x; \
    (C).y = (A).y < (B).y ? (A).y : (B).y; \
    (C).z = (A).z < (B).z ? (A).z : (B).z; \
  }
/* Pointers, unlike the others. */
#define MatCopy(A, B) \
  { (*(A)) = (*(B)); }

/* A zero vector stays zero. */
EXTERN void vecnorm _ANSI_ARGS_((Vector * v));
/* A copy of `init`, or the identity for a null pointer; transf_mat_destruct() frees it. */
EXTERN Transf_mat* transf_mat_create _ANSI_ARGS_((Transf_mat * init));
EXTERN void transf_mat_destruct _ANSI_ARGS_((Transf_mat * m));
EXTERN void mat_translate _ANSI_ARGS_((Transf_mat * m, double dx, double dy, double dz));
EXTERN void mat_rotate_x _ANSI_ARGS_((Transf_mat * m, double angle));
EXTERN void mat_rotate_y _ANSI_ARGS_((Transf_mat * m, double angle));
EXTERN void mat_rotate_z _ANSI_ARGS_((Transf_mat * m, double angle));
/* About the line through `point` along `vector`. */
EXTERN void mat_rotate _ANSI_ARGS_((Transf_mat * m, Vector* point, Vector* vector, double angle));
EXTERN void mat_scale _ANSI_ARGS_((Transf_mat * m, double sx, double sy, double sz));
EXTERN void mat_mirror_plane _ANSI_ARGS_((Transf_mat * m, Vector* point, Vector* normal));
/* result = first * second; result may be one of them. */
EXTERN void mat_mul _ANSI_ARGS_((Transf_mat * result, Transf_mat* first, Transf_mat* second));
EXTERN void point_transform _ANSI_ARGS_((Vector * result, Vector* point, Transf_mat* m));

#endif
