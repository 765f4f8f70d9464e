// SPDX-License-Identifier: GPL-3.0-or-later
// What the functions of the C library share: its state, and how they end.
//
// Nothing that is thrown leaves the library: programs in C have no way to catch it.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.h"
#include "core/error.h"
#include "core/math.h"
#include "parse_sipp/sipp_surface_builder.h"
#include "scene/scene.h"
#include "shading/light.h"
#include "shading/noise.h"

// Behind the C++ headers: its macros have names like LINE and FLAT.
#include "primitives.h"
#include "shaders.h"

/// SIPP's Surface: geometry, and what will shade and deform it once something is rendered.
struct SippSurface {
  std::shared_ptr<farop::Surface> geometry;
  std::vector<bool> own_normals;  ///< per vertex: its normal was given; empty: none was
  Shader* shader = nullptr;
  void* description = nullptr;
  Surf_desc_hdr* header = nullptr;             ///< before `description`, where there is one
  std::shared_ptr<Surf_desc> own_description;  ///< what surface_basic_create() allocates
  FFD_func* ffd = nullptr;
  void* ffd_data = nullptr;
  Surf_desc_hdr* ffd_header = nullptr;
  int ref_count = 0;
};

namespace farop::sipp_api {

/// Prints "sipp: ..." to stderr.
void message(const std::string& text);
[[noreturn]] void out_of_memory();

/// What a stage has to say goes to stderr.
class PrintingSink : public DiagnosticSink {
 public:
  void report(Diagnostic diagnostic) override { std::fputs(to_text(diagnostic).c_str(), stderr); }
};

/// Runs `work`; a failure is printed and gives `fallback`.
template <class Result, class Work>
Result guarded(Result fallback, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    out_of_memory();
  } catch (const Error& error) {
    message(error.hint().empty() ? std::string(error.what())
                                 : fmt::format("{} ({})", error.what(), error.hint()));
  } catch (const std::exception& error) {
    message(error.what());
  }
  return fallback;
}
template <class Work>
void guarded(Work&& work) {
  guarded(0, [&] {
    std::forward<Work>(work)();
    return 0;
  });
}

/// Lightsource::info.
struct LightInfo {
  V3d position{0, 0, 0};  ///< of directional ones: unit vector towards the light
  V3d target{0, 0, 0};
  double opening_degrees = 0;
  bool casts_shadows = false;
  std::shared_ptr<const LightShadow> shadow;  ///< world space; for the frame, or from shadowmaps_create()
};

struct State {
  sipp::SurfaceBuilder builder;
  bool initialized = false;

  bool show_backfaces = false;
  bool bottom_to_top = false;
  Rgb background;
  Update_func* update = nullptr;
  void* update_data = nullptr;
  int update_period = 0;

  bool shadows = false;
  int shadow_size = 256;
  bool lasting_shadows = false;  ///< shadowmaps_create() made maps

  bool user_refcount = false;
  bool surface_headers = false;
  bool ffd_headers = false;

  Lightsource* lights = nullptr;  ///< newest first
  ::Camera standard_camera{};
  std::shared_ptr<const NoiseTable> noise;

  // While something is rendered.
  bool rendering = false;
  bool terminated = false;
  std::int64_t work = 0;  ///< units since the last call of the update function
  Lightsource* frame_lights = nullptr;
  std::vector<LightSource> world_lights;  ///< of frame_lights
};
State& state();

/// Thrown through our own stages when the program has asked to give up.
struct Terminated {};
/// Counts a unit of work; calls the update function when it is time. True when rendering shall end.
bool worked();

/// The generator of noise and shadows is the program's drand48().
double next_random();
const std::shared_ptr<const NoiseTable>& noise_table();

inline V3d to_vector(const Vector& v) {
  return {v.x, v.y, v.z};
}
inline Vector from_vector(const V3d& v) {
  return {v.x, v.y, v.z};
}
inline Rgb to_rgb(const Color& c) {
  return {c.red, c.grn, c.blu};
}
inline Color from_rgb(const Rgb& c) {
  return {c.r, c.g, c.b};
}
M44d to_matrix(const Transf_mat& m);
Transf_mat from_matrix(const M44d& m);

/// Lights of a list as shaders meet them, in world space; inactive ones are left out. Valid until the next
/// call.
std::span<const LightSource> world_lights(const Lightsource* list);
/// A light as the scene has it.
Light scene_light(const Lightsource& light);
LightInfo& info_of(const Lightsource& light);

/// A surface around `geometry`, with a reference to the description's header where descriptions have any.
::Surface* new_surface(std::shared_ptr<farop::Surface> geometry, void* description, ::Shader* shader);
::Object* new_object();
void append_surface(::Object& object, ::Surface& surface);
void append_sub_object(::Object& object, ::Object& sub_object);

}  // namespace farop::sipp_api
