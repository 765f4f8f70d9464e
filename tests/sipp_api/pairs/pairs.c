/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pairs.h"

#include <primitives.h>
#include <shaders.h>
#include <sipp.h>

static Color opaque = {1.0, 1.0, 1.0};

static Color color(double r, double g, double b) {
  Color c;
  c.red = r, c.grn = g, c.blu = b;
  return c;
}

static void place(Object* object, double x, double y, double z) {
  object_move(object, x, y, z);
  object_add_subobj(sipp_world, object);
}

/* Every primitive, with every texture mapping somewhere. */
void build_shapes(void) {
  static Granite_desc plain;
  static Vector outline[5], net[16], profile[4];
  static int patch[16], curve[4];
  Shader* granite = (Shader*)granite_shader; /* reads texture coordinates */
  int i;
  sipp_init();
  plain.ambient = 0.5, plain.specular = 0.6, plain.c3 = 0.2, plain.scale = 2.0;
  plain.col1 = color(0.6, 0.3, 0.5);
  plain.col2 = color(0.2, 0.3, 0.5);
  plain.opacity = opaque;
  place(sipp_torus(1.0, 0.4, 40, 15, &plain, granite, WORLD), -6.0, 0.0, 0.0);
  place(sipp_sphere(1.0, 9, &plain, granite, SPHERICAL), -3.0, 0.0, 0.0);
  place(sipp_ellipsoid(1.0, 2.0, 3.0, 15, &plain, granite, CYLINDRICAL), 0.0, 0.0, 0.0);
  place(sipp_cone(1.0, 0.0, 4.0, 20, &plain, granite, NATURAL), 3.0, 0.0, 0.0);
  place(sipp_cone(0.5, 1.5, 2.0, 7, &plain, granite, SPHERICAL), 6.0, 0.0, 0.0);
  place(sipp_cylinder(1.0, 3.0, 20, &plain, granite, WORLD), -6.0, 5.0, 0.0);
  MakeVector(outline[0], 0.5, -1.0, 0.0);
  MakeVector(outline[1], -1.0, 0.5, 0.0);
  MakeVector(outline[2], 1.0, 1.0, 0.0);
  MakeVector(outline[3], -1.0, 2.0, 0.0);
  MakeVector(outline[4], -2.0, 0.5, 0.0);
  place(sipp_prism(5, outline, 5.0, &plain, granite, NATURAL), -3.0, 5.0, 0.0);
  place(sipp_block(1.0, 2.0, 3.0, &plain, granite, CYLINDRICAL), 0.0, 5.0, 0.0);
  place(sipp_cube(1.5, &plain, granite, WORLD), 3.0, 5.0, 0.0);
  place(sipp_teapot(3, &plain, granite, WORLD), 6.0, 5.0, 0.0);
  place(sipp_teapot_body(2, &plain, granite, WORLD), -6.0, -5.0, 0.0);
  place(sipp_teapot_lid(2, &plain, granite, NATURAL), -6.0, -5.0, 0.0);
  place(sipp_teapot_spout(2, &plain, granite, NATURAL), -6.0, -5.0, 0.0);
  place(sipp_teapot_handle(2, &plain, granite, WORLD), -6.0, -5.0, 0.0);
  for (i = 0; i < 16; i++) {
    MakeVector(net[i], i % 4, i / 4, (i % 4) * (i / 4) * 0.25);
    patch[i] = i;
  }
  place(sipp_bezier_patches(16, net, 1, patch, 4, &plain, granite, NATURAL), -3.0, -5.0, 0.0);
  MakeVector(profile[0], 1.0, 0.0, 0.0);
  MakeVector(profile[1], 2.0, 0.0, 1.0);
  MakeVector(profile[2], 0.5, 0.0, 2.0);
  MakeVector(profile[3], 1.0, 0.0, 3.0);
  for (i = 0; i < 4; i++) curve[i] = i;
  place(sipp_bezier_rotcurve(4, profile, 1, curve, 4, &plain, granite, WORLD), 3.0, -5.0, 0.0);
  lightsource_create(1.0, 1.0, 1.0, 0.9, 0.9, 0.9, LIGHT_DIRECTION);
  camera_params(sipp_camera, 5.0, -30.0, 16.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.3);
}

