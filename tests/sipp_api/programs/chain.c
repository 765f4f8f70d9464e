/* SPDX-License-Identifier: GPL-3.0-or-later
 * Eight tori from one surface, in three levels of hierarchy. */
#include "demo.h"

Surf_desc gold = {0.5, 0.6, 0.2, {0.8, 0.6, 0.3}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *ring, *pair, *quarter;
    int i;
    double x, y;

    options(argc, argv);
    sipp_init();
    usual_lights();
    ring = sipp_torus(1.0, 0.23, 39, 15, &gold, basic_shader, WORLD);
    pair = object_create();
    object_add_subobj(pair, ring);
    ring = object_instance(ring);
    object_move(ring, 0.0, -1.375, 0.0);
    object_rot_y(ring, M_PI / 2.0);
    object_add_subobj(pair, ring);
    for (i = 0; i < 4; i++) {
        quarter = i == 0 ? pair : object_instance(pair);
        x = i == 0 || i == 1 ? -1.375 : 1.375;
        y = i == 0 || i == 3 ? 1.375 : -1.375;
        if (i > 0) object_rot_z(quarter, i * M_PI / 2.0);
        object_move(quarter, x, y, 0.0);
        object_install(quarter)
    }
    camera_params(sipp_camera, 5.0, -2.0, 15.0, 0.5, 0.0, 0.0, 0.0, 1.0, 0.0, 0.25);
    render_to("chain", 2);
    exit(0);
}
