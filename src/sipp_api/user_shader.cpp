// SPDX-License-Identifier: GPL-3.0-or-later
#include <dlfcn.h>

#include <array>
#include <utility>

#include "shader_parameters_internal.h"
#include "user_shader_internal.h"

namespace farop::sipp_api {
namespace {

using ShaderFunction = void (*)(Vector*, Vector*, Vector*, Vector*, Lightsource*, void*, Color*, Color*);

/// A function of the program. Eye space in, world space for the function.
class UserShader : public farop::Shader {
 public:
  UserShader(::Shader* function, void* description) : function_(function), description_(description) {}

  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override {
    const auto direction = [&](const V3d& eye) {
      V3d world;
      frame.eye_to_world.multDirMatrix(eye, world);
      return from_vector(world);
    };
    Vector position = from_vector(point.position * frame.eye_to_world);
    Vector normal = direction(point.normal.normalized());
    Vector view_vec = direction(point.to_eye);
    Vector texture = from_vector(point.texture);
    return call(position, normal, texture, view_vec, state().lights);
  }
  bool opaque() const override { return false; }  // nobody knows before it is asked
  bool is_procedural() const override { return true; }

  /// Asks the function at some points what it does without light and under a white light of strength 0.5 from
  /// where the normal points, seen from the side, where no highlight shines: the difference is what the
  /// surface scatters.
  Material approximate(std::vector<std::string>* lost) const override {
    if (lost != nullptr) lost->emplace_back("what shader functions of the program do");
    LightInfo info;
    info.position = V3d(0, 0, 1);
    Lightsource light{{0.5, 0.5, 0.5}, TRUE, LIGHT_DIRECTION, &info, nullptr, nullptr};
    Rgb scattered, own, opacity;
    constexpr int side = 4, count = side * side * side;
    for (int i = 0; i < count; ++i) {
      Vector up{0, 0, 1}, across{1, 0, 0};
      const int column = i % side, row = i / side % side, layer = i / (side * side);
      Vector position{0.37 * column, 0.37 * row, 0.37 * layer};
      Vector texture = position;
      const Shaded dark = call(position, up, texture, across, nullptr);
      const Shaded lit = call(position, up, texture, across, &light);
      scattered += (lit.color + dark.color * -1) * (2.0 / count);
      own += dark.color * (1.0 / count);
      opacity += lit.opacity * (1.0 / count);
    }
    Material m;
    m.color = clamp01(scattered.r + scattered.g + scattered.b > 1e-3 ? scattered : own);
    m.kd = 1;
    m.transmittance = 1 - (opacity.r + opacity.g + opacity.b) / 3;
    return m;
  }
  std::string describe() const override {
    return fmt::format("function {} {}", reinterpret_cast<void*>(function_), description_);
  }

 private:
  Shaded call(Vector& position, Vector& normal, Vector& texture, Vector& view_vec,
              Lightsource* lights) const {
    Color color{0, 0, 0}, opacity{1, 1, 1};
    call_shader(function_, &position, &normal, &texture, &view_vec, lights, description_, &color, &opacity);
    if (state().rendering && state().terminated) throw Terminated{};
    return {clamp01(to_rgb(color)), clamp01(to_rgb(opacity))};
  }

  ::Shader* function_;
  void* description_;
};

/// Counts what another shader does, and stops it.
class InterruptibleShader : public farop::Shader {
 public:
  explicit InterruptibleShader(std::shared_ptr<const farop::Shader> inner) : inner_(std::move(inner)) {}
  Shaded shade(const ShadingPoint& point, const ShadingFrame& frame) const override {
    const Shaded shaded = inner_->shade(point, frame);
    if (worked()) throw Terminated{};
    return shaded;
  }
  bool opaque() const override { return inner_->opaque(); }
  bool invisible() const override { return inner_->invisible(); }
  bool is_procedural() const override { return inner_->is_procedural(); }
  bool wants_texture() const override { return inner_->wants_texture(); }
  Material approximate(std::vector<std::string>* lost) const override { return inner_->approximate(lost); }
  std::string describe() const override { return inner_->describe(); }

