/* SPDX-License-Identifier: GPL-3.0-or-later
 * Prisms over concave and triangular outlines. */
#include "demo.h"

Vector pentagon[] = {{0.5, -1.0, 0.0}, {-1.0, 0.5, 0.0}, {1.0, 1.0, 0.0}, {-1.0, 2.0, 0.0}, {-2.0, 0.5, 0.0}};
Vector triangle[] = {{1.0, -1.0, 0.0}, {-1.0, 2.0, 0.0}, {-2.0, -1.0, 0.0}};
Phong_desc green = {0.3, 0.7, 0.4, 20, {0.4, 0.8, 0.4}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *prism;

    options(argc, argv);
    sipp_init();
    usual_lights();
    prism = sipp_prism(3, triangle, 4.0, &green, phong_shader, WORLD);
    object_move(prism, -3.0, 0.0, 0.0);
    object_add_subobj(sipp_world, prism);
    object_add_subobj(sipp_world, sipp_block(1.0, 2.0, 3.0, &green, phong_shader, WORLD));
    prism = sipp_prism(5, pentagon, 5.0, &green, phong_shader, WORLD);
    object_move(prism, 3.0, 0.0, 0.0);
    object_add_subobj(sipp_world, prism);
    camera_params(sipp_camera, 4.0, -10.0, 9.0, 0.0, 0.5, 0.0, 0.0, 0.0, 1.0, 0.4);
    render_to("prisms", 2);
    exit(0);
}
