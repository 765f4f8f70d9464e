// SPDX-License-Identifier: GPL-3.0-or-later
// The same scene as a C program and as a script: the same tree, the same picture.
#include "pairs/pairs.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "parse_sipp/parse_sipp.h"
#include "sipp_api/snapshot_internal.h"
#include "support/shell.h"

namespace farop {
namespace {

/// The world of a program that is running, as often as it asked for an image, and what it asked for.
struct Frame {
  Scene scene;
  int width, height, mode, samples;
};
std::vector<Frame>* frames = nullptr;

void take_frame(int width, int height, int mode, int samples) {
  ASSERT_NE(frames, nullptr);
  frames->push_back({sipp_api::snapshot({true, false, true}), width, height, mode, samples});
}

}  // namespace
}  // namespace farop

// What the programs call instead of SIPP's functions (pairs/twin.h).
extern "C" {
SIPP_PUBLIC void twin_render_file(int width, int height, FILE* /*file*/, int mode, int samples) {
  farop::take_frame(width, height, mode, samples);
}
SIPP_PUBLIC void twin_render_func(int width, int height, void (* /*func*/)(), void* /*data*/, int mode,
                                  int samples) {
  farop::take_frame(width, height, mode, samples);
}
}

namespace farop {
namespace {

struct Pair {
  const char* name;
  void (*build)();
  int mode;
};
const Pair k_pairs[] = {{"shapes", build_shapes, PHONG},
                        {"figure", build_figure, GOURAUD},
                        {"shaders", build_shaders, PHONG},
                        {"polygons", build_polygons, FLAT}};

/// Programs of the folder beside that a script can say: all but those with functions of their own (holes,
/// scroll).
const char* const k_programs[] = {"torus",  "cones",   "ellipsoid", "prisms", "chain", "lattice",
                                  "column", "strauss", "planet",    "wood",   "grid",  "walk"};

std::string script_of(const std::string& name) {
  return std::string(FAROP_SIPP_PAIRS) + "/" + name + ".sipp";
}

void forget_names(Object& object) {
  object.name.clear();
  for (const auto& child : object.children) forget_names(*child);
}

/// SIPP asks for a surface's shader when it draws, so the library keeps all texture coordinates; a script's
/// shaders are final, and parse_sipp drops the coordinates that none of them reads. So do we.
void drop_unread_textures(Object& object) {
  for (const auto& surface : object.surfaces) {
    if (!surface->shader->wants_texture()) surface->textures.clear();
  }
  for (const auto& child : object.children) drop_unread_textures(*child);
}

/// Equal node by node; says where not.
void expect_same(const Object& a, const Object& b, const std::string& where) {
  EXPECT_EQ(a.to_parent, b.to_parent) << where;
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size()) << where;
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    const farop::Surface& s = *a.surfaces[i];
    const farop::Surface& t = *b.surfaces[i];
    const std::string surface = where + " surface " + std::to_string(i);
    ASSERT_TRUE(s.shader && t.shader) << surface;
    EXPECT_EQ(s.shader->describe(), t.shader->describe()) << surface;
    EXPECT_EQ(s.material, t.material) << surface;
    EXPECT_EQ(s.positions, t.positions) << surface;
    EXPECT_EQ(s.averaged_normals, t.averaged_normals) << surface;
    EXPECT_EQ(s.textures, t.textures) << surface;
    EXPECT_EQ(s.polygons, t.polygons) << surface;
  }
  ASSERT_EQ(a.children.size(), b.children.size()) << where;
  for (std::size_t i = 0; i < a.children.size(); ++i) {
    expect_same(*a.children[i], *b.children[i], where + "/" + std::to_string(i));
  }
}

/// Which nodes of a tree are the same object in memory.
void count_places(const Object& object, std::map<const Object*, int>& places) {
  ++places[&object];
  for (const auto& child : object.children) count_places(*child, places);
}

