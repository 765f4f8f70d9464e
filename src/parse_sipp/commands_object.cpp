// SPDX-License-Identifier: GPL-3.0-or-later
// Objects, their tree and their transformations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "parse_sipp/script.h"
#include "parse_sipp/sipp_objects.h"
#include "parse_sipp/sipp_transform.h"

namespace farop::sipp {
namespace {

/// {x y z}, three numbers, or (if allowed) one number for all.
V3d vector_of_words(std::span<Tcl_Obj* const> words, std::string_view what, bool one_for_all) {
  if (words.size() == 3) return {number(words[0], what), number(words[1], what), number(words[2], what)};
  if (words.size() != 1)
    throw ScriptError(fmt::format("{} words found for {}, expected {{x y z}}", words.size(), what));
  if (one_for_all && list(words[0], what).size() == 1) return V3d(number(words[0], what));
  return vector(words[0], what);
}

V3d direction(Tcl_Obj* word, std::string_view what) {
  const V3d v = vector(word, what);
  if (v == V3d(0)) unexpected(word, what, "a vector other than 0 0 0");
  return v;
}

bool is_finite(const M44d& m) {
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) {
      if (!std::isfinite(m[r][c])) return false;
    }
  }
  return true;
}

}  // namespace

Tcl_Obj* Script::new_object(std::shared_ptr<Object> object) {
  count_objects(1);
  const auto node = object;
  node->name = objects_.add(std::move(object));
  return new_text(node->name);
}

void Script::add_subobjects(Words words) {
  if (words.size() == 3) {
    // Without a look for cycles there would be trees without an end, so -nocheck changes nothing.
    if (!is_word(words[0], "-check") && !is_word(words[0], "-nocheck")) {
      unexpected(words[0], "a flag", "-check or -nocheck");
    }
    words = words.subspan(1);
  }
  const std::shared_ptr<Object> parent = objects_.at(words[0]);
  std::vector<std::shared_ptr<Object>> children;
  for (Tcl_Obj* word : list(words[1], "a list of objects")) {
    const std::shared_ptr<Object>& child = objects_.at(word);
    if (child == parent || (ever_children_.contains(parent.get()) && contains(*child, *parent))) {
      throw ScriptError(fmt::format("{} contains {} already, so it cannot become a part of it", quoted(word),
                                    quoted(words[0])),
                        std::string(text_of(word)));
    }
    children.push_back(child);
  }
  for (auto& child : children) {
    if (std::weak_ptr<Object>& known = first_parents_[child.get()]; known.expired()) known = parent;
    ever_children_.insert(child.get());
    parent->children.push_back(std::move(child));
  }
}

void Script::sub_subobjects(Words words) {
  const std::shared_ptr<Object> parent = objects_.at(words[0]);
  auto& children = parent->children;
  const auto forget = [&](std::shared_ptr<Object> child) {
    const auto known = first_parents_.find(child.get());
    if (known != first_parents_.end() && known->second.lock() == parent) first_parents_.erase(known);
    release(std::move(child));
  };
  if (is_word(words[1], "ALL")) {
    std::vector<std::shared_ptr<Object>> all;
    all.swap(children);
    for (auto& child : all) forget(std::move(child));
    return;
  }
  for (Tcl_Obj* word : list(words[1], "a list of objects")) {
    const std::shared_ptr<Object> child = objects_.at(word);
    const auto found = std::find(children.begin(), children.end(), child);
    if (found == children.end()) {
      throw ScriptError(fmt::format("{} is no sub-object of {}", quoted(word), quoted(words[0])),
                        std::string(text_of(word)));
    }
    *found = std::move(children.back());  // the last one moves into the hole
    children.pop_back();
    forget(child);
  }
}

Tcl_Obj* Script::ancestor(const std::shared_ptr<Object>& object) {
  std::shared_ptr<Object> at = object;
  for (std::uint64_t level = 0; level < 1'000'000; ++level) {
    const auto known = first_parents_.find(at.get());
    at = known == first_parents_.end() ? nullptr : known->second.lock();
    if (at == nullptr || at == world_) return nullptr;
    const TclValue name{std::string_view(at->name)};
    if (objects_.contains(name.get()) && objects_.at(name.get()) == at) return new_text(at->name);
  }
  return nullptr;
}

