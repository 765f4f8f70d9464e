// SPDX-License-Identifier: GPL-3.0-or-later
// The same scene as a C program and as a script: the same tree, the same picture.
#include "pairs/pairs.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "parse_sipp/parse_sipp.h"
#include "sipp_api/snapshot_internal.h"
#include "support/shell.h"

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

std::string script_of(const Pair& pair) {
  return std::string(FAROP_SIPP_PAIRS) + "/" + pair.name + ".sipp";
}

void forget_names(Object& object) {
  object.name.clear();
  for (const auto& child : object.children) forget_names(*child);
}

/// Equal node by node; says where not.
void expect_same(const Object& a, const Object& b, const std::string& where) {
  EXPECT_EQ(a.to_parent, b.to_parent) << where;
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size()) << where;
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    const farop::Surface& s = *a.surfaces[i];
    const farop::Surface& t = *b.surfaces[i];
    const std::string surface = where + " surface " + std::to_string(i);
    EXPECT_EQ(s.positions, t.positions) << surface;
    EXPECT_EQ(s.textures, t.textures) << surface;
    EXPECT_EQ(s.averaged_normals, t.averaged_normals) << surface;
    EXPECT_EQ(s.polygons, t.polygons) << surface;
    EXPECT_EQ(s.material, t.material) << surface;
    ASSERT_TRUE(s.shader && t.shader) << surface;
    EXPECT_EQ(s.shader->describe(), t.shader->describe()) << surface;
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

TEST(SippPairs, HaveTheSameTree) {
  for (const Pair& pair : k_pairs) {
    pair.build();
    Scene program = sipp_api::snapshot({true, false, true});
    DiagnosticList messages;
    std::optional<Scene> script = parse_sipp(script_of(pair), messages);
    ASSERT_TRUE(script) << pair.name << (messages.items.empty() ? "" : to_text(messages.items.back()));
    forget_names(program.root);
    forget_names(script->root);
    expect_same(program.root, script->root, pair.name);
    EXPECT_EQ(program.lights, script->lights) << pair.name;
    std::map<const Object*, int> in_program, in_script;
    count_places(program.root, in_program);
    count_places(script->root, in_script);
    EXPECT_EQ(in_program.size(), in_script.size()) << pair.name << ": instances are shared alike";
    // The size of the picture, mode and oversampling come with the render call.
    EXPECT_EQ(script->view.resolution, (ViewParameters::Size{200, 150}));
    program.view.resolution = script->view.resolution;
    EXPECT_EQ(program.view, script->view) << pair.name;
    program.drawing.mode = script->drawing.mode;
    program.drawing.samples = script->drawing.samples;
    EXPECT_TRUE(same_content(program, *script)) << pair.name;
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
    const test::Outcome outcome = test::shell(folder, "farop render " + script_of(pair) + " -o " + script);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto pixels = [](const std::string& path) {
      const std::string bytes = test::read_file(path);
      return bytes.size() < 3 * 200 * 150 ? bytes : bytes.substr(bytes.size() - 3 * 200 * 150);
    };
    EXPECT_EQ(pixels(program).size(), 3u * 200 * 150) << pair.name;
    EXPECT_EQ(pixels(program) == pixels(script), true) << pair.name;
  }
}

}  // namespace
}  // namespace farop
