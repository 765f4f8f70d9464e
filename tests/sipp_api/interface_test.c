/* SPDX-License-Identifier: GPL-3.0-or-later
 * The C interface, called by C: what functions do beside pictures. Compiled as gnu89 and as C99. */
#include <noise.h>
#include <primitives.h>
#include <shaders.h>
#include <sipp.h>
#include <sipp_bitmap.h>
#include <sipp_pixmap.h>
#include <stdlib.h>

static int failures = 0;
static const char* current = "";

#define EXPECT(condition)                                                          \
  do {                                                                             \
    if (!(condition)) {                                                            \
      failures++;                                                                  \
      fprintf(stderr, "%s:%d: %s: %s\n", __FILE__, __LINE__, current, #condition); \
    }                                                                              \
  } while (0)
#define NEAR(a, b) (fabs((a) - (b)) < 1e-9)

static Surf_desc white = {0.2, 0.0, 0.5, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}};

/* ---- images in memory */

static Sipp_pixmap* draw(int size, int mode) {
  Sipp_pixmap* image = sipp_pixmap_create(size, size);
  render_image_func(size, size, (void (*)())sipp_pixmap_set_pixel, image, mode, 1);
  return image;
}
static int level(Sipp_pixmap* image, int x, int y, int channel) {
  return image->buffer[3 * (y * image->width + x) + channel];
}
/* Seen from +z; a square of 2 x 2 around the origin, its middle in the middle of the image. */
static void start(void) {
  sipp_init();
  camera_params(sipp_camera, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.25);
}
static Surface* square(double z, void* description, Shader* shader) {
  vertex_tx_push(-1.0, -1.0, z, 0.0, 0.0, 0.0);
  vertex_tx_push(1.0, -1.0, z, 1.0, 0.0, 0.0);
  vertex_tx_push(1.0, 1.0, z, 1.0, 1.0, 0.0);
  vertex_tx_push(-1.0, 1.0, z, 0.0, 1.0, 0.0);
  polygon_push();
  return surface_create(description, shader);
}
static Object* show(Surface* surface) {
  Object* object = object_create();
  object_add_surface(object, surface);
  object_add_subobj(sipp_world, object);
  return object;
}

/* ---- geometry */

static void geometry(void) {
  Vector a, b, c;
  Transf_mat *m, *n, product;
  current = "geometry";
  MakeVector(a, 1.0, 2.0, 3.0) MakeVector(b, -2.0, 0.5, 4.0) VecCross(c, a, b);
  EXPECT(NEAR(VecDot(a, c), 0.0) && NEAR(VecDot(b, c), 0.0));
  VecCross(a, a, b);
  EXPECT(NEAR(a.x, c.x) && NEAR(a.y, c.y) && NEAR(a.z, c.z));
  VecComb(c, 2.0, a, -1.0, b) VecAddS(a, -2.0, a, c);
  EXPECT(NEAR(a.x, -b.x) && NEAR(a.y, -b.y));
  vecnorm(&b);
  EXPECT(NEAR(VecLen(b), 1.0));
  MakeVector(b, 0.0, 0.0, 0.0);
  vecnorm(&b);
  EXPECT(b.x == 0.0 && b.y == 0.0 && b.z == 0.0);

  m = transf_mat_create(NULL);
  mat_translate(m, 1.0, 0.0, 0.0);
  n = transf_mat_create(m);
  mat_rotate_z(n, M_PI / 2.0);
  MakeVector(a, 0.0, 0.0, 0.0);
  point_transform(&b, &a, n);
  EXPECT(b.x == 0.0 && b.y == 1.0); /* quarter turns are exact */
  MatCopy(&product, n) mat_mul(&product, &product, m);
  point_transform(&b, &a, &product);
  EXPECT(b.x == 1.0 && b.y == 1.0);
  mat_scale(m, 2.0, 2.0, 2.0);
  EXPECT(m->mat[3][0] == 2.0);
  MakeVector(a, 0.0, 0.0, 1.0) MakeVector(b, 0.0, 0.0, -3.0) mat_mirror_plane(m, &a, &b);
  point_transform(&c, &a, m);
  EXPECT(NEAR(c.z, 0.0) && NEAR(c.x, 2.0));
  MakeVector(b, 0.0, 1.0, 0.0) mat_rotate(m, &a, &b, M_PI);
  EXPECT(ident_matrix.mat[0][0] == 1.0 && ident_matrix.mat[3][2] == 0.0);
  transf_mat_destruct(m);
  transf_mat_destruct(n);
}

/* ---- objects and references */

static int freed = 0;
static void free_description(Surf_desc_hdr* header) {
  freed++;
  sfree(header);
}

