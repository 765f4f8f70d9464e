// SPDX-License-Identifier: GPL-3.0-or-later
#include "stats.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/output_file.h"
#include "scene/bounds.h"
#include "scene/traverse.h"
#include "scene_notes.h"
#include "session.h"
#include "version.h"

namespace farop::app {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const V3d& v) {
  return {v.x, v.y, v.z};
}
Json to_json(const Rgb& c) {
  return {c.r, c.g, c.b};
}
Json number_or_inf(double v) {
  return std::isinf(v) ? Json("inf") : Json(v);
}

const char* name_of(Fit fit) {
  switch (fit) {
    case Fit::vertical:
      return "vertical";
    case Fit::horizontal:
      return "horizontal";
    case Fit::smaller:
      return "smaller";
    case Fit::both:
      break;
  }
  return "both";
}

Json inputs_json(const RunReport& report) {
  Json inputs = Json::array();
  for (const InputSummary& in : report.inputs) {
    inputs.push_back({{"file", printable(in.file, 4096)},
                      {"format", in.format},
                      {"bytes", in.bytes},
                      {"surfaces", in.surfaces},
                      {"polygons", in.polygons},
                      {"patches", in.patches},
                      {"spheres", in.spheres},
                      {"cones", in.cones},
                      {"lights", in.lights}});
  }
  return inputs;
}

Json scene_json(const Scene& scene, const std::optional<StreamedScene>& streamed) {
  const SceneTotals sums = streamed ? streamed->totals : totals(scene);
  Json json{{"objects", sums.objects},
            {"surfaces", sums.surfaces},
            {"vertices", sums.vertices},
            {"lights", scene.lights.size()},
            {"spheres_skipped", scene.spheres_skipped},
            {"cones_skipped", scene.cones_skipped}};
  if (const auto box = streamed ? streamed->bounds : world_bounds(scene))
    json["bounds"] = {to_json(box->low), to_json(box->high)};
  for (const auto& [kind, count] : shader_counts(scene)) json["shaders"][kind] = count;
  json["background"] = to_json(scene.view.background.value_or(Rgb{}));
  json["memory_bytes"] = sums.memory_bytes;
  if (streamed) json["readings"] = streamed->readings;
  return json;
}

Json view_json(const GeometrySetup& setup, const Resolution& r) {
  const Camera& camera = setup.camera;
  const Viewport& viewport = setup.viewport;
  return {{"from", to_json(camera.from)},
          {"at", to_json(camera.at)},
          {"up", to_json(camera.up)},
          {"angle", camera.angle_degrees},
          {"fit", name_of(camera.fit)},
          {"hither", setup.hither},
          {"yon", number_or_inf(setup.yon)},
          {"resolution", {r.x, r.y, r.z, r.color}},
          {"pixel_fit", viewport.pixel_fit == PixelFit::edges ? "edges" : "centres"},
          {"subpixel_bits", viewport.subpixel_bits},
          {"y_down", viewport.y_down}};
}

Json polygons_json(const PolygonCounts& c) {
  return {{"loaded", c.loaded},
          {"back_facing", c.back_facing},
          {"degenerate", c.degenerate},
          {"totally_clipped", c.totally_clipped},
          {"rendered", c.rendered},
          {"partly_clipped", c.partly_clipped},
          {"split_to_triangles", c.split_to_triangles},
          {"triangles", c.triangles}};
}

/// null: the machine does not let us count.
Json to_json(const std::optional<std::uint64_t>& count) {
  return count ? Json(*count) : Json(nullptr);
}
Json to_json(const StageTime& t) {
  return {{"elapsed", t.elapsed},
          {"user", t.user},
          {"system", t.system},
          {"cycles", to_json(t.cycles)},
          {"instructions", to_json(t.instructions)}};
}

void add_timer(Json& timers, const char* name, const StageTimer& timer) {
  if (timer.ran()) timers[name] = to_json(timer.total());
}

Json findings_json(const std::vector<PluginFinding>& findings) {
  Json json = Json::array();
  for (const PluginFinding& finding : findings) {
    json.push_back({{"verdict", finding.verdict}, {"message", finding.message}});
    if (finding.polygon) json.back()["polygon"] = *finding.polygon;
  }
  return json;
}

