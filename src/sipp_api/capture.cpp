// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdlib>
#include <filesystem>

#include "capture_internal.h"
#include "core/diagnostics.h"
#include "core/output_file.h"
#include "export/flat_writer.h"
#include "export/nff_writer.h"
#include "snapshot_internal.h"

namespace farop::sipp_api {
namespace {

enum class CaptureFormat { nff, flat };

/// Where scenes go, and how many have gone there.
struct Capture {
  std::filesystem::path file;  ///< empty: nowhere
  bool draw_too = false;
  int written = 0;
};

std::optional<CaptureFormat> format_of(const std::filesystem::path& file) {
  if (file.extension() == ".nff") return CaptureFormat::nff;
  if (file.extension() == ".scr") return CaptureFormat::flat;
  return std::nullopt;
}

void set_file(Capture& capture, const std::string& file, const char* who) {
  capture.file = file;
  capture.written = 0;
  if (file.empty() || format_of(capture.file)) return;
  message(
      fmt::format("{}: '{}' ends in neither .nff nor .scr: nothing is captured", who, printable(file, 200)));
  capture.file.clear();
}

Capture& the_capture() {
  static Capture* const capture = [] {
    auto* const c = new Capture;
    if (const char* const file = std::getenv("FAROP_CAPTURE")) set_file(*c, file, "FAROP_CAPTURE");
    const char* const draw = std::getenv("FAROP_CAPTURE_DRAW");
    c->draw_too = draw != nullptr && *draw != '\0' && std::string(draw) != "0";
    return c;
  }();
  return *capture;
}

/// scene.nff, scene-2.nff, scene-3.nff ...
std::string numbered(const Capture& capture) {
  if (capture.written == 0) return capture.file.string();
  std::filesystem::path path = capture.file;
  path.replace_filename(fmt::format("{}-{}{}", capture.file.stem().string(), capture.written + 1,
                                    capture.file.extension().string()));
  return path.string();
}

void write_as_nff(const RenderRequest& request, const std::string& file) {
  Scene scene = snapshot({true, false, true});
  scene.view.resolution = {request.width, request.height};
  OutputFile output(file);
  PrintingSink sink;
  NffWriteOptions options;
  options.name = file;
  write_nff(scene, options, output, sink);
  output.commit();
}

void write_as_flat_file(const RenderRequest& request, const std::string& file) {
  const Scene scene = snapshot({true, state().update != nullptr, false});
  Viewport viewport;
  viewport.resolution.x = request.width;
  viewport.resolution.y = request.height;
  GeometryOptions geometry;
  geometry.two_sided = state().show_backfaces;
  geometry.flat = request.mode == FLAT;
  geometry.light_at_eye = false;
  GeometrySetup setup = prepare_geometry(scene, camera_of(scene.view), viewport, geometry);
  shade_frame(scene, setup);
  OutputFile output(file);
  FlatWriter writer(output);
  GeometryClocks clocks;
  run_geometry(scene, setup, geometry, writer, clocks);
  output.commit();
}

}  // namespace

bool capture(const RenderRequest& request) {
  Capture& capture = the_capture();
  if (capture.file.empty()) return false;
  const std::string file = numbered(capture);
  if (format_of(capture.file) == CaptureFormat::nff) {
    write_as_nff(request, file);
  } else {
    write_as_flat_file(request, file);
  }
  ++capture.written;
  return !capture.draw_too;
}

}  // namespace farop::sipp_api

using namespace farop::sipp_api;

Sipp_bool farop_sipp_capture(const char* file) {
  return guarded<Sipp_bool>(FALSE, [&] {
    Capture& capture = the_capture();
    set_file(capture, file != nullptr ? file : "", "farop_sipp_capture");
    return file == nullptr || !capture.file.empty() ? TRUE : FALSE;
  });
}

void farop_sipp_capture_draw(Sipp_bool flag) {
  the_capture().draw_too = flag != 0;
}
