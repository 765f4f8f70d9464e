// SPDX-License-Identifier: GPL-3.0-or-later
// A program of somebody else that counts the polygons of a scene.
#include <cstdio>

#include "parse_nff/parse_nff.h"
#include "scene/traverse.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  farop::WordReader reader{std::string(argv[1])};
  farop::DiagnosticList messages;
  const auto scene = farop::parse_nff(reader, messages);
  if (!scene) return 1;
  std::printf("%llu polygons\n", static_cast<unsigned long long>(farop::totals(*scene).polygons));
}