/// A name for the process (`thread` 0) or one of its tracks.
Json trace_name(int thread, const std::string& name) {
  Json json{{"name", thread == 0 ? "process_name" : "thread_name"}, {"ph", "M"}, {"pid", 1}};
  if (thread != 0) json["tid"] = thread;
  json["args"] = {{"name", name}};
  return json;
}

}  // namespace

void write_stats(const Session& session, ExitStatus status) {
  const RunReport& report = session.report;
  Json json{{"schema", "farop.stats/1"},
            {"version", k_version},
            {"command", report.command},
            {"status", static_cast<int>(status)},
            {"warnings", session.console.warnings()},
            {"inputs", inputs_json(report)}};
  if (report.has_scene) json["scene"] = scene_json(session.scene, report.streamed);
  if (report.setup) json["view"] = view_json(*report.setup, report.picture);
  if (report.geometry) {
    json["polygons"] = polygons_json(report.geometry->counts);
  } else if (report.polygons_loaded) {
    json["polygons"] = {{"loaded", *report.polygons_loaded}};
  }
  if (report.raster) {
    json["raster"] = {{"rasterizer", report.raster->rasterizer},
                      {"mode", report.raster->mode},
                      {"samples", report.raster->samples}};
    if (const auto& calls = report.raster->calls) {
      json["raster"]["calls"] = {{"create", calls->create.elapsed},
                                 {"begin_frame", calls->begin_frame.elapsed},
                                 {"polygon", calls->polygon.elapsed},
                                 {"end_frame", calls->end_frame.elapsed}};
      json["raster"]["call_timers"] = {{"create", to_json(calls->create)},
                                       {"begin_frame", to_json(calls->begin_frame)},
                                       {"polygon", to_json(calls->polygon)},
                                       {"end_frame", to_json(calls->end_frame)}};
      json["raster"]["isolation"] = report.raster->walls;
      json["raster"]["findings"] = findings_json(report.raster->findings);
    }
  }
  Json timers = Json::object();
  add_timer(timers, "parse", session.clocks.parse);
  add_timer(timers, "load", session.clocks.load);
  add_timer(timers, "geometry", session.clocks.drawing.geometry);
  add_timer(timers, report.sink_writes ? "write" : "rasterize", session.clocks.drawing.sink);
  add_timer(timers, "write", session.clocks.write);
  add_timer(timers, "total", session.clocks.total);
  json["timers"] = timers;
  json["memory"] = {{"peak_bytes", peak_memory_bytes()}};
  json["outputs"] = report.outputs;

  OutputFile file(session.options.stats_file);
  file.write(json.dump(2) + "\n");
  file.commit();
}

void write_trace(const Session& session) {
  const auto& slices = session.trace.slices();
  double begin = slices.empty() ? 0 : slices.front().begin;
  for (const TraceLog::Slice& slice : slices) begin = std::min(begin, slice.begin);
  OutputFile file(session.options.trace_file);
  // Line by line: a document of a million events would be held twice.
  file.write("{\"displayTimeUnit\": \"ms\", \"traceEvents\": [\n");
  file.write(trace_name(0, "farop " + session.report.command).dump());
  const auto track = [](TraceTrack t) { return static_cast<int>(t); };
  file.write(",\n" + trace_name(track(TraceTrack::stages), "stages").dump());
  const bool calls = std::any_of(slices.begin(), slices.end(),
                                 [](const auto& s) { return s.track == TraceTrack::rasterizer; });
  if (calls) file.write(",\n" + trace_name(track(TraceTrack::rasterizer), "calls of the rasterizer").dump());
  for (const TraceLog::Slice& slice : slices) {
    const bool writes = session.report.sink_writes && std::string_view(slice.stage) == "rasterize";
    const Json event{{"name", writes ? "write" : slice.stage},
                     {"ph", "X"},
                     {"pid", 1},
                     {"tid", track(slice.track)},
                     {"ts", 1e6 * (slice.begin - begin)},
                     {"dur", 1e6 * (slice.end - slice.begin)}};
    file.write(",\n" + event.dump());
  }
  file.write(fmt::format("\n], \"otherData\": {{\"version\": \"{}\", \"slices_left_out\": {}}}}}\n",
                         k_version, session.trace.left_out()));
  file.commit();
}

}  // namespace farop::app