void expect_same_scene(Scene& program, Scene& script, const std::string& name) {
  forget_names(program.root);
  forget_names(script.root);
  drop_unread_textures(program.root);
  expect_same(program.root, script.root, name);
  EXPECT_EQ(program.lights, script.lights) << name;
  std::map<const Object*, int> in_program, in_script;
  count_places(program.root, in_program);
  count_places(script.root, in_script);
  EXPECT_EQ(in_program.size(), in_script.size()) << name << ": instances are shared alike";
  EXPECT_EQ(program.drawing.two_sided, script.drawing.two_sided) << name;
  // The size of the picture comes with the render call.
  ASSERT_TRUE(script.view.resolution) << name;
  program.view.resolution = script.view.resolution;
  EXPECT_EQ(program.view, script.view) << name;
  EXPECT_TRUE(same_content(program, script)) << name;
}

std::optional<Scene> read_script(const std::string& name, int rendering = 1) {
  DiagnosticList messages;
  SippOptions options;
  options.capture = rendering;
  std::optional<Scene> scene = parse_sipp(script_of(name), messages, options);
  EXPECT_TRUE(scene) << name << (messages.items.empty() ? "" : to_text(messages.items.back()));
  return scene;
}

TEST(SippPairs, HaveTheSameTree) {
  for (const Pair& pair : k_pairs) {
    pair.build();
    Scene program = sipp_api::snapshot({true, false, true});
    std::optional<Scene> script = read_script(pair.name);
    ASSERT_TRUE(script);
    EXPECT_EQ(script->view.resolution, (ViewParameters::Size{200, 150}));
    expect_same_scene(program, *script, pair.name);
  }
}

TEST(SippPairs, TexturesAreAmongWhatIsCompared) {
  build_shapes();
  Scene scene = sipp_api::snapshot({true, false, true});
  drop_unread_textures(scene.root);
  EXPECT_FALSE(scene.root.children[0]->children[0]->surfaces[0]->textures.empty());
  build_figure();
  scene = sipp_api::snapshot({true, false, true});
  EXPECT_FALSE(scene.root.children[0]->children[0]->surfaces[0]->textures.empty());
  drop_unread_textures(scene.root);
  EXPECT_TRUE(scene.root.children[0]->children[0]->surfaces[0]->textures.empty());
}

