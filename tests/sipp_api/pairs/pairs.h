/* SPDX-License-Identifier: GPL-3.0-or-later
 * Scenes written twice: here as C functions that build them up to the render call, beside it as scripts. */
#ifndef PAIRS_H
#define PAIRS_H

#ifdef __cplusplus
extern "C" {
#endif
void build_shapes(void);
void build_figure(void);
void build_shaders(void);
void build_polygons(void);
#ifdef __cplusplus
}
#endif

#endif
