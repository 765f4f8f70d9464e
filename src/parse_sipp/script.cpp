// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/script.h"

#include <fmt/format.h>

#include "parse_sipp/sipp_objects.h"

namespace farop::sipp {
namespace {

/// Some gigabytes of nodes.
constexpr std::uint64_t k_most_objects_made = 20'000'000;

}  // namespace

Script::Script(TclInterpreter& interpreter, const SippOptions& options, std::string world_name)
    : interpreter_(interpreter), options_(options), world_name_(std::move(world_name)) {
  reset();
  interpreter_.run_prelude(k_tclx_prelude);
  add_surface_commands();
  add_shader_commands();
  add_object_commands();
  add_transform_commands();
  add_shape_commands();
  add_bezier_commands();
  add_light_commands();
  add_camera_commands();
  add_render_commands();
  add_output_commands();
  add_control_commands();
  add_matrix_commands();
  add("exit", "?status?", 0, 1, [this](Words) {
    interpreter_.stop();
    return nullptr;
  });
}

Script::~Script() {
  reset();
  release(std::move(world_));
}

void Script::reset() {
  for (auto& [name, object] : objects_.all()) {
    if (object != world_) release(std::move(object));
  }
  objects_.clear();
  if (world_ != nullptr) release(std::move(world_));
  world_ = std::make_shared<Object>();
  world_->name = world_name_;
  objects_.add_named("WORLD", world_);
  surfaces_.clear();
  shaders_.clear();
  lights_.clear();
  light_order_.clear();
  cameras_.clear();
  cameras_.add_named("STDCAMERA", {});
  camera_in_use_ = "STDCAMERA";
  pbm_files_.clear();
  rle_files_.clear();
  pixmaps_.clear();
  first_parents_.clear();
  ever_children_.clear();
  builder_ = SurfaceBuilder();
  background_ = {};
  backfaces_ = shadows_ = false;
  shadow_size_ = 256;
  polygons_made_ = objects_made_ = 0;
}

void Script::release(std::shared_ptr<Object> object) {
  std::vector<std::shared_ptr<Object>> last;
  last.push_back(std::move(object));
  while (!last.empty()) {
    std::shared_ptr<Object> next = std::move(last.back());
    last.pop_back();
    if (next == nullptr || next.use_count() > 1) continue;
    for (auto& child : next->children) last.push_back(std::move(child));
    next->children.clear();
  }
}

std::uint64_t Script::polygons_left() const {
  const std::uint64_t most = options_.limits.polygons;
  return most - std::min(most, polygons_made_);
}

void Script::count_polygons(std::uint64_t polygons) {
  if (polygons > polygons_left()) {
    throw ScriptLimitError(fmt::format("the script makes more than {} polygons", options_.limits.polygons),
                           {}, "--script-polygons N allows more");
  }
  polygons_made_ += polygons;
}

void Script::count_objects(std::uint64_t objects) {
  objects_made_ += std::min(objects, k_most_objects_made + 1);
  if (objects_made_ > k_most_objects_made) {
    throw ScriptLimitError(fmt::format("the script makes more than {} objects", k_most_objects_made), {},
                           "use instances of larger parts");
  }
}

void Script::check_tree() const {
  const TreeSize size = tree_size(*world_);
  if (size.depth > k_max_depth) {
    throw ScriptLimitError(
        fmt::format("the tree below WORLD has {} levels, at most {} are possible", size.depth, k_max_depth),
        {}, "hang sub-objects beside each other rather than below each other");
  }
  if (size.polygons > options_.limits.polygons || size.objects > k_max_copied_objects) {
    const bool polygons = size.polygons > options_.limits.polygons;
    const std::uint64_t count = polygons ? size.polygons : size.objects;
    const std::string found = count >= std::uint64_t{1} << 62 ? "more than 10^18" : fmt::format("{}", count);
    throw ScriptLimitError(
        fmt::format(
            "the tree below WORLD, instances counted as often as they are placed, has {} {}, at most {} "
            "are allowed",
            found, polygons ? "polygons" : "objects",
            polygons ? options_.limits.polygons : k_max_copied_objects),
        {}, polygons ? "--script-polygons N allows more" : "use instances of larger parts");
  }
}

void Script::remark(Severity severity, const std::string& message, const std::string& hint) {
  remarks_.push_back(interpreter_.diagnostic(severity, interpreter_.place(), message, hint));
}

}  // namespace farop::sipp
