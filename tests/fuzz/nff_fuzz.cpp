// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes end in a scene or in exactly one error, and what was read survives being written and read again.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "export/nff_writer.h"
#include "parse_nff/parse_nff.h"
#include "scene/tessellate.h"

namespace farop {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "violated: %s\n", what);
  std::abort();
}

std::optional<Scene> parse(std::string_view text) {
  WordReader reader(text, "fuzz.nff");
  DiagnosticList list;
  std::optional<Scene> scene = parse_nff(reader, list);
  require(list.count(Severity::error) == (scene ? 0 : 1), "a scene and no error, or no scene and one");
  require(scene || list.items.back().severity == Severity::error, "the error is the last report");
  for (const Diagnostic& d : list.items) require(!to_text(d).empty(), "every report has a text");
  return scene;
}

std::string write(const Scene& scene) {
  std::string text;
  DiagnosticList list;
  write_nff(
      scene, {}, [&](std::string_view piece) { text += piece; }, list);
  return text;
}

// Takes out what NFF cannot say.
void reduce(Scene& scene) {
  scene.view.yon.reset();
  auto& surfaces = scene.root.children.at(0)->surfaces;
  std::erase_if(surfaces, [](const auto& surface) { return surface->polygons.empty(); });
  for (const auto& surface : surfaces) surface->material.ka = Material{}.ka;
}

}  // namespace
}  // namespace farop

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace farop;
  std::optional<Scene> scene = parse({reinterpret_cast<const char*>(data), size});
  if (!scene) return 0;
  tessellate_scene(*scene, Detail{1, std::nullopt});
  reduce(*scene);
  std::string text;
  try {
    text = write(*scene);
  } catch (const Error&) {
    return 0;  // tessellating a huge sphere may leave the range of a double
  }
  const std::optional<Scene> again = parse(text);
  require(again.has_value(), "what was written can be read");
  require(same_content(*scene, *again), "parse(write(scene)) == scene");
  require(write(*again) == text, "write(parse(text)) == text");
  return 0;
}
