/* SPDX-License-Identifier: GPL-3.0-or-later
 * An eroded lattice: a bumpy shader around a basic one. */
#include "demo.h"

Surf_desc gold = {0.4, 0.6, 0.2, {0.8, 0.6, 0.3}, {1.0, 1.0, 1.0}};
Surf_desc steel = {0.4, 0.5, 0.2, {0.5, 0.6, 0.8}, {1.0, 1.0, 1.0}};
Bumpy_desc holes = {basic_shader, &gold, 14.0, FALSE, TRUE};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *ball, *bar, *copy;
    int i, j, axis;

    options(argc, argv);
    sipp_init();
    usual_lights();
    ball = sipp_sphere(1.0, 40, &holes, bumpy_shader, WORLD);
    bar = sipp_cylinder(0.25, 4.0, 40, &steel, basic_shader, WORLD);
    for (i = 0; i < 8; i++) {
        copy = object_instance(ball);
        object_move(copy, i & 1 ? 2.0 : -2.0, i & 2 ? 2.0 : -2.0, i & 4 ? 2.0 : -2.0);
        object_add_subobj(sipp_world, copy);
    }
    for (axis = 0; axis < 3; axis++) {
        for (i = -2; i <= 2; i += 4) {
            for (j = -2; j <= 2; j += 4) {
                copy = object_instance(bar);
                object_move(copy, (double)i, (double)j, 0.0);
                if (axis == 1) object_rot_x(copy, M_PI / 2.0);
                if (axis == 2) object_rot_y(copy, M_PI / 2.0);
                object_add_subobj(sipp_world, copy);
            }
        }
    }
    camera_params(sipp_camera, 10.0, -5.0, 15.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.25);
    render_to("lattice", 2);
    exit(0);
}