static void objects(void) {
  Object *parent, *a, *b, *c, *copy;
  Transf_mat where, *allocated;
  Surface* surface;
  current = "objects";
  start();
  parent = object_create();
  a = object_create(), b = object_create(), c = object_create();
  object_add_subobj(parent, a);
  object_add_subobj(parent, b);
  object_add_subobj(parent, c);
  object_add_subobj(parent, b);
  object_add_subobj(parent, NULL);
  object_add_subobj(NULL, a);
  EXPECT(parent->num_sub_objs == 4 && b->ref_count == 2 && parent->ref_count == 0);
  EXPECT(object_sub_subobj(parent, a) == TRUE); /* freed; the last one takes its place */
  EXPECT(parent->sub_objs[0] == b && parent->sub_objs[1] == b && parent->sub_objs[2] == c);
  EXPECT(object_sub_subobj(parent, sipp_world) == FALSE);

  surface = square(0.0, &white, (Shader*)basic_shader);
  object_add_surface(b, surface);
  object_move(b, 1.0, 2.0, 3.0);
  object_rot_z(parent, 1.0);
  copy = object_instance(parent);
  EXPECT(copy->sub_objs[0] == b && copy->transf.mat[0][1] == 0.0);
  object_unref(copy);
  EXPECT(b->ref_count == 2);
  copy = object_dup(parent);
  EXPECT(copy->num_sub_objs == 3 && copy->sub_objs[0] != b && copy->sub_objs[0]->transf.mat[3][0] == 0.0);
  EXPECT(copy->sub_objs[0]->surfaces[0] == surface);
  object_unref(copy);
  copy = object_deep_dup(parent);
  EXPECT(copy->sub_objs[0]->surfaces[0] != surface && copy->sub_objs[0]->transf.mat[3][1] == 0.0);
  object_delete(copy);

  object_get_transf(b, &where);
  EXPECT(where.mat[3][2] == 3.0);
  allocated = object_get_transf(b, NULL);
  EXPECT(allocated->mat[3][1] == 2.0);
  object_scale(b, 1.0, 1.0, 2.0);
  object_transform(b, allocated);
  EXPECT(b->transf.mat[3][2] == 9.0);
  object_set_transf(b, allocated);
  object_clear_transf(parent);
  EXPECT(parent->transf.mat[0][0] == 1.0 && b->transf.mat[3][2] == 3.0);
  transf_mat_destruct(allocated);
  EXPECT(object_sub_surface(b, surface) == TRUE && object_sub_surface(b, surface) == FALSE);
  object_unref(parent);
  object_unref(sipp_world);
  EXPECT(sipp_world->ref_count >= 1);

  EXPECT(sipp_user_refcount(TRUE) == FALSE);
  a = object_create();
  EXPECT(a->ref_count == 1);
  object_add_subobj(sipp_world, a);
  object_unref(a);
  EXPECT(a->ref_count == 1);
  object_add_subobj(a, object_create());
  copy = object_dup(a);
  EXPECT(copy->ref_count == 1 && copy->sub_objs[0]->ref_count == 1);
  EXPECT(sipp_user_refcount(FALSE) == TRUE);
}

static void headers_of_descriptions(void) {
  Surf_desc_hdr* header;
  Surface *first, *second;
  current = "headers";
  start();
  header = SIPP_SURF_HDR_ALLOC(Surf_desc);
  header->ref_count = 1;
  header->free_func = (void (*)())free_description;
  *SIPP_SURFP_HDR(Surf_desc, header) = white;
  EXPECT(sipp_surface_desc_headers(TRUE) == FALSE);
  first = square(0.0, header, (Shader*)basic_shader);
  second = square(1.0, header, (Shader*)basic_shader);
  EXPECT(header->ref_count == 3);
  surface_unref(first);
  surface_desc_unref(header);
  EXPECT(header->ref_count == 1 && freed == 0);
  surface_basic_shader(second, 0.1, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0);
  EXPECT(freed == 1);
  EXPECT(sipp_surface_desc_headers(FALSE) == TRUE);
  EXPECT(sipp_ffd_desc_headers(FALSE) == FALSE);
  surface_unref(second);
  EXPECT(surface_create(&white, (Shader*)basic_shader) == NULL);
}

/* ---- lights and cameras */

static void lights(void) {
  Lightsource *far_away, *near_by, *sharp, *soft;
  Vector here, to_light;
  current = "lights";
  start();
  MakeVector(here, 0.0, 0.0, 0.0);
  far_away = lightsource_create(0.0, 0.0, 5.0, 0.9, 0.8, 0.7, LIGHT_DIRECTION);
  near_by = lightsource_create(3.0, 0.0, 4.0, 2.0, 2.0, 2.0, LIGHT_POINT);
  EXPECT(lightsource_create(0.0, 0.0, 1.0, 1.0, 1.0, 1.0, SPOT_SOFT) == NULL);
  EXPECT(spotlight_create(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 10.0, 1.0, 1.0, 1.0, LIGHT_POINT, FALSE) == NULL);
  EXPECT(near_by->next == far_away && far_away->next == NULL && far_away->color.grn == 0.8);
  EXPECT(light_eval(far_away, &here, &to_light) == 1.0 && to_light.z == 1.0);
  EXPECT(light_eval(near_by, &here, &to_light) == 1.0 && NEAR(to_light.x, 0.6));
  sharp = spotlight_create(0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 60.0, 1.0, 1.0, 1.0, SPOT_SHARP, FALSE);
  soft = spotlight_create(0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 60.0, 1.0, 1.0, 1.0, SPOT_SOFT, FALSE);
  MakeVector(here, 0.0, 10.0 * tan(20.0 * M_PI / 180.0), 0.0);
  EXPECT(light_eval(sharp, &here, &to_light) == 1.0);
  EXPECT(NEAR(light_eval(soft, &here, &to_light),
              0.5 + 0.5 * cos(M_PI * (1.0 - cos(M_PI / 9.0)) / (1.0 - cos(M_PI / 6.0)))));
  spotlight_opening(sharp, 30.0);
  EXPECT(light_eval(sharp, &here, &to_light) == 0.0);
  spotlight_at(sharp, here.x, here.y, here.z);
  EXPECT(light_eval(sharp, &here, &to_light) == 1.0);
  spotlight_pos(far_away, 1.0, 0.0, 0.0); /* wrong kind: ignored */
  lightsource_put(sharp, 1.0, 0.0, 0.0);
  EXPECT(light_eval(sharp, &here, &to_light) == 1.0);
  lightsource_put(far_away, 0.0, 3.0, 0.0);
  EXPECT(light_eval(far_away, &here, &to_light) == 1.0 && to_light.y == 1.0);
  light_active(far_away, FALSE);
  EXPECT(far_away->active == FALSE && light_eval(far_away, &here, &to_light) == 0.0);
  light_destruct(near_by);
  EXPECT(soft->next == sharp && sharp->next == far_away);
  light_destruct(NULL);
}