/// Runs a program of the folder beside, whose render calls fill the result. Its files go into `folder`.
std::vector<Frame> run_program(const test::TemporaryFolder& folder, const std::string& name) {
  std::vector<Frame> seen;
  void* const library =
      ::dlopen((std::string(FAROP_SIPP_TWINS) + "/" + name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
  EXPECT_NE(library, nullptr) << ::dlerror();
  if (library == nullptr) return seen;
  const auto program = reinterpret_cast<int (*)(int, char**)>(::dlsym(library, "twin_main"));
  std::vector<std::string> words{name, "-s", "96"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  optind = 1;
  frames = &seen;
  program(static_cast<int>(arguments.size()), arguments.data());
  frames = nullptr;
  std::filesystem::current_path(before);
  farop_sipp_capture(nullptr);
  // Not closed: the world still points into it, until the next sipp_init().
  return seen;
}

TEST(SippPairs, ProgramsHaveTheTreesOfTheirScripts) {
  const test::TemporaryFolder folder;
  for (const std::string name : k_programs) {
    std::vector<Frame> program = run_program(folder, name);
    ASSERT_EQ(program.size(), name == "walk" ? 6u : 1u) << name;
    for (std::size_t i = 0; i < program.size(); ++i) {
      std::optional<Scene> script = read_script(name, static_cast<int>(i) + 1);
      ASSERT_TRUE(script);
      expect_same_scene(program[i].scene, *script, name);
      EXPECT_EQ(script->view.resolution, (ViewParameters::Size{program[i].width, program[i].height})) << name;
      EXPECT_EQ(program[i].mode, PHONG) << name;
      EXPECT_EQ(script->drawing.mode, DrawMode::phong) << name;
      EXPECT_EQ(script->drawing.samples, program[i].samples) << name;
    }
  }
}

/// Their colours alone: the headers differ by a comment.
std::string pixels(const std::string& path, std::size_t count) {
  const std::string bytes = test::read_file(path);
  return bytes.size() < 3 * count ? bytes : bytes.substr(bytes.size() - 3 * count);
}

TEST(SippPairs, ProgramsDrawWhatTheirScriptsDraw) {
  const test::TemporaryFolder folder;
  for (const std::string name : k_programs) {
    const bool walks = name == "walk";  // its second image is a scene
    const test::Outcome outcome = test::shell(
        folder, "ASAN_OPTIONS=detect_leaks=0 " FAROP_SIPP_PROGRAMS "/" + name + "_gnu89 -s 96 && " +
                    "farop render -q " + script_of(name) + " -o script.ppm" + (walks ? " --capture 3" : ""));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string program = pixels(folder / (walks ? "walk2.ppm" : name + ".ppm"), 96 * 96);
    EXPECT_EQ(program.size(), 3u * 96 * 96) << name;
    EXPECT_TRUE(program == pixels(folder / "script.ppm", 96 * 96)) << name;
  }
}

TEST(SippPairs, HaveTheSamePicture) {
  test::TemporaryFolder folder;
  for (const Pair& pair : k_pairs) {
    pair.build();
    const std::string program = folder / (std::string(pair.name) + "-c.ppm");
    std::FILE* const file = std::fopen(program.c_str(), "w");
    ASSERT_NE(file, nullptr);
    render_image_file(200, 150, file, pair.mode, 1);
    std::fclose(file);
    const std::string script = folder / (std::string(pair.name) + ".ppm");
    const test::Outcome outcome =
        test::shell(folder, "farop render " + script_of(pair.name) + " -o " + script);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(pixels(program, 200 * 150).size(), 3u * 200 * 150) << pair.name;
    EXPECT_TRUE(pixels(program, 200 * 150) == pixels(script, 200 * 150)) << pair.name;
  }
}

/// What a wrong call says: the call, and what was expected.
TEST(SippMessages, NameTheCallAndWhatWasExpected) {
  sipp_init();
  Surf_desc white = {0.2, 0, 0.5, {1, 1, 1}, {1, 1, 1}};
  const auto said = [](const std::function<bool()>& call) {
    testing::internal::CaptureStderr();
    EXPECT_TRUE(call());
    return testing::internal::GetCapturedStderr();
  };
  ::Shader* const shader = reinterpret_cast<::Shader*>(basic_shader);
  EXPECT_EQ(said([&] { return sipp_torus(1, 0.5, 0, 10, &white, shader, WORLD) == nullptr; }),
            "sipp: sipp_torus(1, 0.5, 0, 10): nothing is made (expected finite radii, resolutions of 1 or "
            "more)\n");
  EXPECT_EQ(said([&] { return sipp_cone(-1, 1, 2, 8, &white, shader, WORLD) == nullptr; }),
            "sipp: sipp_cone(-1, 1, 2, 8): nothing is made (expected finite sizes, radii of 0 or more and "
            "not both 0, a resolution of 1 or more)\n");
  EXPECT_EQ(said([&] { return sipp_cube(1, &white, shader, 9) == nullptr; }),
            "sipp: sipp_cube(1): unknown texture mapping 9 (WORLD, CYLINDRICAL, SPHERICAL or NATURAL)\n");
  EXPECT_NE(said([&] { return sipp_bezier_file(nullptr, 3, &white, shader, WORLD) == nullptr; }), "");
  EXPECT_EQ(said([&] { return lightsource_create(0, 0, 1, 1, 1, 1, SPOT_SOFT) == nullptr; }),
            "sipp: lightsource_create: type 3 (LIGHT_DIRECTION or LIGHT_POINT)\n");
  EXPECT_EQ(
      said([&] { return spotlight_create(0, 0, 1, 0, 0, 0, 9, 1, 1, 1, LIGHT_POINT, FALSE) == nullptr; }),
      "sipp: spotlight_create: type 1 (SPOT_SHARP or SPOT_SOFT)\n");
  // Two surfaces without a shader: said once for each scene that is taken.
  for (int i = 0; i < 2; ++i) object_add_subobj(sipp_world, sipp_sphere(1, 8, &white, nullptr, WORLD));
  EXPECT_EQ(said([] {
              return !sipp_api::snapshot({true, false, true}).root.children.empty();
            }),
            "sipp: a surface without a shader, or whose shader has no description, is drawn white\n");
  sipp_init();
}

}  // namespace
}  // namespace farop
