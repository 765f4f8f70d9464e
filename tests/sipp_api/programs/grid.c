/* SPDX-License-Identifier: GPL-3.0-or-later
 * A grid of tori, for measuring: -r resolution, -n tori a side. */
#include "demo.h"

Surf_desc grey = {0.3, 0.4, 0.2, {0.7, 0.7, 0.7}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *ring;
    int i, j, c, n, r;

    n = 4;
    r = 1;
    while ((c = getopt(argc, argv, "pgfls:n:r:")) != EOF) {
        switch (c) {
          case 'p': demo_mode = PHONG; break;
          case 'g': demo_mode = GOURAUD; break;
          case 'f': demo_mode = FLAT; break;
          case 'l': demo_mode = LINE; break;
          case 's': demo_size = atoi(optarg); break;
          case 'n': n = atoi(optarg); break;
          case 'r': r = atoi(optarg); break;
          default: exit(1);
        }
    }
    sipp_init();
    usual_lights();
    for (i = 0; i < n; i++) {
        for (j = 0; j < n; j++) {
            ring = sipp_torus(1.0, 0.4, 24 * r, 12 * r, &grey, basic_shader, WORLD);
            if ((i + j) % 2) object_rot_x(ring, M_PI / 2.0);
            object_move(ring, 3.0 * (i - (n - 1) / 2.0), 3.0 * (j - (n - 1) / 2.0), 0.0);
            object_add_subobj(sipp_world, ring);
        }
    }
    camera_params(sipp_camera, 0.0, -4.0 * n, 5.0 * n, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.3);
    render_to("grid", 1);
    exit(0);
}
