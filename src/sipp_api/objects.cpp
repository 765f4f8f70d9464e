// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <unordered_map>

#include "library_internal.h"
#include "parse_sipp/sipp_objects.h"
#include "parse_sipp/sipp_transform.h"
#include "tree_internal.h"

namespace farop::sipp_api {
namespace {

/// Appends to one of an object's two lists.
template <class Item>
void append(Item**& items, int& count, int& room, Item* item) {
  if (count == room) {
    room = room == 0 ? 4 : 2 * room;
    items = static_cast<Item**>(srealloc(items, sizeof(Item*) * static_cast<std::size_t>(room)));
  }
  items[count++] = item;
}

/// The last item moves into the hole of the first that is `item`.
template <class Item>
bool take_out(Item** items, int& count, const Item* item) {
  Item** const end = items + count;
  Item** const found = std::find(items, end, item);
  if (found == end) return false;
  *found = end[-1];
  --count;
  return true;
}

/// Drops a reference, and all that hangs on the last one. No recursion: trees may be deep.
void drop(::Object* object) {
  std::vector<::Object*> open{object};
  while (!open.empty()) {
    ::Object* const top = open.back();
    open.pop_back();
    if (top == nullptr || top == sipp_world || --top->ref_count > 0) continue;
    for (int i = 0; i < top->num_surfaces; ++i) surface_unref(top->surfaces[i]);
    open.insert(open.end(), top->sub_objs, top->sub_objs + top->num_sub_objs);
    sfree(top->surfaces);
    sfree(top->sub_objs);
    sfree(top);
  }
}

::Object* copy(const ::Object& object, bool copy_surfaces) {
  ::Object* const out = new_object();
  for (int i = 0; i < object.num_surfaces; ++i) {
    ::Surface* surface = object.surfaces[i];
    if (copy_surfaces) {
      auto* const own = new SippSurface(*surface);
      own->geometry = std::make_shared<farop::Surface>(*surface->geometry);
      own->ref_count = 0;
      if (own->header != nullptr) ++own->header->ref_count;
      if (own->ffd_header != nullptr) ++own->ffd_header->ref_count;
      surface = own;
    }
    append_surface(*out, *surface);
  }
  for (int i = 0; i < object.num_sub_objs; ++i) {
    ::Object* const sub_object = copy(*object.sub_objs[i], copy_surfaces);
    sub_object->ref_count = 0;
    append_sub_object(*out, *sub_object);
  }
  return out;
}

::Object* copied(::Object* object, bool copy_surfaces) {
  if (object == nullptr) return nullptr;
  return guarded<::Object*>(nullptr, [&] {
    check_tree(*object);
    const TreeCount count = count_tree(*object);
    if (count.objects > farop::sipp::k_max_copied_objects ||
        (copy_surfaces && count.polygons > farop::sipp::k_max_copied_polygons)) {
      throw Error(ExitStatus::input,
                  fmt::format("a copy would have {} objects and {} polygons", count.objects, count.polygons),
                  "use object_instance");
    }
    return copy(*object, copy_surfaces);
  });
}

template <class Operation>
void move(::Object* object, const Operation& operation) {
  if (object == nullptr) return;
  M44d matrix = to_matrix(object->transf);
  operation(matrix);
  object->transf = from_matrix(matrix);
}

}  // namespace

::Object* new_object() {
  auto* const object = static_cast<::Object*>(scalloc(1, sizeof(::Object)));
  object->transf = ident_matrix;
  object->ref_count = state().user_refcount ? 1 : 0;
  return object;
}

void append_surface(::Object& object, ::Surface& surface) {
  append(object.surfaces, object.num_surfaces, object.max_surfaces, &surface);
  ++surface.ref_count;
}

void append_sub_object(::Object& object, ::Object& sub_object) {
  append(object.sub_objs, object.num_sub_objs, object.max_sub_objs, &sub_object);
  ++sub_object.ref_count;
}

void check_tree(const ::Object& top) {
  enum class Mark : std::uint8_t { open, done };
  struct Step {
    const ::Object* object;
    int next;
  };
  std::unordered_map<const ::Object*, Mark> marks{{&top, Mark::open}};
  std::unordered_map<const ::Object*, std::uint64_t> depths;
  std::vector<Step> path{{&top, 0}};
  while (!path.empty()) {
    const ::Object* const object = path.back().object;
    if (path.back().next < object->num_sub_objs) {
      const ::Object* const sub_object = object->sub_objs[path.back().next++];
      const auto [mark, is_new] = marks.emplace(sub_object, Mark::open);
      if (is_new) {
        path.push_back({sub_object, 0});
      } else if (mark->second == Mark::open) {
        throw Error(ExitStatus::input, "an object contains itself", "look at the object_add_subobj calls");
      }
      continue;
    }
    std::uint64_t depth = 1;
    for (int i = 0; i < object->num_sub_objs; ++i) depth = std::max(depth, depths[object->sub_objs[i]] + 1);
    if (depth > farop::sipp::k_max_depth) {
      throw Error(ExitStatus::input,
                  fmt::format("objects lie more than {} levels deep", farop::sipp::k_max_depth));
    }
    depths[object] = depth;
    marks[object] = Mark::done;
    path.pop_back();
  }
}

TreeCount count_tree(const ::Object& top) {
  std::unordered_map<const ::Object*, TreeCount> known;
  const auto count = [&](const auto& self, const ::Object& object) -> TreeCount {
    if (const auto found = known.find(&object); found != known.end()) return found->second;
    TreeCount sum{1, 0};
    for (int i = 0; i < object.num_surfaces; ++i) {
      sum.polygons += static_cast<double>(object.surfaces[i]->geometry->polygons.size());
    }
    for (int i = 0; i < object.num_sub_objs; ++i) {
      const TreeCount below = self(self, *object.sub_objs[i]);
      sum.objects += below.objects;
      sum.polygons += below.polygons;
    }
    return known.emplace(&object, sum).first->second;
  };
  return count(count, top);
}

}  // namespace farop::sipp_api

