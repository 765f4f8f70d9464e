/* SPDX-License-Identifier: GPL-3.0-or-later
 * A coarse ellipsoid: smooth inside, polygonal at its silhouette. */
#include "demo.h"

main(argc, argv)
    int argc;
    char **argv;
{
    Surf_desc blue;

    options(argc, argv);
    sipp_init();
    usual_lights();
    blue.ambient = 0.3;
    blue.specular = 0.7;
    blue.c3 = 0.15;
    blue.color.red = 0.3; blue.color.grn = 0.4; blue.color.blu = 0.9;
    blue.opacity.red = 1.0; blue.opacity.grn = 1.0; blue.opacity.blu = 1.0;
    object_add_subobj(sipp_world, sipp_ellipsoid(1.0, 2.0, 3.0, 15, &blue, basic_shader, WORLD));
    view_from(10.0, 0.0, 0.0);
    view_at(0.0, 0.0, 0.0);
    view_up(0.0, 0.0, 1.0);
    view_focal(0.4);
    render_to("ellipsoid", 2);
    exit(0);
}
