// SPDX-License-Identifier: GPL-3.0-or-later
// Rasterizers of users, as they name and run them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "support/shell.h"

namespace farop::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const char* const k_background = " --background 0.078 0.361 0.753 ";  // of the scene; a flat file has none

class Rasterizers : public testing::Test {
 protected:
  Outcome run(const std::string& command, int status = 0) {
    Outcome outcome = shell(folder_, command);
    EXPECT_EQ(outcome.status, status) << command << "\n" << outcome.out << outcome.err;
    return outcome;
  }
  void make_scene(const std::string& name = "gears --size 2", const std::string& more = "") {
    run("farop spd " + name +
        " -o gears.nff -q && farop export gears.nff -o gears.scr --resolution "
        "257x193 -q" +
        more);
  }
  void expect_message(const std::string& command, int status, const std::string& message) {
    const Outcome outcome = run(command, status);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << command << "\n" << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "out.ppm")) << command;
  }
  TemporaryFolder folder_;
};

class ShippedRasterizer : public Rasterizers, public testing::WithParamInterface<const char*> {};

TEST_P(ShippedRasterizer, DrawsWhatTheInternalOneDraws) {
  // The algorithm for solids knows which polygons belong together when it draws a scene, and relies on their
  // being solids. The others get triangles: how colours run over more corners differs from one to the next.
  const bool solids = GetParam() == std::string("solids");
  const std::string triangles = solids ? "" : " --triangles ";
  make_scene(solids ? "hollow-cube" : "gears --size 2", triangles);
  const std::string by = std::string(" --rasterizer ") + GetParam() + " ";
  run("farop raster gears.scr -o theirs.ppm -q" + std::string(k_background));
  run("farop raster gears.scr -o mine.ppm -q" + by + k_background);
  run("farop compare mine.ppm theirs.ppm --fail 0.005");  // one step of 8 bits
  run("farop render gears.nff -o rendered.ppm --resolution 257x193 -q" + by + triangles + k_background +
      "&& cmp rendered.ppm mine.ppm");
  run("farop raster - < gears.scr -o piped.ppm -q" + by + k_background + "&& cmp piped.ppm mine.ppm");
}

TEST_P(ShippedRasterizer, DrawsFlatPolygonsInTheColourOfTheirFirstCorner) {
  run("farop spd teapot --size 3 -o pot.nff -q && farop export pot.nff -o pot.scr --resolution 120x90 -q");
  const std::string by = std::string(" --rasterizer ") + GetParam() + " ";
  run("farop raster pot.scr -o theirs.ppm --mode flat -q");
  run("farop raster pot.scr -o mine.ppm --mode flat -q" + by);
  run("farop compare mine.ppm theirs.ppm --fail 0.005");
  run("farop raster pot.scr -o smooth.ppm -q" + by + "; farop compare mine.ppm smooth.ppm --fail 0.005", 1);
  if (GetParam() == std::string("solids")) return;
  make_scene();  // polygons of up to 146 corners
  run("farop raster gears.scr -o gears.ppm --mode flat -q");
  run("farop raster gears.scr -o theirs.ppm --mode flat -q" + by + "&& cmp gears.ppm theirs.ppm");
}

INSTANTIATE_TEST_SUITE_P(All, ShippedRasterizer,
                         testing::Values("trapezoid", "scanline_fill", "watkins", "solids"));

TEST_F(Rasterizers, AreListedWithWhatTheySayOfThemselves) {
  const std::string list = run("farop plugins").out;
  EXPECT_NE(list.find("trapezoid       z-buffer by trapezoids"), std::string::npos) << list;
  EXPECT_NE(list.find("lib/farop/plugins/scanline_fill.so"), std::string::npos) << list;
  run("test -f \"$(farop plugins --abi | tail -1)/farop/rasterizer.h\"");
}