void Script::add_object_commands() {
  add("SippObjectCreate", "", 0, 0, [this](Words) { return new_object(std::make_shared<Object>()); });
  add("SippObjectUnref", "objectlist|ALL", 1, 1, [this](Words w) -> Tcl_Obj* {
    if (is_word(w[0], "ALL")) {
      auto all = std::move(objects_.all());
      objects_.all().clear();
      objects_.add_named("WORLD", world_);
      for (auto& [name, object] : all) release(std::move(object));
    } else {
      for (Tcl_Obj* word : list(w[0], "a list of objects")) {
        if (objects_.at(word) == world_) continue;  // cannot be freed
        release(objects_.take(word));
      }
    }
    return nullptr;
  });
  add("SippObjectInstance", "object", 1, 1,
      [this](Words w) { return new_object(instance(*objects_.at(w[0]))); });
  add("SippObjectDup", "object", 1, 1, [this](Words w) {
    const Object& object = *objects_.at(w[0]);
    count_objects(tree_size(object).objects);
    return new_object(dup(object));
  });
  add("SippObjectDeepDup", "object", 1, 1, [this](Words w) {
    const Object& object = *objects_.at(w[0]);
    const TreeSize size = tree_size(object);
    count_objects(size.objects);
    count_polygons(size.polygons);
    return new_object(deep_dup(object));
  });
  add("SippObjectAddSurface", "object surfacelist", 2, 2, [this](Words w) -> Tcl_Obj* {
    Object& object = *objects_.at(w[0]);
    std::vector<std::shared_ptr<Surface>> surfaces;
    for (Tcl_Obj* word : list(w[1], "a list of surfaces")) surfaces.push_back(surfaces_.at(word));
    object.surfaces.insert(object.surfaces.end(), surfaces.begin(), surfaces.end());
    return nullptr;
  });
  add("SippObjectSubSurface", "object surfacelist", 2, 2, [this](Words w) -> Tcl_Obj* {
    auto& surfaces = objects_.at(w[0])->surfaces;
    for (Tcl_Obj* word : list(w[1], "a list of surfaces")) {
      const auto found = std::find(surfaces.begin(), surfaces.end(), surfaces_.at(word));
      if (found == surfaces.end()) {
        throw ScriptError(fmt::format("{} is no surface of {}", quoted(word), quoted(w[0])),
                          std::string(text_of(word)));
      }
      std::iter_swap(found, surfaces.end() - 1);
      surfaces.pop_back();
    }
    return nullptr;
  });
  add("SippObjectSurfaceCreate", "object shader", 2, 2, [this](Words w) -> Tcl_Obj* {
    Object& object = *objects_.at(w[0]);
    object.surfaces.push_back(create_surface(w[1]));
    return nullptr;
  });
  add("SippObjectAddSubobj", "?-check|-nocheck? object subobjlist", 2, 3, [this](Words w) -> Tcl_Obj* {
    add_subobjects(w);
    return nullptr;
  });
  add("SippObjectSubSubobj", "object subobjlist|ALL", 2, 2, [this](Words w) -> Tcl_Obj* {
    sub_subobjects(w);
    return nullptr;
  });
  add("SippObjectAncestor", "object", 1, 1, [this](Words w) { return ancestor(objects_.at(w[0])); });
}

void Script::transform(Tcl_Obj* objects, const std::function<void(M44d&)>& change) {
  for (Tcl_Obj* word : list(objects, "a list of objects")) {
    Object& object = *objects_.at(word);
    M44d changed = object.to_parent;
    change(changed);
    if (!is_finite(changed)) {
      throw ScriptError(fmt::format("the matrix of {} leaves the range of numbers", quoted(word)),
                        std::string(text_of(word)), "scale and move by less");
    }
    object.to_parent = changed;
  }
}