/* Hierarchy, copies of all three kinds, every transformation. */
void build_figure(void) {
  static Phong_desc skin;
  Object *body, *arm, *hand, *left, *copy;
  Vector point, direction;
  Transf_mat matrix;
  sipp_init();
  skin.ambient = 0.3, skin.diffuse = 0.7, skin.specular = 0.25, skin.spec_exp = 12;
  skin.color = color(0.9, 0.7, 0.5);
  skin.opacity = color(0.5, 0.5, 0.5);
  body = sipp_cylinder(1.0, 3.0, 12, &skin, (Shader*)phong_shader, WORLD);
  arm = sipp_block(0.4, 0.4, 2.0, &skin, (Shader*)phong_shader, WORLD);
  hand = sipp_sphere(0.3, 6, &skin, (Shader*)phong_shader, WORLD);
  object_move(hand, 0.0, 0.0, -1.2);
  object_add_subobj(arm, hand);
  left = object_instance(arm);
  object_rot_x(arm, 0.4);
  object_rot_y(arm, -0.3);
  object_move(arm, 1.2, 0.0, 0.5);
  object_rot_z(left, 0.2);
  object_move(left, -1.2, 0.0, 0.5);
  object_add_subobj(body, arm);
  object_add_subobj(body, left);
  MakeVector(point, 0.0, 0.0, -1.5);
  MakeVector(direction, 1.0, 0.5, 0.25);
  object_rot(body, &point, &direction, 0.3);
  object_add_subobj(sipp_world, body);
  copy = object_dup(body);
  object_scale(copy, 1.0, 1.5, 0.5);
  object_move(copy, 4.0, 0.0, 0.0);
  object_add_subobj(sipp_world, copy);
  copy = object_deep_dup(arm);
  MatCopy(&matrix, &ident_matrix);
  mat_rotate_z(&matrix, M_PI / 2.0);
  mat_translate(&matrix, -4.0, 0.0, 1.0);
  object_transform(copy, &matrix);
  object_add_subobj(sipp_world, copy);
  copy = object_instance(copy);
  object_set_transf(copy, &matrix);
  MakeVector(point, 0.0, 0.0, 0.0);
  MakeVector(direction, 0.0, 1.0, 1.0);
  MatCopy(&matrix, &ident_matrix);
  mat_mirror_plane(&matrix, &point, &direction);
  object_transform(copy, &matrix);
  object_add_subobj(sipp_world, copy);
  object_rot_z(sipp_world, -0.1);
  lightsource_create(3.0, -4.0, 5.0, 0.8, 0.8, 0.7, LIGHT_POINT);
  sipp_show_backfaces(TRUE);
  sipp_background(0.1, 0.2, 0.3);
  camera_params(sipp_camera, 3.0, -10.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.4);
}

/* Every shader that scripts know, lights of all kinds. */
void build_shaders(void) {
  static Surf_desc basic, planet;
  static Phong_desc phong;
  static Strauss_desc strauss;
  static Wood_desc wood;
  static Marble_desc marble;
  static Granite_desc granite;
  static Bozo_desc bozo;
  static Color colors[3];
  static Bumpy_desc bumpy;
  sipp_init();
  basic.ambient = 0.3, basic.specular = 0.6, basic.c3 = 0.2;
  basic.color = color(0.8, 0.6, 0.3);
  basic.opacity = color(0.5, 0.75, 1.0);
  phong.ambient = 0.1, phong.diffuse = 0.8, phong.specular = 0.4, phong.spec_exp = 30;
  phong.color = color(0.2, 0.4, 0.9);
  phong.opacity = opaque;
  strauss.ambient = 0.4, strauss.smoothness = 0.7, strauss.metalness = 0.9;
  strauss.color = color(0.6, 0.33, 0.27);
  strauss.opacity = opaque;
  wood.ambient = 0.4, wood.specular = 0.1, wood.c3 = 0.6, wood.scale = 10.0;
  wood.base = color(0.7, 0.5, 0.3);
  wood.ring = color(0.35, 0.2, 0.1);
  wood.opacity = opaque;
  marble.ambient = 0.3, marble.specular = 0.5, marble.c3 = 0.05, marble.scale = 6.0;
  marble.base = color(0.9, 0.85, 0.8);
  marble.strip = color(0.4, 0.25, 0.2);
  marble.opacity = opaque;
  granite.ambient = 0.3, granite.specular = 0.1, granite.c3 = 0.5, granite.scale = 3.0;
  granite.col1 = color(0.75, 0.7, 0.65);
  granite.col2 = color(0.35, 0.35, 0.35);
  granite.opacity = opaque;
  colors[0] = color(1.0, 0.0, 0.0);
  colors[1] = color(0.0, 1.0, 0.0);
  colors[2] = color(0.0, 0.0, 1.0);
  bozo.colors = colors, bozo.no_of_cols = 3;
  bozo.ambient = 0.2, bozo.specular = 0.3, bozo.c3 = 0.4, bozo.scale = 4.0;
  bozo.opacity = opaque;
  planet.ambient = 0.1, planet.specular = 0.1, planet.c3 = 0.6;
  planet.opacity = opaque;
  bumpy.shader = (Shader*)phong_shader, bumpy.surface = &phong, bumpy.scale = 14.0;
  bumpy.bumpflag = FALSE, bumpy.holeflag = TRUE;
  place(sipp_sphere(1.0, 10, &basic, (Shader*)basic_shader, WORLD), 0.0, 0.0, 0.0);
  place(sipp_sphere(1.0, 10, &phong, (Shader*)phong_shader, WORLD), 2.5, 0.0, 0.0);
  place(sipp_sphere(1.0, 10, &strauss, (Shader*)strauss_shader, WORLD), 5.0, 0.0, 0.0);
  place(sipp_cube(1.5, &wood, (Shader*)wood_shader, WORLD), 0.0, 2.5, 0.0);
  place(sipp_cube(1.5, &marble, (Shader*)marble_shader, WORLD), 2.5, 2.5, 0.0);
  place(sipp_cube(1.5, &granite, (Shader*)granite_shader, WORLD), 5.0, 2.5, 0.0);
  place(sipp_sphere(1.0, 10, &bozo, (Shader*)bozo_shader, WORLD), 0.0, 5.0, 0.0);
  place(sipp_sphere(1.0, 10, &planet, (Shader*)planet_shader, WORLD), 2.5, 5.0, 0.0);
  place(sipp_sphere(1.0, 10, &bumpy, (Shader*)bumpy_shader, WORLD), 5.0, 5.0, 0.0);
  lightsource_create(-1.0, -1.0, 0.5, 0.4, 0.4, 0.4, LIGHT_DIRECTION);
  lightsource_create(2.0, -5.0, 6.0, 0.5, 0.4, 0.3, LIGHT_POINT);
  spotlight_create(2.5, -6.0, 8.0, 2.5, 2.5, 0.0, 50.0, 0.7, 0.7, 0.7, SPOT_SOFT, FALSE);
  spotlight_create(0.0, -6.0, 8.0, 0.0, 0.0, 0.0, 20.0, 0.3, 0.3, 0.6, SPOT_SHARP, FALSE);
  camera_params(sipp_camera, 2.5, -12.0, 10.0, 2.5, 2.5, 0.0, 0.0, 0.0, 1.0, 0.3);
}