static void cameras(void) {
  Camera* camera;
  current = "cameras";
  start();
  camera = camera_create();
  EXPECT(camera->position.z == 10.0 && camera->focal_ratio == 0.25 && camera->up.y == 1.0);
  camera_use(camera);
  EXPECT(sipp_camera == camera);
  view_from(1.0, 2.0, 3.0);
  view_focal(0.5);
  EXPECT(camera->position.y == 2.0 && camera->focal_ratio == 0.5);
  camera_destruct(camera);
  EXPECT(sipp_camera != camera);
  camera_destruct(sipp_camera);
  EXPECT(sipp_camera != NULL);
}

/* ---- rendering */

static void late_binding(void) {
  Surf_desc paint;
  Surface* surface;
  Object* object;
  Sipp_pixmap* image;
  current = "late binding";
  start();
  paint = white;
  surface = square(0.0, &paint, (Shader*)basic_shader);
  object = show(surface);
  paint.color.red = 0.5;
  paint.ambient = 1.0;
  image = draw(20, PHONG);
  EXPECT(level(image, 10, 10, 0) == 128 && level(image, 10, 10, 1) == 255 && level(image, 0, 0, 1) == 0);
  sipp_pixmap_destruct(image);
  paint.color.red = 0.25;
  object_move(object, -2.0, 0.0, 0.0);
  sipp_background(0.0, 0.0, 1.0);
  image = draw(20, PHONG);
  EXPECT(level(image, 2, 10, 0) == 64 && level(image, 12, 10, 0) == 0 && level(image, 12, 10, 2) == 255);
  sipp_pixmap_destruct(image);
  lightsource_create(0.0, 0.0, 1.0, 0.5, 0.5, 0.5, LIGHT_DIRECTION);
  paint.ambient = 0.0;
  paint.color.red = 1.0;
  image = draw(20, GOURAUD);
  EXPECT(level(image, 2, 10, 0) == 128);
  sipp_pixmap_destruct(image);
  object_rot_y(object, M_PI); /* back side */
  image = draw(20, FLAT);
  EXPECT(level(image, 17, 10, 0) == 0 && level(image, 17, 10, 2) == 255);
  sipp_pixmap_destruct(image);
  sipp_show_backfaces(TRUE);
  image = draw(20, FLAT);
  EXPECT(level(image, 17, 10, 0) == 128);
  sipp_pixmap_destruct(image);
}

static int calls = 0;
static int wrong = 0;
/* Red: u; green: z of the view vector; half transparent. */
static void own_shader(Vector* pos, Vector* normal, Vector* texture, Vector* view_vec,
                       Lightsource* light_list, double* scale, Color* color, Color* opacity) {
  calls++;
  if (fabs(pos->z) > 1e-5 || fabs(normal->z - 1.0) > 1e-5 || fabs(2.0 * texture->x - 1.0 - pos->x) > 1e-5 ||
      fabs(VecLen(*view_vec) - 1.0) > 1e-5 || light_list == NULL) {
    wrong++;
  }
  color->red = texture->x * *scale;
  color->grn = view_vec->z;
  color->blu = 0.0;
  opacity->red = opacity->grn = opacity->blu = 0.5;
}

static void shaders_of_the_program(void) {
  double scale = 1.0;
  Sipp_pixmap* image;
  current = "shaders of the program";
  start();
  lightsource_create(0.0, 0.0, 1.0, 1.0, 1.0, 1.0, LIGHT_DIRECTION);
  show(square(0.0, &scale, (Shader*)own_shader));
  sipp_background(0.0, 0.0, 1.0);
  image = draw(50, PHONG);
  EXPECT(wrong == 0);
  EXPECT(calls >= 350 && calls <= 450); /* 20 x 20 pixels */
  EXPECT(abs(level(image, 25, 25, 0) - 65) <= 4 && level(image, 25, 25, 2) == 128);
  EXPECT(abs(level(image, 25, 25, 1) - 127) <= 1);
  sipp_pixmap_destruct(image);
  calls = 0;
  image = draw(50, GOURAUD);
  EXPECT(calls == 4 && wrong == 0);
  sipp_pixmap_destruct(image);
  calls = 0;
  image = draw(50, FLAT);
  EXPECT(calls == 1);
  sipp_pixmap_destruct(image);
}

