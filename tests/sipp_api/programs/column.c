/* SPDX-License-Identifier: GPL-3.0-or-later
 * A marble teapot on a fluted column, under a spot with shadows. */
#include "demo.h"

Marble_desc marble = {0.3, 0.5, 0.05, 6.0, {0.9, 0.85, 0.8}, {0.4, 0.25, 0.2}, {1.0, 1.0, 1.0}};
Granite_desc granite = {0.3, 0.1, 0.5, 3.0, {0.75, 0.7, 0.65}, {0.35, 0.35, 0.35}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *column, *slab, *flute, *pot;
    double radius, angle;
    int i;

    options(argc, argv);
    sipp_init();
    sipp_shadows(TRUE, 256);
    spotlight_create(-3.0, -3.0, 6.0, 0.0, 0.0, 0.0, 25.0, 1.0, 1.0, 1.0, SPOT_SHARP, TRUE);
    column = object_create();
    slab = sipp_block(1.2, 1.2, 0.3, &granite, granite_shader, WORLD);
    object_move(slab, 0.0, 0.0, -0.15);
    object_add_subobj(column, slab);
    radius = M_PI * 1.2 / 32.0;
    flute = sipp_cylinder(radius, 5.0, 40, &granite, granite_shader, WORLD);
    for (i = 0; i < 16; i++) {
        Object *copy;

        angle = i * M_PI / 8.0;
        copy = object_instance(flute);
        object_move(copy, 0.45 * cos(angle), 0.45 * sin(angle), -2.8);
        object_add_subobj(column, copy);
    }
    object_install(column)
    pot = sipp_teapot(9, &marble, marble_shader, WORLD);
    object_install(pot)
    camera_params(sipp_camera, 2.0, -4.0, 1.5, 0.0, 0.0, 0.1, 0.0, 0.0, 1.0, 0.2);
    render_to("column", 2);
    exit(0);
}