TEST_F(Rasterizers, AreFoundInFoldersBeforeTheInstalledOnes) {
  make_scene();
  const std::string copy =
      "mkdir a b; so=$(farop plugins | grep -o '/.*trapezoid.so'); cp $so a/mine.so; cp $so b/libyours.so; ";
  run(copy + "FAROP_PLUGIN_PATH=/nowhere::b farop raster gears.scr -o out.ppm -I a --rasterizer mine");
  run("FAROP_PLUGIN_PATH=/nowhere::b farop raster gears.scr -o out.ppm --rasterizer yours");
  run("cd a; farop raster ../gears.scr -o out.ppm --rasterizer mine.so");
  const std::string list = run("farop plugins -I a -I b").out;
  EXPECT_LT(list.find("mine "), list.find("yours ")) << list;
  EXPECT_LT(list.find("yours "), list.find("scanline_fill ")) << list;
}

TEST_F(Rasterizers, ThatCannotBeHadAreNamedWithARemedy) {
  make_scene();
  run("echo text > text.so");
  expect_message("farop raster gears.scr -o out.ppm --rasterizer trapzoid", 3, "did you mean 'trapezoid'?");
  expect_message("farop render gears.nff -o out.ppm --rasterizer ./none.so", 3,
                 "./none.so: cannot be opened");
  expect_message("farop render gears.nff -o out.ppm --rasterizer ./text.so", 3, "is not a shared library");
  expect_message("farop render none.nff -o out.ppm --rasterizer ./text.so", 3,
                 "is not a shared library");  // first
  expect_message("farop render gears.nff -o out.ppm --rasterizer trapezoid --cmd 'x {flat} {ppm}'", 2,
                 "both given");
  expect_message("farop render gears.nff -o out.ppm --rasterizer trapezoid --mode phong", 2,
                 "internal rasterizer only");
  expect_message("farop render gears.nff -o out.ppm --rasterizer trapezoid --mode line", 2,
                 "internal rasterizer only");
  expect_message("farop render gears.nff -o out.ppm --rasterizer trapezoid --depth d.exr", 2, "--depth");
  expect_message("farop render gears.nff -o out.ppm --rasterizer trapezoid --plugin-option novalue", 2,
                 "KEY=VALUE");
  expect_message(
      "farop render gears.nff -o out.ppm --rasterizer trapezoid --resolution 30000x30000 --samples 2", 2,
      "larger than 32767");
}

/// Rasterizers in Python: skipped, and said so, where there is no adapter or no NumPy. The interpreter keeps
/// memory to its end, which a leak checker would report.
class PythonRasterizers : public Rasterizers {
 protected:
  void SetUp() override {
    write_file(folder_ / "mine.py", read_file(fs::path(FAROP_SOURCE_DIR) / "docs/rasterizers/zbuffer.py"));
    run("farop spd teapot --size 3 -o pot.nff -q && farop export pot.nff --triangles -o pot.scr --resolution "
        "120x90 -q");
    const Outcome listed = run(k_no_leak_check + "farop plugins -I .");
    for (const char* reason : {"was built without Python", "ModuleNotFoundError"}) {
      if ((listed.out + listed.err).find(reason) != std::string::npos) GTEST_SKIP() << reason;
    }
    EXPECT_NE(listed.out.find("mine            A z-buffer for triangles"), std::string::npos) << listed.out;
  }
  /// mine.py with one line changed, drawn.
  Outcome changed(const std::string& what, const std::string& by, int status) {
    run("sed 's/" + what + "/" + by + "/' mine.py > changed.py && ! cmp -s mine.py changed.py");
    return run(k_no_leak_check + "farop raster pot.scr -o out.ppm --rasterizer changed.py", status);
  }
  const std::string k_no_leak_check = "export ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0; ";
};

TEST_F(PythonRasterizers, DrawWhatTheInternalOneDraws) {
  run(k_no_leak_check + "farop raster pot.scr -o mine.ppm --rasterizer mine.py");
  run("farop raster pot.scr -o theirs.ppm && farop compare mine.ppm theirs.ppm --fail 0.005");
  // Of a file with other polygons it gets their triangles.
  run("farop export pot.nff -o clipped.scr --resolution 120x90 --from 2 3 2 -q");
  run(k_no_leak_check + "farop raster clipped.scr -o mine.ppm --rasterizer ./mine.py -q");
}

