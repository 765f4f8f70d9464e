/* SPDX-License-Identifier: GPL-3.0-or-later
 * One torus. In the C of 1992: no prototypes, nothing of the standard library declared. */
#include <sipp.h>
#include <primitives.h>

#define SIZE 256

extern char *optarg;

main(argc, argv)
    int argc;
    char **argv;
{
    Object *ring;
    Surf_desc violet;
    FILE *image;
    char *name;
    int mode, size, c;

    mode = PHONG;
    size = SIZE;
    name = "torus.ppm";
    while ((c = getopt(argc, argv, "pgfls:")) != EOF) {
        switch (c) {
          case 'p': mode = PHONG; break;
          case 'g': mode = GOURAUD; break;
          case 'f': mode = FLAT; break;
          case 'l': mode = LINE; name = "torus.pbm"; break;
          case 's': size = atoi(optarg); break;
          default: exit(1);
        }
    }

    sipp_init();
    lightsource_create(1.0, 1.0, 1.0, 0.9, 0.9, 0.9, LIGHT_DIRECTION);
    lightsource_create(-1.0, -1.0, 0.5, 0.4, 0.4, 0.4, LIGHT_DIRECTION);

    violet.ambient = 0.5;
    violet.specular = 0.6;
    violet.c3 = 0.2;
    violet.color.red = 0.6;
    violet.color.grn = 0.3;
    violet.color.blu = 0.5;
    violet.opacity.red = violet.opacity.grn = violet.opacity.blu = 1.0;
    ring = sipp_torus(1.0, 0.4, 40, 15, &violet, basic_shader, WORLD);
    object_add_subobj(sipp_world, ring);

    camera_params(sipp_camera, 4.0, 0.0, 4.5, 0.5, 0.0, 0.0, 0.0, 0.0, 1.0, 0.4);
    image = fopen(name, "w");
    render_image_file(size, size, image, mode, 2);
    fclose(image);
    exit(0);
}
