// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes, run as a script under small limits, end in a scene or in exactly one error. In this process, so
// that every crash is seen; Tcl's own aborts for lack of memory are no finding (the limit of libFuzzer ends
// them).
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "parse_sipp/parse_sipp.h"
#include "scene/traverse.h"

namespace farop {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "violated: %s\n", what);
  std::abort();
}

}  // namespace
}  // namespace farop

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace farop;
  SippOptions options;
  options.limits.seconds = 1;
  options.limits.commands = 20'000;
  options.limits.polygons = 20'000;
  options.limits.nesting = 100;
  DiagnosticList list;
  std::optional<Scene> scene;
  try {
    scene = parse_sipp_unguarded({reinterpret_cast<const char*>(data), size}, "fuzz.sipp", list, options);
  } catch (const Error&) {
    require(false, "errors are reported");
  }
  require(list.count(Severity::error) == (scene ? 0 : 1), "a scene and no error, or no scene and one");
  for (const Diagnostic& d : list.items) require(!to_text(d).empty(), "every report has a text");
  if (!scene) return 0;
  require(scene->root.children.size() == 1, "one object under the root");
  require(totals(*scene).polygons <= options.limits.polygons, "no more polygons than allowed");
  return 0;
}
