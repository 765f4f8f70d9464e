/* SPDX-License-Identifier: GPL-3.0-or-later
 * What the programs of this folder have in common. K&R C. */
#include <sipp.h>
#include <primitives.h>
#include <shaders.h>
#include <noise.h>

extern char *optarg;
static int demo_mode = PHONG;
static int demo_size = 256;

static void options(argc, argv)
    int argc;
    char **argv;
{
    int c;

    while ((c = getopt(argc, argv, "pgfls:")) != EOF) {
        switch (c) {
          case 'p': demo_mode = PHONG; break;
          case 'g': demo_mode = GOURAUD; break;
          case 'f': demo_mode = FLAT; break;
          case 'l': demo_mode = LINE; break;
          case 's': demo_size = atoi(optarg); break;
          default: exit(1);
        }
    }
}

static void usual_lights()
{
    lightsource_push(1.0, 1.0, 1.0, 0.9);
    lightsource_push(-1.0, -1.0, 0.5, 0.4);
}

static void render_to(name, oversampling)
    char *name;
    int oversampling;
{
    char path[100];
    FILE *image;

    sprintf(path, "%s.%s", name, demo_mode == LINE ? "pbm" : "ppm");
    image = fopen(path, "w");
    if (image == NULL) {
        fprintf(stderr, "%s cannot be written\n", path);
        exit(1);
    }
    render_image_file(demo_size, demo_size, image, demo_mode, oversampling);
    fclose(image);
}
