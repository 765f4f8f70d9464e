/* SPDX-License-Identifier: GPL-3.0-or-later
 * Included in front of a program, unmodified, that is loaded by the test: its render calls show the test the
 * world, and its end is a return. */
#define main twin_main
#define exit(status)
#define render_image_file twin_render_file
#define render_image_func twin_render_func
