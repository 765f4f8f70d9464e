/* SPDX-License-Identifier: GPL-3.0-or-later
 * A planet; it is the world that is turned. */
#include "demo.h"

Surf_desc surface = {0.1, 0.1, 0.6, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    options(argc, argv);
    sipp_init();
    lightsource_create(1.0, 1.0, 0.5, 1.0, 1.0, 1.0, LIGHT_DIRECTION);
    object_add_subobj(sipp_world, sipp_sphere(1.0, 50, &surface, planet_shader, WORLD));
    object_rot_z(sipp_world, -1.2);
    object_rot_x(sipp_world, 0.2);
    camera_params(sipp_camera, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.75);
    render_to("planet", 2);
    exit(0);
}