/* Polygons of one's own: with normals, with texture coordinates, with both; corners that merge, and do not.
 */
void build_polygons(void) {
  static Surf_desc plain;
  static Marble_desc veined;
  Object* object;
  Surface* surface;
  int i;
  sipp_init();
  plain.ambient = 0.5, plain.specular = 0.6, plain.c3 = 0.2;
  plain.color = color(0.6, 0.3, 0.5);
  plain.opacity = opaque;
  veined.ambient = 0.5, veined.specular = 0.6, veined.c3 = 0.2, veined.scale = 9.0;
  veined.base = color(0.6, 0.3, 0.5);
  veined.strip = color(0.9, 0.9, 0.2);
  veined.opacity = opaque;
  object = object_create();
  for (i = 0; i < 10; i++) {
    vertex_push(0.5 * i, 0.0, 0.1 * (i % 2));
    vertex_push(0.5 * (i + 1), 0.0, 0.1 * ((i + 1) % 2));
    vertex_push(0.5 * (i + 1), 1.0 + 1e-12, 0.1 * ((i + 1) % 2));
    vertex_push(0.5 * i, 1.0, 0.1 * (i % 2));
    polygon_push();
  }
  object_add_surface(object, surface_create(&plain, (Shader*)basic_shader));
  for (i = 0; i < 4; i++) {
    vertex_n_push(i == 0 || i == 3 ? 0.0 : 2.0, 2.0, i < 2 ? 0.0 : 2.0, 0.0, -3.0, 0.1 * i);
  }
  polygon_push();
  object_add_surface(object, surface_create(&plain, (Shader*)basic_shader));
  vertex_tx_push(3.0, 2.0, 0.0, 0.0, 0.0, 0.0);
  vertex_tx_push(4.0, 2.0, 0.0, 1.0, 0.0, 0.0);
  vertex_tx_push(3.5, 2.0, 1.0, 0.5, 1.0, 0.0);
  polygon_push();
  vertex_tx_n_push(4.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.5);
  vertex_tx_n_push(5.0, 2.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 0.25);
  vertex_tx_n_push(4.5, 2.0, 1.0, 0.5, 1.0, 0.0, 0.0, -1.0, 0.0);
  polygon_push();
  surface = surface_create(&veined, (Shader*)marble_shader);
  object_add_surface(object, surface);
  object_add_surface(object, surface);
  object_add_subobj(sipp_world, object);
  lightsource_create(0.5, -1.0, 1.0, 0.9, 0.9, 0.9, LIGHT_DIRECTION);
  camera_params(sipp_camera, 2.5, -10.0, 5.0, 2.5, 0.5, 0.0, 0.0, 0.0, 1.0, 0.3);
}
