// SPDX-License-Identifier: GPL-3.0-or-later
// Lights and cameras.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "parse_sipp/script.h"

namespace farop::sipp {
namespace {

constexpr std::int64_t k_largest_shadow_map = 1 << 16;

V3d direction_to_light(Tcl_Obj* word) {
  const V3d v = vector(word, "the direction");
  // Scaled first, so that no length over- or underflows.
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0) unexpected(word, "the direction", "a vector other than 0 0 0");
  return (v / largest).normalized();
}

double opening(Tcl_Obj* word) {
  const double degrees = angle_in_radians(word, "the opening", true) * (180 / std::acos(-1.0));
  if (degrees <= 0 || degrees > 360)
    unexpected(word, "the opening", "an angle of more than 0 up to 360 degrees");
  return degrees;
}

bool is_spot(const Light& light) {
  return light.kind == LightKind::spot_sharp || light.kind == LightKind::spot_soft;
}

double focal_ratio(Tcl_Obj* word) {
  const double focal = number(word, "the focal ratio");
  if (focal < 1e-9 || focal > 1e6)
    unexpected(word, "the focal ratio", "a number > 0 (tangent of half the angle)");
  return focal;
}

/// [position] [point] [upvector] [focal]: empty and missing ones change nothing.
void set_camera(ScriptCamera& camera, std::span<Tcl_Obj* const> words) {
  const auto given = [&](std::size_t i) { return i < words.size() && !is_empty(words[i]); };
  ScriptCamera changed = camera;
  if (given(0)) changed.position = vector(words[0], "the position");
  if (given(1)) changed.at = vector(words[1], "the point looked at");
  if (given(2)) changed.up = vector(words[2], "the up vector");
  if (given(3)) changed.focal = focal_ratio(words[3]);
  camera = changed;
}

}  // namespace

void Script::add_light_commands() {
  const auto new_light = [this](const Light& light) {
    light_order_.push_back(lights_.add(light));
    return new_text(light_order_.back());
  };
  add("SippLightSourceCreate", "{x y z} color ?DIRECTION|POINT?", 2, 3, [new_light](Words w) {
    Light light;
    const bool point = w.size() > 2 && is_word(w[2], "POINT");
    if (w.size() > 2 && !point && !is_word(w[2], "DIRECTION") && !is_word(w[2], "DIRECTIONAL")) {
      unexpected(w[2], "the kind of light", "DIRECTION or POINT");
    }
    light.kind = point ? LightKind::point : LightKind::directional;
    light.position = point ? vector(w[0], "the position") : direction_to_light(w[0]);
    light.color = color(w[1], "the colour");
    return new_light(light);
  });
  add("SippSpotLightCreate", "position point opening color SHARP|SOFT ?shadow?", 5, 6, [new_light](Words w) {
    Light light;
    light.position = vector(w[0], "the position");
    light.target = vector(w[1], "the point");
    light.opening_degrees = opening(w[2]);
    light.color = color(w[3], "the colour");
    if (!is_word(w[4], "SHARP") && !is_word(w[4], "SOFT"))
      unexpected(w[4], "the kind of spot", "SHARP or SOFT");
    light.kind = is_word(w[4], "SHARP") ? LightKind::spot_sharp : LightKind::spot_soft;
    if (light.target == light.position)
      unexpected(w[1], "the point", "another place than the light's position");
    light.casts_shadows = w.size() > 5 && boolean(w[5], "the shadow flag");
    return new_light(light);
  });
  add("SippLightDestruct", "lightlist|ALL", 1, 1, [this](Words w) -> Tcl_Obj* {
    if (is_word(w[0], "ALL")) {
      lights_.all().clear();
      light_order_.clear();
      return nullptr;
    }
    for (Tcl_Obj* word : list(w[0], "a list of lights")) {
      lights_.take(word);
      std::erase(light_order_, text_of(word));
    }
    return nullptr;
  });
  add("SippLightSourcePut", "light {x y z}", 2, 2, [this](Words w) -> Tcl_Obj* {
    Light& light = lights_.at(w[0]);  // of spots nothing changes
    if (light.kind == LightKind::point) light.position = vector(w[1], "the position");
    if (light.kind == LightKind::directional) light.position = direction_to_light(w[1]);
    return nullptr;
  });
  const auto spot = [this](const char* name, const char* usage, void (*change)(Light&, Tcl_Obj*)) {
    add(name, usage, 2, 2, [this, change](Words w) -> Tcl_Obj* {
      Light& light = lights_.at(w[0]);
      if (is_spot(light)) change(light, w[1]);  // others are left alone
      return nullptr;
    });
  };
  spot("SippSpotLightPos", "light {x y z}",
       [](Light& light, Tcl_Obj* word) { light.position = vector(word, "the position"); });
  spot("SippSpotLightAt", "light {x y z}",
       [](Light& light, Tcl_Obj* word) { light.target = vector(word, "the point"); });
  spot("SippSpotLightOpening", "light angle",
       [](Light& light, Tcl_Obj* word) { light.opening_degrees = opening(word); });
  spot("SippSpotLightShadows", "light flag",
       [](Light& light, Tcl_Obj* word) { light.casts_shadows = boolean(word, "the flag"); });
  add("SippLightColor", "light color", 2, 2, [this](Words w) -> Tcl_Obj* {
    lights_.at(w[0]).color = color(w[1], "the colour");
    return nullptr;
  });
  add("SippLightActive", "light flag", 2, 2, [this](Words w) -> Tcl_Obj* {
    lights_.at(w[0]).active = boolean(w[1], "the flag");
    return nullptr;
  });
  add("SippShadows", "flag ?size?", 1, 2, [this](Words w) -> Tcl_Obj* {
    shadows_ = boolean(w[0], "the flag");
    const std::int64_t size = w.size() > 1 ? integer(w[1], "the size", 0, k_largest_shadow_map) : 0;
    shadow_size_ = size == 0 ? 256 : static_cast<int>(size);
    return nullptr;
  });
}

void Script::add_camera_commands() {
  add("SippCameraCreate", "?position? ?point? ?upvector? ?focal?", 0, 4, [this](Words w) {
    ScriptCamera camera;
    set_camera(camera, w);
    return new_text(cameras_.add(camera));
  });
  add("SippCameraDestruct", "cameralist|ALL", 1, 1, [this](Words w) -> Tcl_Obj* {
    if (is_word(w[0], "ALL")) {
      const ScriptCamera standard = cameras_.all().at("STDCAMERA");
      cameras_.all().clear();
      cameras_.add_named("STDCAMERA", standard);
    } else {
      for (Tcl_Obj* word : list(w[0], "a list of cameras")) {
        if (text_of(word) != "STDCAMERA") cameras_.take(word);
      }
    }
    if (!cameras_.all().contains(camera_in_use_)) camera_in_use_ = "STDCAMERA";
    return nullptr;
  });
  add("SippCameraParams", "camera ?position? ?point? ?upvector? ?focal?", 1, 5, [this](Words w) -> Tcl_Obj* {
    set_camera(cameras_.at(w[0]), w.subspan(1));
    return nullptr;
  });
  add("SippCameraUse", "camera", 1, 1, [this](Words w) -> Tcl_Obj* {
    cameras_.at(w[0]);
    camera_in_use_ = text_of(w[0]);
    return nullptr;
  });
}

}  // namespace farop::sipp
