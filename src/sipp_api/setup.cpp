// SPDX-License-Identifier: GPL-3.0-or-later
// The library's state, its switches, memory, vectors and matrices.
#include <cstdio>
#include <cstdlib>

#include "library_internal.h"
#include "parse_sipp/sipp_transform.h"

namespace {
char g_version[] = "3.1 (FAROP)";
}

char* SIPP_VERSION = g_version;
::Object* sipp_world = nullptr;
::Camera* sipp_camera = nullptr;
Transf_mat ident_matrix = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

namespace farop::sipp_api {

void message(const std::string& text) {
  std::fprintf(stderr, "sipp: %s\n", text.c_str());
}

void out_of_memory() {
  std::fputs("sipp: out of memory\n", stderr);
  std::exit(4);
}

State& state() {
  // Never destroyed: programs may call us from their exit functions.
  static State* const the_state = new State;
  return *the_state;
}

bool worked() {
  State& s = state();
  if (s.update != nullptr && ++s.work > s.update_period) {
    s.work = 0;
    s.update(s.update_data);
  }
  return s.terminated;
}

M44d to_matrix(const Transf_mat& m) {
  M44d out;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) out[row][column] = m.mat[row][column];
  }
  return out;
}

Transf_mat from_matrix(const M44d& m) {
  Transf_mat out;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) out.mat[row][column] = m[row][column];
  }
  return out;
}

namespace {

template <class Operation>
void apply(Transf_mat* m, const Operation& operation) {
  if (m == nullptr) return;
  M44d matrix = to_matrix(*m);
  operation(matrix);
  *m = from_matrix(matrix);
}

}  // namespace
}  // namespace farop::sipp_api

using namespace farop::sipp_api;
namespace sipp = farop::sipp;

void sipp_init() {
  guarded([] {
    State& s = state();
    // What an earlier start made is left alone: the program may still hold it.
    s.builder.clear();
    s.show_backfaces = s.bottom_to_top = s.shadows = s.lasting_shadows = false;
    s.shadow_size = 256;
    s.background = {};
    s.update = nullptr;
    s.lights = nullptr;
    sipp_world = new_object();
    sipp_world->ref_count = 1;
    s.standard_camera = {{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 0.25};
    sipp_camera = &s.standard_camera;
    s.initialized = true;
  });
}

void sipp_show_backfaces(Sipp_bool flag) {
  state().show_backfaces = flag != 0;
}
void sipp_render_direction(int direction) {
  state().bottom_to_top = direction == BOTTOM_TO_TOP;
}
void sipp_background(double red, double grn, double blu) {
  state().background = {red, grn, blu};
}
void sipp_set_update_callback(Update_func* func, void* client_data, int period) {
  State& s = state();
  s.update = func;
  s.update_data = client_data;
  s.update_period = period;
  s.work = 0;
}
void sipp_shadows(Sipp_bool flag, int size) {
  state().shadows = flag != 0;
  state().shadow_size = size > 0 ? size : 256;
}
Sipp_bool sipp_user_refcount(Sipp_bool flag) {
  return std::exchange(state().user_refcount, flag != 0) ? TRUE : FALSE;
}
Sipp_bool sipp_surface_desc_headers(Sipp_bool flag) {
  return std::exchange(state().surface_headers, flag != 0) ? TRUE : FALSE;
}
Sipp_bool sipp_ffd_desc_headers(Sipp_bool flag) {
  return std::exchange(state().ffd_headers, flag != 0) ? TRUE : FALSE;
}

void* smalloc(size_t size) {
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) out_of_memory();
  return memory;
}
void* scalloc(size_t size, size_t item_size) {
  void* const memory = std::calloc(size > 0 ? size : 1, item_size > 0 ? item_size : 1);
  if (memory == nullptr) out_of_memory();
  return memory;
}
void* srealloc(void* memory, size_t size) {
  void* const larger = std::realloc(memory, size > 0 ? size : 1);
  if (larger == nullptr) out_of_memory();
  return larger;
}
void sfree(void* memory) {
  std::free(memory);
}
double sipp_random() {
  return next_random();
}

void vecnorm(Vector* v) {
  *v = from_vector(to_vector(*v).normalized());
}

Transf_mat* transf_mat_create(Transf_mat* init) {
  auto* const m = static_cast<Transf_mat*>(smalloc(sizeof(Transf_mat)));
  *m = init != nullptr ? *init : ident_matrix;
  return m;
}
void transf_mat_destruct(Transf_mat* m) {
  sfree(m);
}
void mat_translate(Transf_mat* m, double dx, double dy, double dz) {
  apply(m, [&](farop::M44d& matrix) { sipp::translate(matrix, {dx, dy, dz}); });
}
void mat_rotate_x(Transf_mat* m, double angle) {
  apply(m, [&](farop::M44d& matrix) { sipp::rotate_x(matrix, angle); });
}
void mat_rotate_y(Transf_mat* m, double angle) {
  apply(m, [&](farop::M44d& matrix) { sipp::rotate_y(matrix, angle); });
}
void mat_rotate_z(Transf_mat* m, double angle) {
  apply(m, [&](farop::M44d& matrix) { sipp::rotate_z(matrix, angle); });
}
void mat_rotate(Transf_mat* m, Vector* point, Vector* vector, double angle) {
  apply(m, [&](farop::M44d& matrix) { sipp::rotate(matrix, to_vector(*point), to_vector(*vector), angle); });
}
void mat_scale(Transf_mat* m, double sx, double sy, double sz) {
  apply(m, [&](farop::M44d& matrix) { sipp::scale(matrix, {sx, sy, sz}); });
}
void mat_mirror_plane(Transf_mat* m, Vector* point, Vector* normal) {
  apply(m, [&](farop::M44d& matrix) { sipp::mirror(matrix, to_vector(*point), to_vector(*normal)); });
}
void mat_mul(Transf_mat* result, Transf_mat* first, Transf_mat* second) {
  *result = from_matrix(to_matrix(*first) * to_matrix(*second));
}
void point_transform(Vector* result, Vector* point, Transf_mat* m) {
  *result = from_vector(to_vector(*point) * to_matrix(*m));
}
