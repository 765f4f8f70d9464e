// SPDX-License-Identifier: GPL-3.0-or-later
// A scene that goes by in parts, however small they are, gives the flat file of the scene in memory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "export/flat_writer.h"
#include "spd/spd.h"
#include "streaming.h"
#include "support/shell.h"

namespace farop::app {
namespace {

using test::TemporaryFolder;

struct Case {
  std::string name;
  ViewOptions view;
  SceneOptions scene;
  bool flat = false;
};

struct Exported {
  std::string bytes;
  PolygonCounts counts;
  std::vector<std::uint64_t> degenerate;
  double yon = 0;
  std::string said;
  int readings = 0;
};

void write_scene(const TemporaryFolder& folder, const std::string& file, const SpdRequest& request) {
  std::string text;
  write_spd(request, [&](std::string_view block) { text += block; });
  test::write_file(folder / file, text);
}

/// part_bytes 0: with the scene in memory.
Exported export_scene(const TemporaryFolder& folder, const std::vector<std::string>& files, const Case& how,
                      std::size_t part_bytes, int threads = 1) {
  Session session;
  ReportOptions report;
  report.no_progress = true, report.color = "never";
  session.console.configure(report);
  InputOptions input;
  for (const std::string& file : files) input.files.push_back((folder / file).string());
  input.part_bytes = part_bytes;
  input.threads = threads;
  const std::string out = (folder / "out.scr").string();
  testing::internal::CaptureStderr();
  std::optional<StreamedDrawing> streamed;
  if (part_bytes > 0) {
    streamed.emplace(session, input, how.view, how.scene, Viewport{});
  } else {
    load_inputs(session, input);
  }
  const LoadedView view = streamed ? streamed->finish_loading()
                                   : *finish_loading(session, how.view, how.scene, Viewport{}, 1, true);
  const GeometryOptions options = geometry_options(session, how.scene, how.flat);
  prepare_drawing(session, view, options, 1);
  {
    OutputFile file(out);
    FlatWriter writer(file);
    streamed ? streamed->draw(options, writer) : draw(session, options, writer);
    file.commit();
  }
  Exported done;
  done.said = testing::internal::GetCapturedStderr();
  done.said = done.said.substr(0, done.said.find("farop: note: streamed"));
  done.bytes = test::read_file(out);
  done.counts = session.report.geometry->counts;
  done.degenerate = session.report.geometry->degenerate_of_input;
  done.yon = session.report.setup->yon;
  if (streamed) done.readings = session.report.streamed->readings;
  return done;
}

std::vector<Case> cases() {
  std::vector<Case> all(11);
  all[0].name = "plain";
  all[1].name = "yon inf", all[1].view.yon = "inf";
  all[2].name = "yon 15", all[2].view.yon = "15";
  all[3].name = "triangles", all[3].scene.triangles = true;
  all[4].name = "two-sided", all[4].scene.two_sided = true;
  all[5].name = "flat", all[5].flat = true;
  all[6].name = "face normals, unit lights", all[6].scene.normals = "face";
  all[6].scene.light_intensity = "unit";
  all[7].name = "detail 2", all[7].scene.detail = "2";
  all[8].name = "detail 0", all[8].scene.detail = "0";
  all[9].name = "another view", all[9].view.from = {3, 2, 1}, all[9].view.at = {0, 0, 0};
  all[9].view.angle = 70, all[9].view.hither = 0.5, all[9].view.resolution = "300,200,4096,128";
  all[9].view.fit = "smaller", all[9].view.y_down = true;
  all[10].name = "sub-pixel bits", all[10].view.subpixel_bits = 4, all[10].view.pixel_fit = "edges";
  return all;
}

void expect_same(const Exported& streamed, const Exported& in_memory) {
  EXPECT_TRUE(streamed.bytes == in_memory.bytes);
  EXPECT_EQ(streamed.counts, in_memory.counts);
  EXPECT_EQ(streamed.degenerate, in_memory.degenerate);
  EXPECT_EQ(streamed.yon, in_memory.yon);
  EXPECT_EQ(streamed.said, in_memory.said);
}

TEST(Streaming, GivesTheSameFlatFileOfManyScenesAndOptions) {
  const std::tuple<const char*, int, bool> scenes[] = {
      {"gears", 1, false},  {"mount", 3, false},   {"mount", 3, true},    {"balls", 2, false},
      {"balls", 1, true},   {"tetra", 4, false},   {"jacks", 1, false},   {"rings", 1, false},
      {"tree", 4, false},   {"lattice", 1, false}, {"nurbtst", 1, false}, {"shells", 1, true},
      {"teapot", 1, false}, {"sombrero", 1, false}};
  const std::vector<Case> hows = cases();
  std::size_t n = 0;
  for (const auto& [name, size, tessellate] : scenes) {
    const TemporaryFolder folder;
    SpdRequest request;
    request.name = name, request.size = size, request.tessellate = tessellate;
    if (std::string(name) == "sombrero") request.size.reset();
    write_scene(folder, "scene.nff", request);
    // Every scene as it is, and with a few of the others in turn.
    for (const std::size_t how : {std::size_t{0}, 1 + n % 10, 1 + (n + 3) % 10, 1 + (n + 7) % 10}) {
      SCOPED_TRACE(fmt::format("{} {}", name, hows[how].name));
      const Exported in_memory = export_scene(folder, {"scene.nff"}, hows[how], 0);
      const std::size_t part = n % 2 == 0 ? 3000 : 20'000;
      const Exported streamed =
          export_scene(folder, {"scene.nff"}, hows[how], part, 1 + static_cast<int>(n % 3));
      expect_same(streamed, in_memory);
      EXPECT_EQ(streamed.readings, 2);
      if (HasFailure()) return;
    }
    ++n;
  }
}

TEST(Streaming, ReadsOnceMoreWhereTheViewComesLate) {
  const TemporaryFolder folder;
  const std::string view = "v\nfrom 3 2 1\nat 0 0 0\nup 0 0 1\nangle 40\nhither 1\nresolution 99 77\n";
  std::string polygons = "l 4 4 4\nf 1 0.5 0.2 0.8 0.2 9 0 1\n";
  for (int i = 0; i < 300; ++i)
    polygons +=
        fmt::format("p 3\n{} 0 0\n1 {} 0\n0 0 1\ns 0 {} 0 0.25\n", 1 + i % 7 * 0.1, 1 + i % 3, i * 0.01);
  test::write_file(folder / "late.nff", polygons + view);
  test::write_file(folder / "early.nff", view + polygons);
  test::write_file(folder / "none.nff", polygons);
  test::write_file(folder / "empty.nff", view);
  // Parallel to the frustum's side and with degenerate polygons, so that there is something to warn of.
  test::write_file(folder / "odd.nff",
                   view + polygons + "p 3\n1 1 1\n1 1 1\n0 0 0\np 2\n0 0 0\n1 0 0\nl 1 1 1\n");
  const std::pair<std::vector<std::string>, int> runs[] = {{{"late.nff"}, 3},
                                                           {{"early.nff"}, 2},
                                                           {{"early.nff", "none.nff"}, 2},
                                                           {{"none.nff", "early.nff"}, 3},
                                                           {{"empty.nff"}, 2},
                                                           {{"odd.nff", "odd.nff", "none.nff"}, 2}};
  for (const auto& [files, readings] : runs) {
    SCOPED_TRACE(files.front());
    const Exported in_memory = export_scene(folder, files, {}, 0);
    const Exported streamed = export_scene(folder, files, {}, 1000);
    expect_same(streamed, in_memory);
    EXPECT_EQ(streamed.readings, readings);
  }
}

TEST(Streaming, FindsTheErrorsAndRefusesFilesThatChange) {
  const TemporaryFolder folder;
  test::write_file(folder / "bad.nff", "v\nfrom 3 2 1\nat 0 0 0\np 3\n0 0 0\n");
  EXPECT_THROW(export_scene(folder, {"bad.nff"}, {}, 1000), Error);
  testing::internal::GetCapturedStderr();

  SpdRequest request;
  request.name = "tetra", request.size = 3;
  write_scene(folder, "scene.nff", request);
  Session session;
  InputOptions input;
  input.files = {(folder / "scene.nff").string()};
  const ViewOptions view;
  const SceneOptions scene;
  StreamedDrawing streamed(session, input, view, scene, Viewport{});
  prepare_drawing(session, streamed.finish_loading(), {}, 1);
  request.size = 2;
  write_scene(folder, "scene.nff", request);
  OutputFile file((folder / "out.scr").string());
  FlatWriter writer(file);
  EXPECT_THROW(streamed.draw({}, writer), Error);
}

TEST(Streaming, IsNotForEverything) {
  InputOptions input;
  SceneOptions scene;
  input.files = {"no-such-file.nff"};  // reading it says what is wrong
  EXPECT_EQ(obstacle_to_streaming(input, scene), "");
  scene.normals = "shared";
  EXPECT_NE(obstacle_to_streaming(input, scene), "");
  scene.normals = "face";
  for (const char* file : {"-", "/dev/null", "scene.sipp", "scene.tcl"}) {
    input.files = {"no-such-file.nff", file};
    EXPECT_NE(obstacle_to_streaming(input, scene), "") << file;
    EXPECT_FALSE(should_stream("auto", input, scene));
    EXPECT_FALSE(should_stream("off", input, scene));
    EXPECT_THROW(should_stream("on", input, scene), Error);
  }
}

}  // namespace
}  // namespace farop::app
