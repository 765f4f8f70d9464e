/* SPDX-License-Identifier: GPL-3.0-or-later
 * A cone, a cylinder and a truncated cone: caps and hard rims. */
#include "demo.h"

Surf_desc salmon = {0.4, 0.5, 0.3, {1.0, 0.6275, 0.4784}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *cone, *cylinder, *truncated;

    options(argc, argv);
    sipp_init();
    usual_lights();
    cone = sipp_cone(1.0, 0.0, 4.0, 20, &salmon, basic_shader, WORLD);
    cylinder = sipp_cylinder(1.0, 3.0, 20, &salmon, basic_shader, WORLD);
    truncated = sipp_cone(1.0, 0.4, 5.0, 20, &salmon, basic_shader, WORLD);
    object_move(cone, -3.0, 0.0, 0.0);
    object_move(truncated, 3.0, 0.0, 0.0);
    object_install(cone)
    object_install(cylinder)
    object_install(truncated)
    viewpoint(5.0, -10.0, 6.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.4);
    render_to("cones", 2);
    exit(0);
}