 private:
  std::shared_ptr<const farop::Shader> inner_;
};

constexpr int k_deepest_nesting = 100;

std::shared_ptr<const farop::Shader> bound(::Shader* function, void* description, int depth);

template <class OurShader, class Description>
std::shared_ptr<const farop::Shader> plain(void* description, int /*depth*/) {
  return std::make_shared<OurShader>(parameters_of(*static_cast<const Description*>(description)));
}

template <class OurShader, class Description>
std::shared_ptr<const farop::Shader> patterned(void* description, int /*depth*/) {
  const auto& d = *static_cast<const Description*>(description);
  return std::make_shared<OurShader>(finish_of(d), pattern_of(d));
}

std::shared_ptr<const farop::Shader> bumpy(void* description, int depth) {
  const auto& d = *static_cast<const Bumpy_desc*>(description);
  auto inner = bound(d.shader, d.surface, depth + 1);
  return inner ? std::make_shared<BumpyShader>(std::move(inner), bumps_of(d)) : nullptr;
}

std::shared_ptr<const farop::Shader> masked(void* description, int depth) {
  const auto* const d = static_cast<const Mask_desc*>(description);
  auto where_set = bound(d->t_shader, d->t_surface, depth + 1);
  auto elsewhere = bound(d->f_shader, d->f_surface, depth + 1);
  if (!where_set || !elsewhere || d->masker == nullptr) return nullptr;
  return std::make_shared<MaskShader>(
      std::move(where_set), std::move(elsewhere),
      [d](const V3d& texture) {
        Vector v = from_vector(texture);
        return ask_masker(*d, &v);
      },
      fmt::format("{} {}", reinterpret_cast<void*>(d->masker), d->mask_data));
}

struct KnownShader {
  const char* name;
  void* function;
  std::shared_ptr<const farop::Shader> (*bind)(void* description, int depth);
};

const std::array<KnownShader, 10>& known_shaders() {
  static const std::array<KnownShader, 10> known = {
      {{"basic_shader", reinterpret_cast<void*>(&basic_shader), plain<BasicShader, Surf_desc>},
       {"phong_shader", reinterpret_cast<void*>(&phong_shader), plain<PhongShader, Phong_desc>},
       {"strauss_shader", reinterpret_cast<void*>(&strauss_shader), plain<StraussShader, Strauss_desc>},
       {"marble_shader", reinterpret_cast<void*>(&marble_shader), patterned<MarbleShader, Marble_desc>},
       {"granite_shader", reinterpret_cast<void*>(&granite_shader), patterned<GraniteShader, Granite_desc>},
       {"bozo_shader", reinterpret_cast<void*>(&bozo_shader), patterned<BozoShader, Bozo_desc>},
       {"wood_shader", reinterpret_cast<void*>(&wood_shader), patterned<WoodShader, Wood_desc>},
       {"planet_shader", reinterpret_cast<void*>(&planet_shader), patterned<PlanetShader, Surf_desc>},
       {"bumpy_shader", reinterpret_cast<void*>(&bumpy_shader), bumpy},
       {"mask_shader", reinterpret_cast<void*>(&mask_shader), masked}}};
  return known;
}

bool is_function(const KnownShader& known, ::Shader* function) {
  void* const address = reinterpret_cast<void*>(function);
  if (address == known.function) return true;
  // A program that is no position-independent executable sees our functions at addresses of its own.
  return address == ::dlsym(RTLD_DEFAULT, known.name);
}

std::shared_ptr<const farop::Shader> bound(::Shader* function, void* description, int depth) {
  if (function == nullptr) return nullptr;
  if (depth > k_deepest_nesting) {
    throw Error(ExitStatus::input, "bumpy or mask shaders contain each other more than 100 levels deep");
  }
  for (const KnownShader& known : known_shaders()) {
    if (is_function(known, function))
      return description != nullptr ? known.bind(description, depth) : nullptr;
  }
  return std::make_shared<UserShader>(function, description);
}

}  // namespace

void call_shader(::Shader* function, Vector* position, Vector* normal, Vector* texture, Vector* view_vec,
                 Lightsource* lights, void* description, Color* color, Color* opacity) {
  if (function == nullptr) return;
  reinterpret_cast<ShaderFunction>(function)(position, normal, texture, view_vec, lights, description, color,
                                             opacity);
}

bool ask_masker(const Mask_desc& description, Vector* texture) {
  if (description.masker == nullptr) return false;
  using Masker = Sipp_bool (*)(void*, Vector*);
  return reinterpret_cast<Masker>(reinterpret_cast<void*>(description.masker))(description.mask_data,
                                                                               texture) != 0;
}

std::shared_ptr<const farop::Shader> bound_shader(::Shader* function, void* description, bool interruptible) {
  auto shader = bound(function, description, 0);
  if (shader && interruptible) shader = std::make_shared<InterruptibleShader>(std::move(shader));
  return shader;
}

}  // namespace farop::sipp_api
