/* SPDX-License-Identifier: GPL-3.0-or-later
 * Four spheres of one colour, from matt to metal. */
#include "demo.h"

Strauss_desc finish[4];
Surf_desc white = {0.4, 0.0, 1.0, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *ball, *wall;
    int i;

    options(argc, argv);
    sipp_init();
    lightsource_create(-1.0, -1.0, 1.0, 1.0, 1.0, 1.0, LIGHT_DIRECTION);
    lightsource_create(0.0, -1.0, 2.0, 0.6, 0.6, 0.6, LIGHT_DIRECTION);
    for (i = 0; i < 4; i++) {
        finish[i].ambient = 0.4;
        finish[i].smoothness = i & 1 ? 0.7 : 0.2;
        finish[i].metalness = i & 2 ? 0.9 : 0.1;
        finish[i].color.red = 0.6;
        finish[i].color.grn = 0.33;
        finish[i].color.blu = 0.27;
        finish[i].opacity.red = finish[i].opacity.grn = finish[i].opacity.blu = 1.0;
        ball = sipp_sphere(1.0, 30, &finish[i], strauss_shader, WORLD);
        object_move(ball, i & 1 ? 1.1 : -1.1, 0.0, i & 2 ? -1.1 : 1.1);
        object_add_subobj(sipp_world, ball);
    }
    wall = sipp_block(6.0, 0.2, 6.0, &white, basic_shader, WORLD);
    object_move(wall, 0.0, 2.0, 0.0);
    object_add_subobj(sipp_world, wall);
    camera_params(sipp_camera, 0.0, -10.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.25);
    render_to("strauss", 2);
    exit(0);
}
