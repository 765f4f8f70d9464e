/* SPDX-License-Identifier: GPL-3.0-or-later
 * A block on its way in three images; the second as a scene, with a call instead of the environment variable. */
#include "demo.h"

Surf_desc grey = {0.3, 0.0, 1.0, {0.7, 0.7, 0.7}, {1.0, 1.0, 1.0}};

main(argc, argv)
    int argc;
    char **argv;
{
    Object *block;
    int i;
    char name[20];

    options(argc, argv);
    sipp_init();
    usual_lights();
    block = sipp_block(1.0, 1.0, 1.0, &grey, basic_shader, WORLD);
    object_install(block)
    view_from(2.0, 3.0, 10.0);
    for (i = 0; i < 3; i++) {
        sprintf(name, "walk%d", i);
        farop_sipp_capture(i == 1 ? "walk.nff" : (char *)0);
        render_to(name, 1);
        object_move(block, 0.5, 0.0, 0.0);
    }
    farop_sipp_capture("frame.nff");
    for (i = 0; i < 3; i++) {
        render_to("unseen", 1);
        object_move(block, 0.5, 0.0, 0.0);
    }
    exit(0);
}