static void half_shader(Vector* pos, Vector* normal, Vector* texture, Vector* view_vec,
                        Lightsource* light_list, void* desc, Color* color, Color* opacity) {
  (void)pos, (void)normal, (void)view_vec, (void)light_list, (void)desc;
  color->red = color->grn = color->blu = texture->y > 0.5 ? 1.0 : 0.25;
  opacity->red = opacity->grn = opacity->blu = 1.0;
}

static void textures_are_in_perspective(void) {
  Object* object;
  Sipp_pixmap* image;
  int row, middle = -1;
  current = "perspective";
  start();
  object = show(square(0.0, NULL, (Shader*)half_shader));
  object_scale(object, 4.0, 4.0, 1.0);
  object_rot_x(object, -75.0 * M_PI / 180.0);
  image = draw(101, PHONG);
  for (row = 1; row < 101; row++) {
    if (level(image, 50, row, 0) == 64 && level(image, 50, row - 1, 0) == 255) middle = row;
  }
  EXPECT(abs(middle - 50) <= 1); /* linear on the screen it would be 9 rows off */
  sipp_pixmap_destruct(image);
}

static void ramp_shader(Vector* pos, Vector* normal, Vector* texture, Vector* view_vec,
                        Lightsource* light_list, void* desc, Color* color, Color* opacity) {
  (void)pos, (void)normal, (void)view_vec, (void)light_list, (void)desc;
  color->red = color->grn = color->blu = texture->y;
  opacity->red = opacity->grn = opacity->blu = 1.0;
}

/* What the page about programs says: how far the two modes are apart. */
static void colours_of_corners_are_linear_on_the_screen(void) {
  Object* object;
  Sipp_pixmap *phong, *gouraud;
  double deeper, apart;
  int row, difference, most = 0;
  current = "linear colours";
  start();
  object = show(square(0.0, NULL, (Shader*)ramp_shader));
  object_scale(object, 4.0, 4.0, 1.0);
  object_rot_x(object, -75.0 * M_PI / 180.0);
  phong = draw(201, PHONG);
  gouraud = draw(201, GOURAUD);
  for (row = 0; row < 201; row++) {
    difference = abs(level(phong, 100, row, 0) - level(gouraud, 100, row, 0));
    if (difference > most) most = difference;
  }
  deeper = 4.0 * sin(75.0 * M_PI / 180.0);
  apart = sqrt((10.0 + deeper) / (10.0 - deeper));
  apart = 255.0 * (apart - 1.0) / (apart + 1.0);
  EXPECT(fabs(apart - 51.0) < 0.5);
  EXPECT(fabs(most - apart) < 2.0);
  sipp_pixmap_destruct(phong);
  sipp_pixmap_destruct(gouraud);
}

static void opaque_answers_hide(void) {
  Surf_desc bright;
  Sipp_pixmap* image;
  current = "opaque answers";
  start();
  bright = white;
  bright.ambient = 1.0;
  show(square(0.0, NULL, (Shader*)half_shader));
  show(square(-0.5, &bright, (Shader*)basic_shader));
  show(square(-1.0, NULL, (Shader*)half_shader));
  image = draw(40, PHONG);
  EXPECT(level(image, 20, 24, 0) == 64);
  sipp_pixmap_destruct(image);
}

static void transparency_adds_up(void) {
  Surf_desc half;
  Sipp_pixmap* image;
  current = "transparency";
  start();
  half = white;
  half.ambient = 1.0;
  half.opacity.red = half.opacity.grn = half.opacity.blu = 0.5;
  show(square(0.0, &half, (Shader*)basic_shader));
  show(square(0.1, &half, (Shader*)basic_shader));
  show(square(-0.1, &half, (Shader*)basic_shader));
  image = draw(20, PHONG);
  EXPECT(level(image, 10, 10, 0) == 255);
  sipp_pixmap_destruct(image);
}

static int masked(int* flag, Vector* texture) {
  return *flag && texture->x > 0.5;
}

static void masks_and_bumps(void) {
  Surf_desc red, blue;
  Mask_desc mask;
  Bumpy_desc bumps;
  Sipp_pixmap* image;
  int flag = 1;
  current = "masks and bumps";
  start();
  red = blue = white;
  red.ambient = blue.ambient = 1.0;
  red.color.grn = red.color.blu = blue.color.red = blue.color.grn = 0.0;
  bumps.shader = (Shader*)basic_shader;
  bumps.surface = &blue;
  bumps.scale = 3.0;
  bumps.bumpflag = bumps.holeflag = TRUE;
  mask.t_shader = (Shader*)basic_shader;
  mask.t_surface = &red;
  mask.f_shader = (Shader*)bumpy_shader;
  mask.f_surface = &bumps;
  mask.mask_data = &flag;
  mask.masker = (Sipp_bool(*)())masked;
  show(square(0.0, &mask, (Shader*)mask_shader));
  image = draw(40, PHONG);
  EXPECT(level(image, 16, 20, 0) == 0 && level(image, 16, 20, 2) == 255);
  EXPECT(level(image, 24, 20, 0) == 255 && level(image, 24, 20, 2) == 0);
  sipp_pixmap_destruct(image);
  /* A shader that contains itself ends in a message. */
  bumps.shader = (Shader*)bumpy_shader;
  bumps.surface = &bumps;
  image = draw(40, PHONG);
  EXPECT(level(image, 16, 20, 2) == 0);
  sipp_pixmap_destruct(image);
}

