// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons, surfaces and shaders.
#include <fmt/format.h>

#include <algorithm>

#include "core/limits.h"
#include "parse_sipp/script.h"

namespace farop::sipp {
namespace {

constexpr int k_deepest_shader = 100;  // shaders inside shaders; each level is a call per point
constexpr std::int64_t k_largest_exponent = 1'000'000;

double share(Tcl_Obj* word, std::string_view what) {
  const double value = number(word, what);
  if (value < 0) unexpected(word, what, "a number >= 0");
  return value;
}

double unit_share(Tcl_Obj* word, std::string_view what) {
  const double value = number(word, what);
  if (value < 0 || value > 1) unexpected(word, what, "a number 0..1");
  return value;
}

/// ambient specular c3 [opacity]
PatternFinish pattern_finish(std::span<Tcl_Obj* const> three, Tcl_Obj* opacity_word) {
  PatternFinish f;
  f.ambient = share(three[0], "ambient");
  f.specular = share(three[1], "specular");
  f.c3 = share(three[2], "c3");
  if (opacity_word != nullptr) f.opacity = opacity(opacity_word);
  return f;
}

Tcl_Obj* word_at(std::span<Tcl_Obj* const> words, std::size_t i) {
  return i < words.size() && !is_empty(words[i]) ? words[i] : nullptr;
}

}  // namespace

void Script::push_polygon(Words words) {
  bool with_normal = false, with_texture = false, clockwise = false;
  for (; words.size() > 1; words = words.subspan(1)) {
    if (is_word(words[0], "-norm")) {
      with_normal = true;
    } else if (is_word(words[0], "-nonorm")) {
      with_normal = false;
    } else if (is_word(words[0], "-tex")) {
      with_texture = true;
    } else if (is_word(words[0], "-notex")) {
      with_texture = false;
    } else if (is_word(words[0], "-clock")) {
      clockwise = true;
    } else if (is_word(words[0], "-counter")) {
      clockwise = false;
    } else {
      unexpected(words[0], "a flag", "-norm, -nonorm, -tex, -notex, -clock or -counter");
    }
  }
  const std::vector<Tcl_Obj*> corners = list(words[0], "the list of vertices");
  if (corners.empty()) return;
  if (corners.size() < 3 || corners.size() > static_cast<std::size_t>(k_max_polygon_vertices)) {
    throw ScriptError(fmt::format("a polygon of {} vertices found, expected at least 3", corners.size()));
  }
  const std::size_t parts = 1u + (with_normal ? 1u : 0u) + (with_texture ? 1u : 0u);
  std::vector<Vertex> vertices(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Vertex& v = vertices[i];
    if (parts == 1) {
      v.position = vector(corners[i], "a vertex");
      continue;
    }
    const std::vector<Tcl_Obj*> part = list_of(corners[i], "a vertex", parts,
                                               !with_texture  ? "{{x y z} {nx ny nz}}"
                                               : !with_normal ? "{{x y z} {u v w}}"
                                                              : "{{x y z} {nx ny nz} {u v w}}");
    v.position = vector(part[0], "a vertex");
    if (with_normal) v.normal = vector(part[1], "a normal");
    if (with_texture) v.texture = vector(part.back(), "texture coordinates");
  }
  count_polygons(1);
  if (clockwise) std::reverse(vertices.begin(), vertices.end());
  for (const Vertex& v : vertices) builder_.push_vertex(v);
  builder_.push_polygon();
}

std::shared_ptr<Surface> Script::create_surface(Tcl_Obj* shader_word) {
  const auto bound = shader(shader_word);
  auto surface = builder_.create(bound);
  if (surface == nullptr) {
    throw ScriptError("no polygons to make a surface of", {}, "push some with SippPolygonPush before");
  }
  return surface;
}

void Script::add_surface_commands() {
  add("SippPolygonPush", "?-norm|-nonorm? ?-tex|-notex? ?-clock|-counter? vertexlist", 1, 7,
      [this](Words w) -> Tcl_Obj* {
        push_polygon(w);
        return nullptr;
      });
  add("SippPolygonClear", "", 0, 0, [this](Words) -> Tcl_Obj* {
    builder_.clear();
    return nullptr;
  });
  add("SippSurfaceCreate", "shader", 1, 1,
      [this](Words w) { return new_text(surfaces_.add(create_surface(w[0]))); });
  add("SippSurfaceUnref", "surfacelist|ALL", 1, 1, [this](Words w) -> Tcl_Obj* {
    if (is_word(w[0], "ALL")) {
      surfaces_.all().clear();
    } else {
      for (Tcl_Obj* word : list(w[0], "a list of surfaces")) surfaces_.take(word);
    }
    return nullptr;
  });
  add("SippSurfaceSetShader", "surfacelist shader", 2, 2, [this](Words w) -> Tcl_Obj* {
    const auto bound = shader(w[1]);
    for (Tcl_Obj* word : list(w[0], "a list of surfaces")) surfaces_.at(word)->shader = bound;
    return nullptr;
  });
}

Tcl_Obj* Script::new_shader(ShaderSpec spec, int depth) {
  return new_text(shaders_.add(std::make_shared<ScriptShader>(std::move(spec), depth)));
}

template <class Pattern>
void Script::add_pattern_shader(const char* name, const char* usage, Pattern (*make)(Tcl_Obj*, Tcl_Obj*)) {
  add(name, usage, 6, 7, [this, make](Words w) {
    PatternSpec<Pattern> spec{pattern_finish(w.first(3), word_at(w, 6)), make(w[4], w[5])};
    spec.pattern.scale = number(w[3], "scale");
    return new_shader(std::move(spec));
  });
}

void Script::add_shader_commands() {
  add("SippShaderBasic", "ambient specular c3 color ?opacity?", 4, 5, [this](Words w) {
    return new_shader(pattern_finish(w.first(3), word_at(w, 4)).with(color(w[3], "color")));
  });
  add("SippShaderPhong", "ambient diffuse specular spec_exp color ?opacity?", 5, 6, [this](Words w) {
    PhongParameters p;
    p.ambient = share(w[0], "ambient");
    p.diffuse = share(w[1], "diffuse");
    p.specular = share(w[2], "specular");
    p.spec_exp = static_cast<int>(integer(w[3], "spec_exp", 0, k_largest_exponent));
    p.color = color(w[4], "color");
    if (Tcl_Obj* word = word_at(w, 5)) p.opacity = opacity(word);
    return new_shader(p);
  });
  add("SippShaderStrauss", "ambient smoothness metalness color ?opacity?", 4, 5, [this](Words w) {
    StraussParameters p;
    p.ambient = share(w[0], "ambient");
    p.smoothness = unit_share(w[1], "smoothness");
    p.metalness = unit_share(w[2], "metalness");
    p.color = color(w[3], "color");
    if (Tcl_Obj* word = word_at(w, 4)) p.opacity = opacity(word);
    return new_shader(p);
  });
  add_pattern_shader<WoodPattern>("SippShaderWood", "ambient specular c3 scale basecolor ringcolor ?opacity?",
                                  [](Tcl_Obj* a, Tcl_Obj* b) {
                                    return WoodPattern{1, color(a, "basecolor"), color(b, "ringcolor")};
                                  });
  add_pattern_shader<MarblePattern>("SippShaderMarble",
                                    "ambient specular c3 scale basecolor stripcolor ?opacity?",
                                    [](Tcl_Obj* a, Tcl_Obj* b) {
                                      return MarblePattern{1, color(a, "basecolor"), color(b, "stripcolor")};
                                    });
  add_pattern_shader<GranitePattern>("SippShaderGranite", "ambient specular c3 scale color1 color2 ?opacity?",
                                     [](Tcl_Obj* a, Tcl_Obj* b) {
                                       return GranitePattern{1, color(a, "color1"), color(b, "color2")};
                                     });
  add("SippShaderBozo", "colorlist ambient specular c3 scale ?opacity?", 5, 6, [this](Words w) {
    // The manuals disagree on where the colours stand; a list of lists is nothing but them.
    const auto is_colors = [](Tcl_Obj* word) {
      int count = 0;
      Tcl_Obj* first = nullptr;
      return Tcl_ListObjIndex(nullptr, word, 0, &first) == TCL_OK && first != nullptr &&
             Tcl_ListObjLength(nullptr, first, &count) == TCL_OK && count == 3;
    };
    const bool colors_first = is_colors(w[0]);
    if (!colors_first && !is_colors(w[4]))
      unexpected(w[0], "the colours", "a list of lists {red green blue}");
    PatternSpec<BozoPattern> spec;
    const Words numbers = w.subspan(colors_first ? 1 : 0, 4);
    spec.finish = pattern_finish(numbers.first(3), word_at(w, 5));
    spec.pattern.scale = number(numbers[3], "scale");
    for (Tcl_Obj* word : list(w[colors_first ? 0 : 4], "the colours")) {
      spec.pattern.colors.push_back(color(word, "a colour"));
    }
    return new_shader(std::move(spec));
  });
  add("SippShaderBumpy", "shader scale ?BUMPS? ?HOLES?", 2, 4, [this](Words w) {
    BumpySpec spec{shader(w[0]), {}};
    spec.parameters.scale = number(w[1], "scale");
    spec.parameters.bumps = spec.parameters.holes = w.size() == 2;
    for (Tcl_Obj* word : w.subspan(2)) {
      if (is_word(word, "BUMPS")) {
        spec.parameters.bumps = true;
      } else if (is_word(word, "HOLES")) {
        spec.parameters.holes = true;
      } else {
        unexpected(word, "a keyword", "BUMPS or HOLES");
      }
    }
    const int depth = spec.inner->depth() + 1;
    if (depth > k_deepest_shader) {
      throw ScriptError(fmt::format("shaders inside each other more than {} levels deep", k_deepest_shader));
    }
    return new_shader(std::move(spec), depth);
  });
  add("SippShaderPlanet", "ambient specular c3 ?opacity?", 3, 4, [this](Words w) {
    return new_shader(PatternSpec<PlanetPattern>{pattern_finish(w.first(3), word_at(w, 3)), {}});
  });
  add("SippShaderUnref", "shaderlist|ALL", 1, 1, [this](Words w) -> Tcl_Obj* {
    if (is_word(w[0], "ALL")) {
      shaders_.all().clear();
    } else {
      for (Tcl_Obj* word : list(w[0], "a list of shaders")) shaders_.take(word);
    }
    return nullptr;
  });
}

}  // namespace farop::sipp