TEST_F(PythonRasterizers, FailWithTheLineAndTheirOwnWords) {
  const auto expect = [&](const std::string& what, const std::string& by, const std::string& message) {
    const Outcome outcome = changed(what, by, 3);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  expect("if area == 0:", "if area == nothing:", "changed.py:20: NameError: name 'nothing' is not defined");
  expect("if area == 0:", "if area = 0:", "changed.py:20:12: invalid syntax");
  expect("def end_frame", "def finish", "its class Rasterizer has no method end_frame");
  expect("class Rasterizer", "class Other", "it defines no class Rasterizer");
  expect("wants = (\"triangles\",)", "wants = (\"squares\",)",
         "it wants 'squares', which is none of triangles");
}

TEST_F(PythonRasterizers, PrintToTheLog) {
  const Outcome outcome =
      changed("self.host = host", "print(\"hello\"); print(host.option(\"colour\", \"none\"))", 0);
  EXPECT_EQ(outcome.out, "");
  const Outcome verbose =
      run(k_no_leak_check +
          "farop raster pot.scr -o out.ppm --rasterizer changed.py --plugin-option colour=red -v");
  EXPECT_NE(verbose.err.find("hello\nred\n"), std::string::npos) << verbose.err;
}

TEST_F(Rasterizers, ThatCrashAreNamedWithThePolygonAndAFileThatRepeatsIt) {
  make_scene();
  const std::string crash = FAROP_HOSTILE "/crash.segv/01-null-dereference.so";
  const std::string words = "null pointer: it wrote to address 0 in polygon 2 (";
  expect_message("farop render gears.nff -o out.ppm --resolution 257x193 --rasterizer " + crash, 3, words);
  expect_message("farop render gears.nff -o out.ppm --resolution 257x193 --rasterizer " + crash, 3,
                 "note: crash.segv, in deed");
  const std::string repeat = read_file(folder_ / "01-null-dereference.crash.scr");
  EXPECT_TRUE(repeat.starts_with("257 193 65536 256\n3 ")) << repeat.substr(0, 40);
  const std::string all = read_file(folder_ / "gears.scr");
  const std::size_t first = all.find("\n1\n");
  const std::size_t polygons = repeat.size() - repeat.find("\n1\n") - 4;  // without the end mark
  EXPECT_EQ(repeat.substr(repeat.find("\n1\n"), polygons), all.substr(first, polygons));
  expect_message("farop raster 01-null-dereference.crash.scr -o out.ppm --rasterizer " + crash, 3, words);
  // The same by a flat file in the first place; and the scene goes through with a rasterizer that works.
  expect_message("rm *.crash.scr; farop raster gears.scr -o out.ppm --rasterizer " + crash, 3, words);
  EXPECT_EQ(read_file(folder_ / "01-null-dereference.crash.scr"), repeat);
  run("farop render gears.nff -o out.ppm --rasterizer trapezoid");
}

TEST_F(Rasterizers, ThatDoNotEndAreStopped) {
  make_scene();
  expect_message("farop raster gears.scr -o out.ppm --cpu 0.5 --rasterizer " FAROP_HOSTILE
                 "/limit.time/06-infinite-loop.so",
                 3, "stopped after 0.5 s of CPU time in polygon 2");
  expect_message("farop raster gears.scr -o out.ppm --wall 0.5 --rasterizer " FAROP_HOSTILE
                 "/limit.time/07a-sleep.so",
                 3, "in polygon 2");
}

TEST_F(Rasterizers, RunBehindTheWallsThatTheStatisticsName) {
  make_scene();
  const Outcome strict = shell(
      folder_, "farop raster gears.scr -o out.ppm --rasterizer trapezoid --isolation strict --stats s.json");
  if (strict.status == 4) GTEST_SKIP() << "this machine lacks a wall: " << strict.err;
  ASSERT_EQ(strict.status, 0) << strict.err;
  const std::string stats = read_file(folder_ / "s.json");
  for (const char* wall :
       {"\"0 process\"", "\"A limits\"", "\"B namespaces\"", "\"C landlock\"", "\"D seccomp\""}) {
    EXPECT_NE(stats.find(wall), std::string::npos) << stats;
  }
  run("farop raster gears.scr -o off.ppm --rasterizer trapezoid --isolation off --stats s.json && cmp "
      "off.ppm out.ppm");
  EXPECT_EQ(read_file(folder_ / "s.json").find("D seccomp"), std::string::npos);
  run("farop raster gears.scr -o in.ppm --rasterizer trapezoid --in-process && cmp in.ppm out.ppm");
}

TEST_F(Rasterizers, AreTimedCallByCall) {
  make_scene("gears --size 6");
  for (const std::string how : {"", "--in-process"}) {
    run("farop render gears.nff -o out.ppm -q --resolution 1200x1200 --rasterizer watkins --stats s.json "
        "--trace t.json " +
        how);
    const Json stats = Json::parse(read_file(folder_ / "s.json"));
    double processor = 0, elapsed = 0;
    std::map<std::string, int> slices;
    for (const char* call : {"create", "begin_frame", "polygon", "end_frame"}) {
      const Json& timer = stats["raster"]["call_timers"][call];
      EXPECT_EQ(timer["elapsed"], stats["raster"]["calls"][call]) << call;
      processor += timer["user"].get<double>() + timer["system"].get<double>();
      elapsed += timer["elapsed"].get<double>();
      // Both or neither, and as the stages have it: one machine allows counting or does not.
      EXPECT_EQ(timer["cycles"].is_null(), stats["timers"]["geometry"]["cycles"].is_null()) << call;
      EXPECT_EQ(timer["instructions"].is_null(), timer["cycles"].is_null()) << call;
      slices[call] = 0;
    }
    EXPECT_GT(processor, 0) << stats["raster"];
    EXPECT_LE(processor, 1.1 * elapsed + 0.02) << stats["raster"];  // one thread

    const Json trace = Json::parse(read_file(folder_ / "t.json"));
    double total = 0, end = 0, traced = 0;
    std::set<std::string> tracks;
    for (const Json& event : trace["traceEvents"]) {
      if (event["name"] == "thread_name") tracks.insert(event["args"]["name"]);
      if (event["name"] == "total") total = event["dur"];
      if (event["ph"] != "X" || event["tid"] != 2) continue;
      ++slices.at(event["name"]);
      // Slices of a track do not overlap: the rasterizer is called by one thread.
      EXPECT_GE(event["ts"].get<double>(), end - 1) << event;
      end = event["ts"].get<double>() + event["dur"].get<double>();
      traced += event["dur"].get<double>();
    }
    EXPECT_EQ(tracks, (std::set<std::string>{"calls of the rasterizer", "stages"}));
    EXPECT_EQ(slices["create"], 1);
    EXPECT_EQ(slices["begin_frame"], 1);
    EXPECT_GT(slices["polygon"], 1);  // by the chunk
    EXPECT_EQ(slices["end_frame"], 1);
    EXPECT_LE(end, total + 1);
    EXPECT_NEAR(traced, 1e6 * elapsed, 10);
  }
}

TEST_F(Rasterizers, ThatKeepTheContractPassItsCheck) {
  make_scene();
  for (const std::string name : {"trapezoid", "scanline_fill", "watkins", "solids"}) {
    run("farop render gears.nff -o plain.ppm -q --resolution 130x90 --rasterizer " + name);
    for (const std::string how : {"", " --in-process"}) {
      const Outcome checked =
          run("farop render gears.nff -o checked.ppm -q --resolution 130x90 --check "
              "--stats s.json --rasterizer " +
              name + how + " && cmp plain.ppm checked.ppm");
      EXPECT_EQ(checked.err, "") << name << how;
      EXPECT_TRUE(Json::parse(read_file(folder_ / "s.json"))["raster"]["findings"].empty());
    }
  }
}

TEST_F(Rasterizers, ThatBreakTheContractAreToldByItsCheck) {
  make_scene();
  const auto broken = [&](const std::string& plugin, const std::string& how, const std::string& note) {
    const Outcome outcome = run("farop raster gears.scr -o out.ppm --stats s.json --check " + how +
                                    " --rasterizer " FAROP_HOSTILE "/" + plugin,
                                1);
    EXPECT_NE(outcome.err.find(note), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("farop: error: --check found "), std::string::npos) << outcome.err;
    EXPECT_TRUE(fs::exists(folder_ / "out.ppm")) << "the picture is there all the same";
    return Json::parse(read_file(folder_ / "s.json"));
  };
  broken("oob.write-stride/16-stride-padding.so", "--in-process",
         "it wrote behind the last pixel of a row: row 0 (oob.write-stride)");
  broken("oob.write-input/18-modifies-vertices.so", "--in-process",
         "it changed the polygon that it was given (polygon 2) (oob.write-input)");
  for (const char* how : {"", "--in-process"}) {
    const Json stats =
        broken("pass/58b-flush-to-zero.so", how,
               "changed the rounding mode or how denormal numbers are treated (polygon 2) (abi.float-state)");
    EXPECT_EQ(stats["status"], 1);
    EXPECT_EQ(stats["raster"]["findings"][0]["verdict"], "abi.float-state");
    EXPECT_EQ(stats["raster"]["findings"][0]["polygon"], 2);
  }
  run("farop raster gears.scr -o out.ppm -q --check", 2);
  run("farop raster gears.scr -o out.ppm -q --check --cmd 'cp {flat} {ppm}'", 2);
}

TEST_F(Rasterizers, IncludeAReadableReference) {
  make_scene();
  run("farop raster gears.scr -o reference.ppm --check --rasterizer scanline");
  run("farop raster gears.scr -o out.ppm --rasterizer scanline_fill && cmp out.ppm reference.ppm");
  fs::remove(folder_ / "out.ppm");
  expect_message("farop raster gears.scr -o out.ppm --rasterizer scanlin", 3, "did you mean 'scanline'?");
}

TEST_F(Rasterizers, SeeNothingOfABadFlatFile) {
  make_scene();
  run("head -n 100 gears.scr > cut.scr");
  expect_message("farop raster cut.scr -o out.ppm --rasterizer trapezoid", 1, "cut.scr:");
}

TEST_F(Rasterizers, MayBeProgramsThatReadAFlatFileAndWriteAPpm) {
  make_scene();
  run("farop raster gears.scr -o theirs.ppm -q" + std::string(k_background));
  const std::string draw = std::string("farop raster {flat} -o {ppm} -q") + k_background;
  run("farop render gears.nff -o mine.ppm --resolution 257x193 -q --cmd '" + draw +
      "' && cmp mine.ppm theirs.ppm");
  run("farop raster gears.scr -o mine.ppm -q --cmd '" + draw + "' && cmp mine.ppm theirs.ppm");
  // What it prints does not mix with the picture on standard output.
  run("farop raster gears.scr -o - -q --cmd 'echo noise; " + draw +
      "' 2> said > mine.ppm && cmp mine.ppm theirs.ppm");
  EXPECT_EQ(read_file(folder_ / "said"), "noise\n");
}

TEST_F(Rasterizers, ThatAreProgramsAreBlamedInTheirOwnWords) {
  make_scene();
  const auto by = [](const std::string& command) {
    return "mkdir -p tmp; TMPDIR=$PWD/tmp farop raster gears.scr -o out.ppm --cmd '" + command + "'";
  };
  expect_message(by("true {flat}"), 2, "does not say where {ppm} goes");
  expect_message(by("exit 7; {flat} {ppm}"), 3, "ended with exit status 7");
  expect_message(by("kill -SEGV $$; {flat} {ppm}"), 3, "killed by signal 11 (Segmentation fault)");
  expect_message(by("nosuchprogram {flat} {ppm}"), 3, "the shell did not find it");
  expect_message(by("true {flat} {ppm}"), 3, "picture.ppm: cannot be opened");
  expect_message(by("echo P3 1 1 255 0 0 0 > {ppm}; true {flat}"), 3, "P3 is the text form");
  expect_message(by("printf \"P6 2 1 255\\nabcdef\" > {ppm}; true {flat}"), 3,
                 "has 2 x 1 pixels, expected 257 x 193");
  run("test -z \"$(ls -A tmp)\"");  // nothing is left behind
}

}  // namespace
}  // namespace farop::test