static void red_of_basic(Vector* pos, Vector* normal, Vector* texture, Vector* view_vec,
                         Lightsource* light_list, Surf_desc* desc, Color* color, Color* opacity) {
  basic_shader(pos, normal, texture, view_vec, light_list, desc, color, opacity);
  color->grn = color->blu = 0.0;
  if (light_list != NULL && light_list->next != NULL) {
    Color of_the_others;
    basic_shader(pos, normal, texture, view_vec, light_list->next, desc, &of_the_others, opacity);
    color->grn = of_the_others.red;
  }
}

static void lights_in_shaders_of_the_program(void) {
  Surf_desc matt;
  Sipp_pixmap* image;
  current = "lights in shaders of the program";
  start();
  matt = white;
  matt.ambient = 0.0;
  light_active(lightsource_create(0.0, 0.0, 1.0, 0.1, 0.1, 0.1, LIGHT_DIRECTION), FALSE);
  lightsource_create(0.0, 0.0, 1.0, 0.25, 0.25, 0.25, LIGHT_DIRECTION);
  lightsource_create(0.0, 0.0, 1.0, 0.5, 0.5, 0.5, LIGHT_DIRECTION);
  show(square(0.0, &matt, (Shader*)red_of_basic));
  image = draw(20, PHONG);
  EXPECT(level(image, 10, 10, 0) == 191 && level(image, 10, 10, 1) == 64 && level(image, 10, 10, 2) == 0);
  sipp_pixmap_destruct(image);
}

static void lights_switched_off_give_no_light(void) {
  Surf_desc matt;
  Lightsource* light;
  Sipp_pixmap* image;
  int on, mode;
  current = "lights switched off";
  start();
  matt = white;
  matt.ambient = 0.25;
  light = lightsource_create(0.0, 0.0, 1.0, 0.5, 0.5, 0.5, LIGHT_DIRECTION);
  show(square(0.0, &matt, (Shader*)basic_shader));
  for (on = 0; on < 2; on++) {
    light_active(light, on);
    for (mode = PHONG; mode <= FLAT; mode++) {
      image = draw(20, mode);
      EXPECT(level(image, 10, 10, 0) == (on ? 191 : 64));
      sipp_pixmap_destruct(image);
    }
  }
}

static void called_shaders_equal_bound_ones(void) {
  Phong_desc phong = {0.2, 0.6, 0.4, 7, {0.8, 0.5, 0.2}, {1.0, 0.5, 0.25}};
  Vector pos, normal, texture, view;
  Color color, opacity;
  Surface* surface;
  Sipp_pixmap* image;
  current = "phong_shader";
  start();
  lightsource_create(0.0, 0.6, 0.8, 0.9, 0.9, 0.9, LIGHT_DIRECTION);
  MakeVector(pos, 0.0, 0.0, 0.0) MakeVector(normal, 0.0, 0.0, 2.0) MakeVector(texture, 0.0, 0.0, 0.0)
      MakeVector(view, 0.0, 0.0, 1.0);
  phong_shader(&pos, &normal, &texture, &view,
               sipp_world == NULL ? NULL : lightsource_push(0.0, 0.0, -1.0, 1.0)->next, &phong, &color,
               &opacity);
  EXPECT(NEAR(color.red, 0.8 * (0.2 + 0.6 * 0.72) + 0.4 * 0.9 * pow(0.8, 7.0)));
  EXPECT(opacity.grn == 0.5);
  phong.opacity.red = phong.opacity.grn = phong.opacity.blu = 1.0;
  surface = square(0.0, &phong, (Shader*)phong_shader);
  show(surface);
  image = draw(21, PHONG);
  EXPECT(abs(level(image, 10, 10, 0) - (int)(255.0 * color.red + 0.5)) <= 2);
  sipp_pixmap_destruct(image);
}

static void lift(double* height, Vector* pos, Vector* tex, Vector* new_pos, Vector* new_tex) {
  *new_pos = *pos;
  *new_tex = *tex;
  new_pos->x += *height;
}

static void deformation(void) {
  Surf_desc bright;
  Surface* surface;
  Sipp_pixmap* image;
  double height = 1.0;
  current = "deformation";
  start();
  bright = white;
  bright.ambient = 1.0;
  surface = square(0.0, &bright, (Shader*)basic_shader);
  show(surface);
  surface_set_ffd(surface, (FFD_func*)lift, &height);
  image = draw(40, PHONG);
  EXPECT(level(image, 14, 20, 0) == 0 && level(image, 26, 20, 0) == 255);
  sipp_pixmap_destruct(image);
  height = -1.0;
  image = draw(40, PHONG);
  EXPECT(level(image, 14, 20, 0) == 255 && level(image, 26, 20, 0) == 0);
  sipp_pixmap_destruct(image);
  surface_set_ffd(surface, NULL, NULL);
  image = draw(40, PHONG);
  EXPECT(level(image, 17, 20, 0) == 255 && level(image, 22, 20, 0) == 255);
  sipp_pixmap_destruct(image);
}