void Script::add_transform_commands() {
  add("SippObjectGetTransf", "object", 1, 1,
      [this](Words w) { return new_matrix(objects_.at(w[0])->to_parent); });
  add("SippObjectSetTransf", "objectlist matrix", 2, 2, [this](Words w) -> Tcl_Obj* {
    const M44d m = matrix(w[1]);
    transform(w[0], [&](M44d& to_parent) { to_parent = m; });
    return nullptr;
  });
  add("SippObjectClearTransf", "objectlist", 1, 1, [this](Words w) -> Tcl_Obj* {
    transform(w[0], [](M44d& to_parent) { to_parent = M44d(); });
    return nullptr;
  });
  add("SippObjectTransform", "objectlist matrix", 2, 2, [this](Words w) -> Tcl_Obj* {
    const M44d m = matrix(w[1]);
    transform(w[0], [&](M44d& to_parent) { sipp::transform(to_parent, m); });
    return nullptr;
  });
  struct Axis {
    const char *of_object, *of_matrix;
    void (*rotate)(M44d&, double);
  };
  for (const Axis& axis : {Axis{"SippObjectRotateX", "SippMatRotateX", rotate_x},
                           Axis{"SippObjectRotateY", "SippMatRotateY", rotate_y},
                           Axis{"SippObjectRotateZ", "SippMatRotateZ", rotate_z}}) {
    add(axis.of_object, "objectlist angle", 2, 2, [this, axis](Words w) -> Tcl_Obj* {
      const double angle = angle_in_radians(w[1], "the angle", false);
      transform(w[0], [&](M44d& m) { axis.rotate(m, angle); });
      return nullptr;
    });
    add(axis.of_matrix, "matrix angle", 2, 2, [axis](Words w) {
      M44d m = matrix(w[0]);
      axis.rotate(m, angle_in_radians(w[1], "the angle", false));
      return new_matrix(m);
    });
  }
  add("SippObjectRotate", "objectlist point vector angle", 4, 4, [this](Words w) -> Tcl_Obj* {
    const V3d point = vector(w[1], "the point"), axis = direction(w[2], "the vector");
    const double angle = angle_in_radians(w[3], "the angle", false);
    transform(w[0], [&](M44d& m) { rotate(m, point, axis, angle); });
    return nullptr;
  });
  add("SippObjectScale", "objectlist {sx sy sz}|factor", 2, 4, [this](Words w) -> Tcl_Obj* {
    const V3d factors = vector_of_words(w.subspan(1), "the factors", true);
    transform(w[0], [&](M44d& m) { scale(m, factors); });
    return nullptr;
  });
  add("SippObjectMove", "objectlist {dx dy dz}", 2, 4, [this](Words w) -> Tcl_Obj* {
    const V3d by = vector_of_words(w.subspan(1), "the way", false);
    transform(w[0], [&](M44d& m) { translate(m, by); });
    return nullptr;
  });
}

void Script::add_matrix_commands() {
  const auto finished = [](const M44d& m) {
    if (!is_finite(m)) throw ScriptError("the matrix leaves the range of numbers");
    return new_matrix(m);
  };
  add("SippMatTranslate", "matrix {x y z}", 2, 4, [finished](Words w) {
    M44d m = matrix(w[0]);
    translate(m, vector_of_words(w.subspan(1), "the way", false));
    return finished(m);
  });
  add("SippMatScale", "matrix {sx sy sz}|factor", 2, 4, [finished](Words w) {
    M44d m = matrix(w[0]);
    scale(m, vector_of_words(w.subspan(1), "the factors", true));
    return finished(m);
  });
  add("SippMatRotate", "matrix point vector angle", 4, 4, [finished](Words w) {
    M44d m = matrix(w[0]);
    rotate(m, vector(w[1], "the point"), direction(w[2], "the vector"),
           angle_in_radians(w[3], "the angle", false));
    return finished(m);
  });
  add("SippMatMirrorPlane", "matrix point normal", 3, 3, [finished](Words w) {
    M44d m = matrix(w[0]);
    mirror(m, vector(w[1], "the point"), direction(w[2], "the normal"));
    return finished(m);
  });
  add("SippMatMul", "matrix1 matrix2", 2, 2, [finished](Words w) {
    M44d m = matrix(w[0]);
    sipp::transform(m, matrix(w[1]));
    return finished(m);
  });
}

}  // namespace farop::sipp
