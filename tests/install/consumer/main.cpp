// SPDX-License-Identifier: GPL-3.0-or-later
// A program of somebody else that counts the polygons of a scene.
#include <cstdio>
#include <optional>
#include <string>

#include "parse_nff/parse_nff.h"
#include "parse_sipp/parse_sipp.h"
#include "parse_sipp/sipp_shapes.h"
#include "scene/traverse.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string file = argv[1];
  farop::DiagnosticList messages;
  std::optional<farop::Scene> scene;
  if (file.ends_with(".sipp")) {
    scene = farop::parse_sipp(file, messages);
  } else {
    farop::WordReader reader{file};
    scene = farop::parse_nff(reader, messages);
  }
  if (!scene) return 1;
  std::printf("%llu polygons\n", static_cast<unsigned long long>(farop::totals(*scene).polygons));
}
