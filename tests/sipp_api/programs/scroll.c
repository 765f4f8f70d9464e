/* SPDX-License-Identifier: GPL-3.0-or-later
 * A written scroll: quadrilaterals with texture coordinates of their own, curled by a free-form deformation, a shader
 * that reads a bitmap. */
#include "demo.h"
#include <sipp_bitmap.h>

#define STRIPS 100

Surf_desc paper = {0.4, 0.0, 1.0, {0.95, 0.9, 0.75}, {1.0, 1.0, 1.0}};
Sipp_bitmap *writing;

void
written_shader(pos, normal, texture, view_vec, lights, desc, color, opacity)
    Vector *pos, *normal, *texture, *view_vec;
    Lightsource *lights;
    Surf_desc *desc;
    Color *color, *opacity;
{
    Surf_desc here;
    int x, y;

    here = *desc;
    x = (int)(texture->x * writing->width);
    y = (int)((1.0 - texture->y) * writing->height);
    if (x >= 0 && x < writing->width && y >= 0 && y < writing->height &&
        writing->buffer[y * writing->width_bytes + x / 8] & (0x80 >> (x % 8))) {
        here.color.red = here.color.grn = 0.1;
        here.color.blu = 0.3;
    }
    basic_shader(pos, normal, texture, view_vec, lights, &here, color, opacity);
}

/* Rolls up both ends of the x axis, over `radius` and more. */
void
curl(radius, pos, tex, new_pos, new_tex)
    double *radius;
    Vector *pos, *tex, *new_pos, *new_tex;
{
    double beyond, angle, r, side;

    VecCopy(*new_pos, *pos)
    VecCopy(*new_tex, *tex)
    beyond = fabs(pos->x) - 1.7;
    if (beyond <= 0.0) return;
    side = pos->x < 0.0 ? -1.0 : 1.0;
    r = *radius + 0.02 * beyond;
    angle = beyond / r;
    new_pos->x = side * (1.7 + r * sin(angle));
    new_pos->z = pos->z + r * (1.0 - cos(angle));
}

static void write_letters()
{
    int line, column, x, y, k;

    writing = sipp_bitmap_create(900, 360);
    for (line = 0; line < 5; line++) {
        for (column = 0; column < 22; column++) {
            x = 140 + column * 28;
            y = 40 + line * 60;
            for (k = 0; k < 5; k++) {
                sipp_bitmap_line(writing, x + k, y + 36, x + 10 + k, y);
                if (column * 7 + line * 5 & 2) sipp_bitmap_line(writing, x + 10 + k, y, x + 18 + k, y + 36);
                if (column * 3 + line & 1) sipp_bitmap_line(writing, x, y + 18 + k, x + 20, y + 18 + k);
            }
        }
    }
}

main(argc, argv)
    int argc;
    char **argv;
{
    Object *scroll;
    Surface *sheet;
    int i;
    double x1, x2, u1, u2, radius;

    options(argc, argv);
    sipp_init();
    sipp_show_backfaces(TRUE);
    sipp_shadows(TRUE, 512);
    sipp_background(0.2, 0.25, 0.3);
    spotlight_create(-2.0, 3.0, 7.0, 0.0, 0.0, 0.0, 60.0, 1.0, 1.0, 1.0, SPOT_SOFT, TRUE);
    lightsource_create(1.0, 1.0, 2.0, 0.3, 0.3, 0.3, LIGHT_DIRECTION);
    write_letters();
    for (i = 0; i < STRIPS; i++) {
        x1 = 0.05 * (i - STRIPS / 2);
        x2 = x1 + 0.05;
        u1 = (double)i / STRIPS;
        u2 = (double)(i + 1) / STRIPS;
        vertex_tx_push(x1, -0.5, 0.0, u1, 0.0, 0.0);
        vertex_tx_push(x2, -0.5, 0.0, u2, 0.0, 0.0);
        vertex_tx_push(x2, 0.5, 0.0, u2, 1.0, 0.0);
        vertex_tx_push(x1, 0.5, 0.0, u1, 1.0, 0.0);
        polygon_push();
    }
    sheet = surface_create(&paper, written_shader);
    radius = 0.15;
    surface_set_ffd(sheet, (FFD_func *)curl, &radius);
    scroll = object_create();
    object_add_surface(scroll, sheet);
    object_add_subobj(sipp_world, scroll);
    camera_params(sipp_camera, 0.5, 1.0, 5.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.45);
    render_to("scroll", 3);
    sipp_bitmap_destruct(writing);
    exit(0);
}