static void own_normals_survive_deformation(void) {
  Surf_desc matt;
  Surface* surface;
  Sipp_pixmap* image;
  double height = 0.1;
  int i;
  current = "own normals";
  start();
  lightsource_create(0.0, 0.0, 1.0, 1.0, 1.0, 1.0, LIGHT_DIRECTION);
  matt = white;
  matt.ambient = 0.0;
  for (i = 0; i < 4; i++) {
    vertex_n_push(i == 0 || i == 3 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0, 0.0, 3.0, 0.0, 4.0);
  }
  polygon_push();
  surface = surface_create(&matt, (Shader*)basic_shader);
  show(surface);
  for (i = 0; i < 2; i++) {
    image = draw(20, PHONG);
    EXPECT(level(image, 10, 10, 0) == 204); /* 0.8 */
    sipp_pixmap_destruct(image);
    surface_set_ffd(surface, (FFD_func*)lift, &height);
  }
}

/* ---- order of pixels, fields, files */

static int pixel_count, first_row, last_row, last_x, in_order;
static void count_pixels(void* data, int x, int y, int r, int g, int b) {
  (void)data, (void)r, (void)g, (void)b;
  if (pixel_count == 0) first_row = y;
  if (pixel_count > 0 && x != (last_x + 1) % 7) in_order = 0;
  last_x = x;
  last_row = y;
  pixel_count++;
}
static void count(int direction, int field) {
  sipp_render_direction(direction);
  pixel_count = 0, in_order = 1;
  render_field_func(7, 5, (void (*)())count_pixels, NULL, FLAT, 2, field);
}

static long size_of_file(int mode, int field, char* head, int length) {
  FILE* file = tmpfile();
  long size;
  size_t n;
  render_field_file(7, 5, file, mode, 1, field);
  size = ftell(file);
  rewind(file);
  n = fread(head, 1, (size_t)length - 1, file);
  head[n] = '\0';
  fclose(file);
  return size;
}

static int wanted_pixels;
static void stop_soon(void* data, int x, int y, int r, int g, int b) {
  (void)data, (void)x, (void)y, (void)r, (void)g, (void)b;
  if (++pixel_count == wanted_pixels) sipp_render_terminate();
}

static void fields_and_files(void) {
  char head[200];
  current = "fields and files";
  start();
  count(TOP_TO_BOTTOM, BOTH);
  EXPECT(pixel_count == 35 && first_row == 0 && last_row == 4 && in_order);
  count(BOTTOM_TO_TOP, BOTH);
  EXPECT(pixel_count == 35 && first_row == 4 && last_row == 0 && in_order);
  count(TOP_TO_BOTTOM, EVEN);
  EXPECT(pixel_count == 21 && first_row == 0 && last_row == 4);
  count(TOP_TO_BOTTOM, ODD);
  EXPECT(pixel_count == 14 && first_row == 1 && last_row == 3);
  pixel_count = 0, wanted_pixels = 3;
  render_image_func(7, 5, (void (*)())stop_soon, NULL, FLAT, 1);
  EXPECT(pixel_count == 3);
  EXPECT(size_of_file(PHONG, BOTH, head, 200) == (long)(strstr(head, "\n255\n") - head + 5 + 105));
  EXPECT(strncmp(head, "P6\n#", 4) == 0 && strstr(head, "\n7\n5\n255\n") != NULL);
  size_of_file(PHONG, EVEN, head, 200);
  EXPECT(strstr(head, "\n# even field\n7\n3\n255\n") != NULL);
  size_of_file(PHONG, ODD, head, 200);
  EXPECT(strstr(head, "\n# odd field\n7\n2\n255\n") != NULL);
  size_of_file(LINE, BOTH, head, 200);
  EXPECT(strncmp(head, "P4\n#", 4) == 0 && strstr(head, "\n7\n5\n") != NULL);
  EXPECT(size_of_file(LINE, EVEN, head, 200) == 0); /* refused */
  EXPECT(size_of_file(17, BOTH, head, 200) == 0);
}

static int lines, upward, outside;
static void count_lines(void* data, int x1, int y1, int x2, int y2) {
  (void)data;
  lines++;
  if (y1 > y2) upward++;
  if (x1 < 0 || x2 < 0 || x1 > 40 || x2 > 40 || y1 < 0 || y2 > 40) outside++;
}