using namespace farop::sipp_api;
namespace sipp = farop::sipp;
using farop::M44d;

::Object* object_create() {
  return new_object();
}

::Object* object_instance(::Object* object) {
  if (object == nullptr) return nullptr;
  ::Object* const out = new_object();
  for (int i = 0; i < object->num_surfaces; ++i) append_surface(*out, *object->surfaces[i]);
  for (int i = 0; i < object->num_sub_objs; ++i) append_sub_object(*out, *object->sub_objs[i]);
  return out;
}
::Object* object_dup(::Object* object) {
  return copied(object, false);
}
::Object* object_deep_dup(::Object* object) {
  return copied(object, true);
}
void object_unref(::Object* object) {
  guarded([&] { drop(object); });
}
void object_delete(::Object* object) {
  object_unref(object);
}
void object_add_surface(::Object* object, ::Surface* surface) {
  if (object != nullptr && surface != nullptr) append_surface(*object, *surface);
}
void object_add_subobj(::Object* object, ::Object* sub_object) {
  if (object != nullptr && sub_object != nullptr) append_sub_object(*object, *sub_object);
}
Sipp_bool object_sub_surface(::Object* object, ::Surface* surface) {
  if (object == nullptr || !take_out(object->surfaces, object->num_surfaces, surface)) return FALSE;
  surface_unref(surface);
  return TRUE;
}
Sipp_bool object_sub_subobj(::Object* object, ::Object* sub_object) {
  if (object == nullptr || !take_out(object->sub_objs, object->num_sub_objs, sub_object)) return FALSE;
  object_unref(sub_object);
  return TRUE;
}

void object_set_transf(::Object* object, Transf_mat* matrix) {
  if (object != nullptr && matrix != nullptr) object->transf = *matrix;
}
Transf_mat* object_get_transf(::Object* object, Transf_mat* matrix) {
  if (object == nullptr) return nullptr;
  if (matrix == nullptr) return transf_mat_create(&object->transf);
  *matrix = object->transf;
  return matrix;
}
void object_clear_transf(::Object* object) {
  if (object != nullptr) object->transf = ident_matrix;
}
void object_transform(::Object* object, Transf_mat* matrix) {
  if (matrix != nullptr) move(object, [&](M44d& m) { sipp::transform(m, to_matrix(*matrix)); });
}
void object_rot_x(::Object* object, double angle) {
  move(object, [&](M44d& m) { sipp::rotate_x(m, angle); });
}
void object_rot_y(::Object* object, double angle) {
  move(object, [&](M44d& m) { sipp::rotate_y(m, angle); });
}
void object_rot_z(::Object* object, double angle) {
  move(object, [&](M44d& m) { sipp::rotate_z(m, angle); });
}
void object_rot(::Object* object, Vector* point, Vector* vector, double angle) {
  if (point == nullptr || vector == nullptr) return;
  move(object, [&](M44d& m) { sipp::rotate(m, to_vector(*point), to_vector(*vector), angle); });
}
void object_scale(::Object* object, double sx, double sy, double sz) {
  move(object, [&](M44d& m) { sipp::scale(m, {sx, sy, sz}); });
}
void object_move(::Object* object, double dx, double dy, double dz) {
  move(object, [&](M44d& m) { sipp::translate(m, {dx, dy, dz}); });
}
