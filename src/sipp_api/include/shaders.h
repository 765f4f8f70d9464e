/* SPDX-License-Identifier: GPL-3.0-or-later
 * SIPP's shaders beside basic_shader(), and their parameters. Programs' own shaders have the same arguments,
 * and may call these. Space: the world's. */
#ifndef SIPP_SHADERS_H
#define SIPP_SHADERS_H

#include "sipp.h"

typedef struct {
  double ambient, diffuse, specular;
  int spec_exp;
  Color color, opacity;
} Phong_desc;

typedef struct {
  double ambient;
  double smoothness, metalness; /* 0..1 */
  Color color, opacity;
} Strauss_desc;

typedef struct {
  Color* colors;
  int no_of_cols;
  double ambient, specular, c3, scale;
  Color opacity;
} Bozo_desc;

typedef struct {
  double ambient, specular, c3, scale;
  Color base, ring, opacity;
} Wood_desc;

typedef struct {
  double ambient, specular, c3, scale;
  Color base, strip, opacity;
} Marble_desc;

typedef struct {
  double ambient, specular, c3, scale;
  Color col1, col2, opacity;
} Granite_desc;

typedef struct {
  Shader* shader;
  void* surface;
  double scale;
  Sipp_bool bumpflag, holeflag;
} Bumpy_desc;

/* Pair t where masker(mask_data, &texture) is not 0, pair f elsewhere. */
typedef struct {
  Shader* t_shader;
  void* t_surface;
  Shader* f_shader;
  void* f_surface;
  void* mask_data;
  Sipp_bool (*masker)();
} Mask_desc;

/* NOLINTBEGIN(bugprone-macro-parentheses): `type` is one */
#define SIPP_SHADER_ARGS_(type)                                                                   \
  (Vector * position, Vector * normal, Vector * texture, Vector * view_vec, Lightsource * lights, \
   type * description, Color * color, Color * opacity)
/* NOLINTEND(bugprone-macro-parentheses) */

EXTERN void phong_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Phong_desc));
EXTERN void strauss_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Strauss_desc));
EXTERN void marble_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Marble_desc));
EXTERN void granite_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Granite_desc));
EXTERN void bozo_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Bozo_desc));
EXTERN void wood_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Wood_desc));
EXTERN void planet_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Surf_desc));
EXTERN void mask_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Mask_desc));
EXTERN void bumpy_shader _ANSI_ARGS_(SIPP_SHADER_ARGS_(Bumpy_desc));

#endif
