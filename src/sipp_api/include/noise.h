/* SPDX-License-Identifier: GPL-3.0-or-later
 * SIPP's lattice noise: 512 numbers, drawn from drand48() on first use. */
#ifndef SIPP_NOISE_H
#define SIPP_NOISE_H

#include "sipp.h"

EXTERN Sipp_bool noise_ready;

EXTERN void noise_init _ANSI_ARGS_((void));           /* draws them now, or anew */
EXTERN double noise _ANSI_ARGS_((Vector * position)); /* -1 < noise < 1 */
/* Its gradient. */
EXTERN Vector Dnoise _ANSI_ARGS_((Vector * position)); /* NOLINT: SIPP has this name */
EXTERN double turbulence _ANSI_ARGS_((Vector * position, int octaves));

#endif