static void line_mode(void) {
  Sipp_bitmap* bitmap;
  int i, black = 0;
  current = "line mode";
  start();
  object_add_subobj(sipp_world, sipp_cube(2.0, &white, (Shader*)basic_shader, WORLD));
  render_image_func(41, 41, (void (*)())count_lines, NULL, LINE, 3);
  EXPECT(lines == 4 && upward == 0 && outside == 0);
  sipp_show_backfaces(TRUE);
  lines = 0;
  render_image_func(41, 41, (void (*)())count_lines, NULL, LINE, 1);
  EXPECT(lines == 24);
  bitmap = sipp_bitmap_create(41, 41);
  EXPECT(bitmap->width_bytes == 6);
  sipp_show_backfaces(FALSE);
  render_image_func(41, 41, (void (*)())sipp_bitmap_line, bitmap, LINE, 1);
  for (i = 0; i < 41 * 6 * 8; i++) black += (bitmap->buffer[i / 8] >> (7 - i % 8)) & 1;
  /* The front of the cube: half side 1 at distance 9, 20 pixels for 0.25. */
  EXPECT(black == 4 * 18);
  EXPECT((bitmap->buffer[11 * 6 + 11 / 8] & (0x80 >> (11 % 8))) != 0);
  sipp_bitmap_line(bitmap, -5, -5, 60, 50); /* clipped */
  memset(bitmap->buffer, 0, 41 * 6);
  sipp_bitmap_line(bitmap, -2000000000, -2000000000, 2000000000, 2000000000);
  sipp_bitmap_line(bitmap, -2000000000, 50, 2000000000, 2000000000);
  for (i = 0, black = 0; i < 41 * 6 * 8; i++) black += (bitmap->buffer[i / 8] >> (7 - i % 8)) & 1;
  EXPECT(black == 41 && (bitmap->buffer[40 * 6 + 5] & 0x80) != 0);
  sipp_bitmap_destruct(bitmap);
}

static int updates, stop_after;
static void update(void* data) {
  (*(int*)data)++;
  updates++;
  if (updates == stop_after) sipp_render_terminate();
}

static void stopping_shader(Vector* pos, Vector* normal, Vector* texture, Vector* view_vec,
                            Lightsource* light_list, void* desc, Color* color, Color* opacity) {
  (void)pos, (void)normal, (void)texture, (void)view_vec, (void)light_list, (void)desc, (void)color,
      (void)opacity;
  if (++calls == 5) sipp_render_terminate();
}
static void nothing(void* data) {
  (void)data;
}

static void updates_and_giving_up(void) {
  int seen = 0;
  Surf_desc bright;
  Sipp_pixmap* image;
  current = "updates";
  start();
  bright = white;
  bright.ambient = 1.0;
  show(square(0.0, &bright, (Shader*)basic_shader));
  sipp_set_update_callback(update, &seen, 99);
  image = draw(50, PHONG);
  EXPECT(seen == updates && updates >= 25 && updates <= 30); /* 2500 pixels and 400 shaded ones */
  EXPECT(level(image, 25, 25, 0) == 255);
  sipp_pixmap_destruct(image);
  updates = 0;
  stop_after = 2; /* while shading */
  image = draw(50, PHONG);
  EXPECT(updates == 2 && level(image, 25, 25, 0) == 0);
  sipp_pixmap_destruct(image);
  updates = 0;
  stop_after = 20; /* while delivering */
  image = draw(50, PHONG);
  EXPECT(updates == 20 && level(image, 25, 25, 0) == 255);
  sipp_pixmap_destruct(image);
  start();
  show(square(0.0, NULL, (Shader*)stopping_shader));
  sipp_set_update_callback(nothing, NULL, 1000000);
  calls = 0;
  sipp_pixmap_destruct(draw(50, PHONG));
  EXPECT(calls == 5);
  sipp_set_update_callback(NULL, NULL, 0);
  calls = 0;
  sipp_pixmap_destruct(draw(50, PHONG));
  EXPECT(calls == 5);
  start();
  show(square(0.0, &bright, (Shader*)basic_shader));
  updates = 0;
  image = draw(50, PHONG);
  EXPECT(updates == 0 && level(image, 25, 25, 0) == 255);
  sipp_pixmap_destruct(image);
}

/* ---- the rest */

static void shadows(void) {
  Surf_desc matt;
  Sipp_pixmap* image;
  int way;
  current = "shadows";
  for (way = 0; way < 4; way++) {
    start();
    matt = white;
    matt.ambient = 0.0;
    show(square(0.0, &matt, (Shader*)basic_shader));
    spotlight_create(5.0, 0.0, 5.0, 0.0, 0.0, 0.0, 40.0, 1.0, 1.0, 1.0, SPOT_SHARP, way != 3);
    if (way == 1) sipp_shadows(TRUE, 0);
    if (way == 2) shadowmaps_create(128); /* before there is anything that casts one */
    if (way == 3) sipp_shadows(TRUE, 0);  /* but the light casts none */
    {
      Object* blind = show(square(0.0, &matt, (Shader*)basic_shader));
      object_scale(blind, 0.5, 0.5, 1.0);
      object_move(blind, 2.5, 0.0, 2.5);
      image = draw(50, PHONG);
    }
    if (way == 1) {
      EXPECT(level(image, 25, 25, 0) == 0);
    } else {
      EXPECT(level(image, 25, 25, 0) > 170);
    }
    sipp_pixmap_destruct(image);
    shadowmaps_destruct();
  }
}

static void noise_family(void) {
  Vector p, gradient, shifted;
  double before, sum;
  current = "noise";
  EXPECT(noise_ready == TRUE || noise_ready == FALSE);
  MakeVector(p, 0.3, -1.7, 12.25);
  before = noise(&p);
  EXPECT(noise_ready == TRUE && fabs(before) < 1.0 && noise(&p) == before);
  gradient = Dnoise(&p);
  shifted = p;
  shifted.x += 1e-6;
  EXPECT(fabs((noise(&shifted) - before) / 1e-6 - gradient.x) < 1e-4);
  MakeVector(shifted, 0.6, -3.4, 24.5);
  sum = before + noise(&shifted) / 2.0;
  EXPECT(NEAR(turbulence(&p, 2), sum));
  noise_init();
  EXPECT(noise(&p) != before); /* the next 512 numbers of drand48() */
  EXPECT(fabs(RANDOM()) <= 1.0);
}

