// SPDX-License-Identifier: GPL-3.0-or-later
// The world of one script: everything that its commands make, and the scene that is taken of it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/error.h"
#include "parse_sipp/parse_sipp.h"
#include "parse_sipp/script_error_internal.h"
#include "parse_sipp/script_shader.h"
#include "parse_sipp/sipp_shapes.h"
#include "parse_sipp/sipp_surface_builder.h"
#include "parse_sipp/tcl_interpreter.h"
#include "scene/scene.h"

namespace farop::sipp {

/// Things of one type by their handles: prefix and a number that counts from 0.
template <class Thing>
class Handles {
 public:
  /// `noun`: what a handle is, `maker`: which commands return one; both for messages.
  Handles(std::string prefix, std::string noun, std::string maker)
      : prefix_(std::move(prefix)), noun_(std::move(noun)), maker_(std::move(maker)) {}

  std::string add(Thing thing) {
    std::string name = prefix_ + std::to_string(next_++);
    things_.emplace(name, std::move(thing));
    return name;
  }
  void add_named(const std::string& name, Thing thing) { things_.emplace(name, std::move(thing)); }
  /// Throws ScriptError for a handle that is unknown or deleted.
  Thing& at(Tcl_Obj* word) {
    const auto found = things_.find(std::string(text_of(word)));
    if (found == things_.end()) fail(word);
    return found->second;
  }
  bool contains(Tcl_Obj* word) const { return things_.contains(std::string(text_of(word))); }
  /// Takes a thing out; its handle is deleted.
  Thing take(Tcl_Obj* word) {
    at(word);
    return std::move(things_.extract(std::string(text_of(word))).mapped());
  }
  std::map<std::string, Thing>& all() { return things_; }
  void clear() {
    things_.clear();
    next_ = 0;
  }

 private:
  [[noreturn]] void fail(Tcl_Obj* word) const {
    const std::string text(text_of(word));
    bool deleted =
        text.size() > prefix_.size() && text.size() < prefix_.size() + 10 && text.starts_with(prefix_);
    for (std::size_t i = prefix_.size(); i < text.size(); ++i)
      deleted = deleted && text[i] >= '0' && text[i] <= '9';
    if (deleted && std::stoull(text.substr(prefix_.size())) < next_) {
      throw ScriptError(quoted(word) + " has been deleted, expected " + noun_ + " that exists", text);
    }
    unexpected(word, "a handle", noun_ + ", as " + maker_ + " returns it");
  }

  std::string prefix_, noun_, maker_;
  std::map<std::string, Thing> things_;
  std::uint64_t next_ = 0;
};

struct ScriptCamera {
  V3d position{0, 0, 10}, at{0, 0, 0}, up{0, 1, 0};
  double focal = 0.25;
};

class Script {
 public:
  using Words = TclInterpreter::Words;

  Script(TclInterpreter& interpreter, const SippOptions& options, std::string world_name);
  ~Script();

  /// The scene taken by the SippRender that was asked for, or by finish().
  std::optional<Scene>& scene() { return scene_; }
  /// After a run without that: takes the scene at the end of a script that renders nothing. Throws
  /// ScriptError where there are renderings, but too few.
  void finish();
  /// Remarks for the user, in order.
  const std::vector<Diagnostic>& remarks() const { return remarks_; }

 private:
  // One function per family of commands; each registers them.
  void add_surface_commands();
  void add_shader_commands();
  void add_object_commands();
  void add_transform_commands();
  void add_shape_commands();
  void add_bezier_commands();
  void add_light_commands();
  void add_camera_commands();
  void add_render_commands();
  void add_output_commands();
  void add_control_commands();
  void add_matrix_commands();

  using Command = TclInterpreter::Command;
  void add(const char* name, const char* usage, std::size_t fewest, std::size_t most, Command command) {
    interpreter_.add_command(name, usage, fewest, most, std::move(command));
  }

  // Objects and surfaces.
  Tcl_Obj* new_object(std::shared_ptr<Object> object);
  std::shared_ptr<Surface> create_surface(Tcl_Obj* shader);
  void push_polygon(Words words);
  void add_subobjects(Words words);
  void sub_subobjects(Words words);
  Tcl_Obj* ancestor(const std::shared_ptr<Object>& object);
  std::shared_ptr<const ScriptShader> shader(Tcl_Obj* word) { return shaders_.at(word); }
  Tcl_Obj* new_shader(ShaderSpec spec, int depth = 1);
  template <class Pattern>
  void add_pattern_shader(const char* name, const char* usage, Pattern (*make)(Tcl_Obj*, Tcl_Obj*));
  /// Calls `change` for every object of a list and sees that its matrix stays finite.
  void transform(Tcl_Obj* objects, const std::function<void(M44d&)>& change);
  /// Frees what nothing else holds any more; deep trees do not exhaust the stack.
  static void release(std::shared_ptr<Object> object);

  // Limits.
  std::uint64_t polygons_left() const;
  void count_polygons(std::uint64_t polygons);
  void count_objects(std::uint64_t objects);
  ScriptError too_many(const Error& error) const;
  ShapeLook look(Tcl_Obj* shader, Words rest);
  Tcl_Obj* new_shape(const char* noun, const std::shared_ptr<Object>& object);

  // Rendering.
  Tcl_Obj* render(Words words);
  void capture(const ViewParameters::Size& size, const DrawingParameters& drawing, bool sized);
  void check_tree() const;
  void reset();
  void remark(Severity severity, const std::string& message, const std::string& hint);

  TclInterpreter& interpreter_;
  const SippOptions& options_;
  std::string world_name_;
  std::optional<Scene> scene_;
  std::vector<Diagnostic> remarks_;
  int renderings_ = 0;

  Handles<std::shared_ptr<Object>> objects_{"object", "an object", "SippObjectCreate or SippSphere"};
  Handles<std::shared_ptr<Surface>> surfaces_{"surface", "a surface", "SippSurfaceCreate"};
  Handles<std::shared_ptr<const ScriptShader>> shaders_{"shader", "a shader", "SippShaderBasic or its like"};
  Handles<Light> lights_{"light", "a light", "SippLightSourceCreate"};
  std::vector<std::string> light_order_;  ///< handles, in order of creation
  Handles<ScriptCamera> cameras_{"camera", "a camera", "SippCameraCreate"};
  std::string camera_in_use_ = "STDCAMERA";
  struct Output {
    bool pixmap = false;
    std::int64_t width = 0, height = 0;  ///< of the last rendering into it
  };
  Handles<Output> pbm_files_{"pbmfile", "an open file", "SippPBMOpen"},
      rle_files_{"rlefile", "an open file", "SippRLEOpen"},
      pixmaps_{"pixmap", "a pixmap", "SippPixMapCreate"};
  std::shared_ptr<Object> world_;
  std::unordered_map<const Object*, std::weak_ptr<Object>> first_parents_;
  std::unordered_set<const Object*> ever_children_;  ///< only these can be contained in something
  SurfaceBuilder builder_;
  Rgb background_{0, 0, 0};
  bool backfaces_ = false, shadows_ = false;
  int shadow_size_ = 256;
  std::uint64_t polygons_made_ = 0, objects_made_ = 0;
};

/// TclX's helpers that scripts of SIPP's time use, as procedures.
extern const char* const k_tclx_prelude;

}  // namespace farop::sipp
