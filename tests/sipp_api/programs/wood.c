/* SPDX-License-Identifier: GPL-3.0-or-later
 * A wooden block, written pixel by pixel into a pixmap. */
#include "demo.h"
#include <sipp_pixmap.h>

Wood_desc oak = {0.4, 0.1, 0.6, 10.0, {0.7, 0.5, 0.3}, {0.35, 0.2, 0.1}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Sipp_pixmap *pixmap;
    FILE *image;

    options(argc, argv);
    sipp_init();
    lightsource_create(1.0, 2.0, 1.5, 1.0, 1.0, 1.0, LIGHT_DIRECTION);
    object_add_subobj(sipp_world, sipp_block(4.0, 3.0, 3.0, &oak, wood_shader, WORLD));
    camera_params(sipp_camera, 10.0, 10.0, 20.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.125);
    pixmap = sipp_pixmap_create(demo_size, demo_size);
    render_image_pixmap(demo_size, demo_size, pixmap, sipp_pixmap_set_pixel, demo_mode, 2);
    image = fopen("wood.ppm", "w");
    sipp_pixmap_write(image, pixmap);
    fclose(image);
    sipp_pixmap_destruct(pixmap);
    exit(0);
}