static void primitives(void) {
  Vector triangle[3];
  Vector profile[4];
  int curve[4] = {0, 1, 2, 3};
  FILE* file;
  current = "primitives";
  start();
  EXPECT(sipp_cone(-1.0, 1.0, 1.0, 8, &white, (Shader*)basic_shader, WORLD) == NULL);
  EXPECT(sipp_sphere(1.0, 8, &white, (Shader*)basic_shader, 17) == NULL);
  EXPECT(sipp_torus(1.0, 0.5, 100000, 100000, &white, (Shader*)basic_shader, WORLD) == NULL);
  EXPECT(sipp_teapot(3, &white, (Shader*)basic_shader, WORLD)->num_sub_objs == 4);
  EXPECT(sipp_cylinder(1.0, 1.0, 8, &white, (Shader*)basic_shader, NATURAL)->num_surfaces == 3);
  MakeVector(triangle[0], 0.0, 0.0, 0.0) MakeVector(triangle[1], 1.0, 0.0, 0.0)
      MakeVector(triangle[2], 0.0, 1.0, 0.0);
  EXPECT(sipp_prism(3, triangle, 2.0, &white, (Shader*)basic_shader, WORLD)->num_surfaces == 5);
  MakeVector(profile[0], 1.0, 0.0, 0.0) MakeVector(profile[1], 2.0, 0.0, 1.0)
      MakeVector(profile[2], 2.0, 0.0, 2.0) MakeVector(profile[3], 1.0, 0.0, 3.0);
  EXPECT(sipp_bezier_rotcurve(4, profile, 1, curve, 3, &white, (Shader*)basic_shader, WORLD) != NULL);
  curve[2] = 4;
  EXPECT(sipp_bezier_rotcurve(4, profile, 1, curve, 3, &white, (Shader*)basic_shader, WORLD) == NULL);
  file = tmpfile();
  fputs("bezier_curves: vertices: 4 vertex_list: 1 0 0 2 0 1 2 0 2 1 0 3 curves: 1 curve_list: 4 3 2 1\n",
        file);
  rewind(file);
  EXPECT(sipp_bezier_file(file, 3, &white, (Shader*)basic_shader, WORLD) != NULL);
  EXPECT(sipp_bezier_file(file, 3, &white, (Shader*)basic_shader, WORLD) == NULL); /* at its end */
  fclose(file);
}

static void bad_scenes_end_in_messages(void) {
  Object *a, *b;
  Sipp_pixmap* image;
  double zero = 0.0;
  current = "bad scenes";
  start();
  a = object_create(), b = object_create();
  object_add_subobj(sipp_world, a);
  object_add_subobj(a, b);
  object_add_subobj(b, a);
  image = draw(8, PHONG);
  EXPECT(object_dup(a) == NULL);
  sipp_pixmap_destruct(image);
  start();
  view_at(0.0, 0.0, 10.0);
  sipp_pixmap_destruct(draw(8, PHONG));
  start();
  view_focal(0.0);
  sipp_pixmap_destruct(draw(8, PHONG));
  start();
  show(square(zero / zero, &white, (Shader*)basic_shader));
  show(square(1.0 / zero, &white, NULL));
  show(square(0.0, NULL, (Shader*)basic_shader));
  sipp_pixmap_destruct(draw(8, PHONG));
  render_image_func(0, 8, (void (*)())count_pixels, NULL, PHONG, 1);
  render_image_func(8, 8, (void (*)())count_pixels, NULL, PHONG, 0);
  render_image_func(8, 8, NULL, NULL, PHONG, 1);
  render_image_file(8, 8, NULL, PHONG, 1);
  EXPECT(sipp_pixmap_create(-1, 8) == NULL && sipp_bitmap_create(8, 0) == NULL);
  image = sipp_pixmap_create(2, 2);
  sipp_pixmap_set_pixel(image, 2, 0, 1, 1, 1);
  EXPECT(image->buffer[6] == 0);
  sipp_pixmap_destruct(image);
  EXPECT(farop_sipp_capture("scene.obj") == FALSE);
  EXPECT(farop_sipp_capture(NULL) == TRUE);
}

int main(void) {
  view_from(0.0, 0.0, 0.0); /* before sipp_init(): nothing happens */
  sipp_pixmap_destruct(draw(4, PHONG));
  noise_family();
  geometry();
  objects();
  headers_of_descriptions();
  lights();
  cameras();
  late_binding();
  shaders_of_the_program();
  textures_are_in_perspective();
  colours_of_corners_are_linear_on_the_screen();
  opaque_answers_hide();
  transparency_adds_up();
  masks_and_bumps();
  lights_in_shaders_of_the_program();
  lights_switched_off_give_no_light();
  called_shaders_equal_bound_ones();
  deformation();
  own_normals_survive_deformation();
  fields_and_files();
  line_mode();
  updates_and_giving_up();
  shadows();
  primitives();
  bad_scenes_end_in_messages();
  if (failures > 0) fprintf(stderr, "%d expectations failed\n", failures);
  return failures > 0;
}
