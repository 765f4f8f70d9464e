/* SPDX-License-Identifier: GPL-3.0-or-later
 * Black and white images in memory; sipp_bitmap_line() is a line function for render_image_func(). */
#ifndef SIPP_BITMAP_H
#define SIPP_BITMAP_H

#include "sipp.h"

typedef struct {
  int width, height;
  int width_bytes; /* of a row */
  u_char* buffer;  /* bit 7 is the leftmost pixel of a byte; 1 is black */
} Sipp_bitmap;

EXTERN Sipp_bitmap* sipp_bitmap_create _ANSI_ARGS_((int width, int height)); /* white */
EXTERN void sipp_bitmap_destruct _ANSI_ARGS_((Sipp_bitmap * bitmap));
/* With both ends; what lies outside of the image is left out. */
EXTERN void sipp_bitmap_line _ANSI_ARGS_((Sipp_bitmap * bitmap, int x1, int y1, int x2, int y2));
EXTERN void sipp_bitmap_write _ANSI_ARGS_((FILE * file, Sipp_bitmap* bitmap)); /* PBM (P4) */

#endif
