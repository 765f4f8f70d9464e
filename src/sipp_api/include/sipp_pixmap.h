/* SPDX-License-Identifier: GPL-3.0-or-later
 * Colour images in memory; sipp_pixmap_set_pixel() is a pixel function for render_image_func(). */
#ifndef SIPP_PIXMAP_H
#define SIPP_PIXMAP_H

#include "sipp.h"

typedef struct {
  int width, height;
  u_char* buffer; /* r g b, row by row from the top */
} Sipp_pixmap;

EXTERN Sipp_pixmap* sipp_pixmap_create _ANSI_ARGS_((int width, int height)); /* black */
EXTERN void sipp_pixmap_destruct _ANSI_ARGS_((Sipp_pixmap * pixmap));
/* Outside of the image: a message, nothing else. */
EXTERN void sipp_pixmap_set_pixel _ANSI_ARGS_((Sipp_pixmap * pixmap, int x, int y, int red, int grn,
                                               int blu));
EXTERN void sipp_pixmap_write _ANSI_ARGS_((FILE * file, Sipp_pixmap* pixmap)); /* PPM (P6) */

#endif
