/* SPDX-License-Identifier: GPL-3.0-or-later
 * A teapot with holes on a chessboard: shader functions of the program, and shadow maps that are made before the floor
 * exists, so that the floor casts none. */
#include "demo.h"

Surf_desc glaze = {0.4, 0.5, 0.1, {0.9, 0.9, 0.85}, {1.0, 1.0, 1.0}};
Surf_desc floor_tile = {0.4, 0.1, 0.5, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};

void
holed_shader(pos, normal, texture, view_vec, lights, desc, color, opacity)
    Vector *pos, *normal, *texture, *view_vec;
    Lightsource *lights;
    Surf_desc *desc;
    Color *color, *opacity;
{
    Vector scaled;

    VecScalMul(scaled, 35.0, *texture)
    if (noise(&scaled) < -0.1) {
        opacity->red = opacity->grn = opacity->blu = 0.0;
        return;
    }
    basic_shader(pos, normal, texture, view_vec, lights, desc, color, opacity);
}

void
checker_shader(pos, normal, texture, view_vec, lights, desc, color, opacity)
    Vector *pos, *normal, *texture, *view_vec;
    Lightsource *lights;
    Surf_desc *desc;
    Color *color, *opacity;
{
    Surf_desc tile;
    int odd;

    tile = *desc;
    odd = ((int)floor(texture->x + 100.0) + (int)floor(texture->y + 100.0)) & 1;
    tile.color.red = odd ? 0.9 : 0.5;
    tile.color.grn = odd ? 0.9 : 0.1;
    tile.color.blu = odd ? 0.8 : 0.1;
    basic_shader(pos, normal, texture, view_vec, lights, &tile, color, opacity);
}

main(argc, argv)
    int argc;
    char **argv;
{
    Object *pot, *disc, *ground;

    options(argc, argv);
    sipp_init();
    sipp_show_backfaces(TRUE);
    sipp_background(0.078, 0.361, 0.753);
    lightsource_create(-3.0, -2.0, 6.0, 0.35, 0.35, 0.35, LIGHT_DIRECTION);
    spotlight_create(-3.0, -2.0, 6.0, 0.0, 0.0, 0.3, 25.0, 0.45, 0.45, 0.45, SPOT_SOFT, TRUE);
    pot = sipp_teapot(9, &glaze, holed_shader, WORLD);
    disc = sipp_cylinder(0.375, 0.01, 36, &glaze, holed_shader, WORLD);
    object_add_subobj(pot, disc);
    object_add_subobj(sipp_world, pot);
    shadowmaps_create(0);
    ground = sipp_block(7.0, 7.0, 0.2, &floor_tile, checker_shader, WORLD);
    object_move(ground, 0.0, 0.0, -0.105);
    object_add_subobj(sipp_world, ground);
    camera_params(sipp_camera, 1.65, -7.7, 3.3, 0.0, 0.0, 0.4, 0.0, 0.0, 1.0, 0.125);
    render_to("holes", 3);
    shadowmaps_destruct();
    exit(0);
}
