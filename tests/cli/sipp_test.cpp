// SPDX-License-Identifier: GPL-3.0-or-later
// Scripts as scenes, as a user runs them: pictures and conversions of our own scenes, what the pages promise,
// and scripts that mean harm.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "support/sanitizers.h"
#include "support/shell.h"

namespace farop::test {
namespace {

namespace fs = std::filesystem;

const fs::path k_source = FAROP_SOURCE_DIR;

constexpr double k_patience = k_address_sanitizer ? 30 : 6;  // seconds beyond a limit

Outcome must(const TemporaryFolder& folder, const std::string& command) {
  const Outcome run = shell(folder, command);
  EXPECT_EQ(run.status, 0) << command << "\n" << run.err;
  return run;
}

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

// ---- scripts that mean harm ----

struct HostileCase {
  std::string name, options, message;
};

void PrintTo(const HostileCase& c, std::ostream* out) {
  *out << c.name;
}

std::vector<HostileCase> hostile_cases() {
  std::vector<HostileCase> cases;
  std::ifstream manifest(k_source / "tests/sipp/hostile/manifest.txt");
  for (std::string line; std::getline(manifest, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    HostileCase c;
    std::getline(fields, c.name, '\t');
    std::getline(fields, c.options, '\t');
    std::getline(fields, c.message);
    if (c.options == "-") c.options.clear();
    cases.push_back(c);
  }
  return cases;
}

/// Every file below a folder with its size; links are not followed.
std::map<std::string, std::uintmax_t> files_below(const fs::path& folder) {
  std::map<std::string, std::uintmax_t> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const bool plain = !entry.is_symlink() && entry.is_regular_file();
    files[entry.path().lexically_relative(folder).string()] = plain ? entry.file_size() : 0;
  }
  return files;
}

class HostileScripts : public testing::TestWithParam<HostileCase> {};

TEST_P(HostileScripts, EndWithOneMessage) {
  const HostileCase& c = GetParam();
  const TemporaryFolder folder;
  fs::create_directories(folder / "scene/sub");
  fs::copy_file(k_source / "tests/sipp/hostile" / (c.name + ".sipp"), folder / "scene/hostile.sipp");
  write_file(folder / "outside.tcl", "puts outside\n");
  fs::create_symlink("../outside.tcl", folder / "scene/link.tcl");
  fs::create_directory_symlink("../..", folder / "scene/sub/link");
  must(folder, "mkfifo scene/fifo.tcl");
  const auto before = files_below(folder.path());
  const auto start = std::chrono::steady_clock::now();
  const Outcome run = shell(folder, "cd scene && farop convert hostile.sipp -o out.nff " + c.options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(count(run.err, "error:"), 1) << run.err;
  EXPECT_TRUE(std::regex_search(run.err, std::regex(c.message, std::regex::extended))) << run.err;
  EXPECT_EQ(run.err.find("outside\n"), std::string::npos) << run.err;
  EXPECT_EQ(files_below(folder.path()), before);
  std::smatch limit;
  const bool timed = std::regex_search(c.options, limit, std::regex("--script-time ([0-9]+)"));
  EXPECT_LT(seconds, (timed ? std::stod(limit[1]) : 20) + k_patience);
}

INSTANTIATE_TEST_SUITE_P(All, HostileScripts, testing::ValuesIn(hostile_cases()), [](const auto& test) {
  return std::regex_replace(test.param.name, std::regex("-"), "_");
});

TEST(HostileScripts, AreManyAndNoneIsForgotten) {
  std::set<std::string> listed, there;
  for (const HostileCase& c : hostile_cases()) listed.insert(c.name);
  for (const auto& entry : fs::directory_iterator(k_source / "tests/sipp/hostile")) {
    if (entry.path().extension() == ".sipp") there.insert(entry.path().stem().string());
  }
  EXPECT_EQ(listed, there);
  EXPECT_GE(listed.size(), 25u);
}

TEST(HostileScripts, LeaveNoProcessBehind) {
  const TemporaryFolder folder;
  write_file(folder / "loop.sipp", "while {1} {}\n");
  // The one that waits is ended from outside; its script must go with it.
  const Outcome run = shell(folder,
                            "farop info loop.sipp --script-time 100 & parent=$!; sleep 0.5; "
                            "child=$(cat /proc/$parent/task/$parent/children); kill -9 $parent; sleep 0.5; "
                            "test -n \"$child\" && ! grep -qs 'State:.[RSD]' /proc/$child/status");
  EXPECT_EQ(run.status, 0) << run.err;
}

// ---- errors ----

TEST(ScriptErrors, NameFileLineColumnFoundExpectedAndRemedy) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "parts");
  write_file(folder / "parts/leg.tcl",
             "proc leg {size} {\n  set s 1\n  SippCylinder $size thick 8 $::shader\n}\n");
  write_file(folder / "robot.sipp",
             "source parts/leg.tcl\nset shader [SippShaderBasic 0 0 1 {1 1 1}]\nforeach side {left right} {\n"
             "  leg 2\n}\n");
  const Outcome run = shell(folder, "farop info robot.sipp");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(
      run.err,
      "parts/leg.tcl:3:22: error: SippCylinder: 'thick' found for the length, expected a finite number\n"
      "     3 |   SippCylinder $size thick 8 $::shader\n"
      "       |                      ^~~~~\n"
      "  hint: usage: SippCylinder radius length res shader ?texture?; called from robot.sipp:4\n");
}

TEST(ScriptErrors, OfTclItselfAreTracedIntoProcedures) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp",
             "proc half {x} {\n  set y 1\n  loop i 0 2 {\n    set z [expr {$x / 0}]\n  }\n}\n\nhalf 3\n");
  const Outcome run = shell(folder, "farop info a.sipp");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("a.sipp:4:"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("divide by zero, in 'expr {$x / 0}'"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("called from a.sipp:8"), std::string::npos) << run.err;
}

TEST(ScriptErrors, OfTclItselfHaveARemedyToo) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& script) {
    write_file(folder / "a.sipp", script);
    const Outcome run = shell(folder, "farop info a.sipp");
    EXPECT_EQ(run.status, 1);
    return run.err;
  };
  EXPECT_EQ(
      said("set x 1\nSippObjectMove WORLD [list $x $frame 0]\n"),
      "a.sipp:2:31: error: can't read \"frame\": no such variable, in 'list $x $frame 0'\n"
      "     2 | SippObjectMove WORLD [list $x $frame 0]\n"
      "       |                               ^~~~~~\n"
      "  hint: set it before, or from outside by --define NAME=VALUE; procedures write $::NAME for what "
      "is set outside them\n");
  EXPECT_NE(said("expr {1 +}\n").find("error: missing operand at _@_ in expression \"1 +_@_\"\n"),
            std::string::npos);
  EXPECT_NE(said("set s 1\nif {$s} {\n  puts a\n").find("  hint: every { needs its }"), std::string::npos);
  EXPECT_NE(said("source parts/arm.tcl\n").find("'parts/arm.tcl': cannot open: No such file or directory\n"),
            std::string::npos);
  EXPECT_NE(said("source parts/arm.tcl\n").find("relative to the folder of the scene, '.'"),
            std::string::npos);
}

TEST(ScriptErrors, PointAtTheWordOnlyWhereItCanBeNoOther) {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& command) {
    write_file(folder / "a.sipp", "set s 1\n" + command + "\n");
    return shell(folder, "farop info a.sipp").err;
  };
  const auto starts = [](const std::string& text, const std::string& start) {
    return text.starts_with(start);
  };
  // The shader is 1, wherever else a 1 stands.
  EXPECT_PRED2(starts, said("SippSphere 12 1 $s"), "a.sipp:2:1: error: SippSphere: '1' found for a handle");
  EXPECT_PRED2(starts, said("SippSphere 12 21 $s"), "a.sipp:2:18: error: SippSphere: '1' found for a handle");
  EXPECT_PRED2(starts, said("set o [SippSphere 12 21 $s]"), "a.sipp:2:25: error: SippSphere: '1' found for");
  EXPECT_PRED2(starts, said("SippSphere 12 24 1"), "a.sipp:2:18: error: SippSphere: '1' found for a handle");
  EXPECT_PRED2(starts, said("SippSphere 12 24 \\\n $s"), "a.sipp:2:1: error: SippSphere: '1' found for");
  EXPECT_PRED2(starts, said("SippSphere {*}{12 24 1}"), "a.sipp:2:22: error: SippSphere: '1' found for");
  EXPECT_PRED2(starts, said("SippObjectMove WORLD [list 3 x 3]"), "a.sipp:2:30: error: ");
  EXPECT_PRED2(starts, said("SippObjectMove WORLD {1 2}"), "a.sipp:2:23: error: ");
  EXPECT_PRED2(starts, said("puts [expr {1 / 0}]; expr 1"), "a.sipp:2:7: error: divide by zero");
}

TEST(ScriptErrors, NestingStopsWhereTheOptionSays) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp",
             "proc depth {n} {\n  if {$n > 1} {depth [expr {$n - 1}]}\n}\ndepth $n\n"
             "SippRender [SippPixMapCreate] 10 10\n");
  const auto run = [&](const std::string& options) { return shell(folder, "farop info a.sipp " + options); };
  EXPECT_EQ(run("--define n=900").status, 0);
  const Outcome deep = run("--define n=1100");
  EXPECT_EQ(deep.status, 1);
  EXPECT_NE(deep.err.find("too many nested evaluations"), std::string::npos) << deep.err;
  EXPECT_NE(deep.err.find("--script-nesting N allows more"), std::string::npos) << deep.err;
  EXPECT_EQ(run("--define n=1100 --script-nesting 1200").status, 0);
  EXPECT_EQ(run("--define n=50 --script-nesting 40").status, 1);
  EXPECT_EQ(run("--define n=5 --script-nesting 9").status, 2);
}

TEST(ScriptErrors, SuggestCommands) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp", "set s [SippShaderFong 0 1 0 1 {1 1 1}]\n");
  const Outcome run = shell(folder, "farop info a.sipp");
  EXPECT_NE(run.err.find("did you mean 'SippShaderPhong'?"), std::string::npos) << run.err;
}

TEST(ScriptErrors, OnTheCommandLine) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp", "SippRender [SippPixMapCreate] 10 10\n");
  for (const std::string define : {"frame", "2x=1", "a(b)=1", "=1"}) {
    const Outcome run = shell(folder, "farop info a.sipp --define '" + define + "'");
    EXPECT_EQ(run.status, 2) << define;
    EXPECT_NE(run.err.find("expected NAME=VALUE"), std::string::npos) << run.err;
  }
  EXPECT_EQ(shell(folder, "farop info a.sipp --script-time 0").status, 2);
  EXPECT_EQ(shell(folder, "farop info none.sipp").status, 1);
  EXPECT_EQ(shell(folder, "cp a.sipp a.txt; farop info a.txt").status, 2);
  EXPECT_EQ(shell(folder, "farop info a.txt --format sipp").status, 0);
  EXPECT_EQ(shell(folder, "farop info - --format sipp < a.sipp").status, 0);
}

// ---- what a script decides ----

TEST(ScriptScene, SizeModeAndSamplesAreDefaultsThatOptionsOverride) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp",
             "SippObjectAddSubobj WORLD [SippSphere 1 20 [SippShaderBasic .2 .5 .3 {1 0 0}]]\n"
             "SippLightSourceCreate {1 1 1} {1 1 1}\nSippRender [SippPixMapCreate] 64 48 PHONG 2\n");
  must(folder,
       "farop render a.sipp -o script.ppm; farop render a.sipp -o given.ppm --mode phong --samples 2 "
       "--resolution 64x48; farop render a.sipp -o other.ppm --mode flat --samples 1");
  EXPECT_EQ(read_file(folder / "script.ppm"), read_file(folder / "given.ppm"));
  EXPECT_NE(read_file(folder / "script.ppm"), read_file(folder / "other.ppm"));
  EXPECT_TRUE(read_file(folder / "script.ppm").starts_with("P6\n64 48\n255\n"));
}

TEST(ScriptScene, ShowsBackFacesUnlessAnOptionSaysOtherwise) {
  const TemporaryFolder folder;
  const std::string cube =
      "SippObjectAddSubobj WORLD [SippCube 1 [SippShaderBasic .2 .5 .3 {1 0 0}]]\n"
      "SippRender [SippPixMapCreate] 32 32\n";
  write_file(folder / "off.sipp", cube);
  write_file(folder / "on.sipp", "SippShowBackFaces true\n" + cube);
  const auto rendered = [&](const std::string& arguments) {
    const std::string err = must(folder, "farop render " + arguments + " -o a.ppm").err;
    std::smatch m;
    EXPECT_TRUE(std::regex_search(err, m, std::regex("([0-9]+) rendered"))) << err;
    return m.empty() ? std::string() : m[1].str();
  };
  EXPECT_EQ(rendered("off.sipp"), "1");
  EXPECT_EQ(rendered("on.sipp"), "6");
  EXPECT_EQ(rendered("off.sipp --two-sided"), "6");
  EXPECT_EQ(rendered("on.sipp --one-sided"), "1");
}

TEST(ScriptScene, DefinesReachTheScriptBeforeItStarts) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp", "puts \"frame $frame of $name\"\nSippRender [SippPixMapCreate] $frame 10\n");
  const Outcome run =
      must(folder, "farop info a.sipp --define frame=12 --define 'name=[exec ls] $x' --verbose");
  EXPECT_NE(run.err.find("script: frame 12 of [exec ls] $x"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("resolution  12 x 10"), std::string::npos) << run.out;
}

TEST(ScriptScene, CaptureChoosesTheRendering) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp",
             "loop i 1 4 {\n  SippObjectMove WORLD {1 0 0}\n  SippRender [SippPBMOpen out.ppm w] [expr {10 * "
             "$i}] 10\n}\n");
  EXPECT_NE(must(folder, "farop info a.sipp").out.find("resolution  10 x 10"), std::string::npos);
  EXPECT_NE(must(folder, "farop info a.sipp --capture 3").out.find("resolution  30 x 10"), std::string::npos);
  const Outcome run = shell(folder, "farop info a.sipp --capture 4");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("asks for 3 renderings, expected at least 4"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(folder / "out.ppm"));
}

TEST(ScriptScene, WithoutARenderingIsTakenAtItsEndWithANote) {
  const TemporaryFolder folder;
  write_file(folder / "a.sipp",
             "SippObjectAddSubobj WORLD [SippCube 1 [SippShaderBasic .2 .5 .3 {1 0 0}]]\n");
  const Outcome run = must(folder, "farop info a.sipp");
  EXPECT_NE(run.err.find("a.sipp: note: the script asks for no rendering"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("polygons      6\n"), std::string::npos) << run.out;
}

TEST(ScriptScene, MergesWithNff) {
  const TemporaryFolder folder;
  must(folder, "farop spd hollow-cube -o cube.nff");
  write_file(folder / "a.sipp",
             "SippObjectAddSubobj WORLD [SippCube 1 [SippShaderBasic .2 .5 .3 {1 0 0}]]\n"
             "SippBackground {0 0 1}\nSippRender [SippPixMapCreate] 64 48\n");
  const Outcome last = must(folder, "farop info cube.nff a.sipp");
  EXPECT_NE(last.out.find("polygons      134\n"), std::string::npos) << last.out;
  EXPECT_NE(last.out.find("background  0 0 1"), std::string::npos) << last.out;
  EXPECT_NE(last.err.find("overrides"), std::string::npos) << last.err;
  const Outcome first = must(folder, "farop info a.sipp cube.nff");
  EXPECT_EQ(first.out.find("background  0 0 1"), std::string::npos) << first.out;
}

// ---- our own scenes ----

/// name -> objects, surfaces, polygons, lights, as the README's table says.
std::map<std::string, std::vector<int>> scene_table() {
  std::map<std::string, std::vector<int>> table;
  std::ifstream readme(k_source / "spd_scenes/sipp/README.md");
  const std::regex row(R"(\| `([a-z]+\.sipp)` \| (\d+) \| (\d+) \| (\d+) \| (\d+) \|.*)");
  std::smatch m;
  for (std::string line; std::getline(readme, line);) {
    if (std::regex_match(line, m, row))
      table[m[1]] = {std::stoi(m[2]), std::stoi(m[3]), std::stoi(m[4]), std::stoi(m[5])};
  }
  return table;
}

TEST(OurScenes, AreDrawnWithoutAWarningAndHaveTheCountsOfTheTable) {
  const TemporaryFolder folder;
  const auto table = scene_table();
  EXPECT_GE(table.size(), 8u);
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(k_source / "spd_scenes/sipp")) {
    if (entry.path().extension() != ".sipp") continue;
    const std::string name = entry.path().filename();
    files.insert(name);
    ASSERT_TRUE(table.contains(name)) << name;
    const std::string path = "'" + entry.path().string() + "'";
    const Outcome run = must(folder, "farop render " + path +
                                         " -o p.ppm --strict --resolution 160x120 && "
                                         "farop info " +
                                         path);
    EXPECT_EQ(run.err.find("warning"), std::string::npos) << run.err;
    const std::vector<int>& counts = table.at(name);
    for (const auto& [word, value] :
         {std::pair{"objects", counts[0]}, {"surfaces", counts[1]}, {"polygons", counts[2]}}) {
      const std::regex line(std::string(word) + " +" + std::to_string(value) + "\n");
      EXPECT_TRUE(std::regex_search(run.out, line)) << name << " " << word << "\n" << run.out;
    }
    EXPECT_EQ(count(run.out, "\nlight "), counts[3]) << name;
    // More than a background: many different colours.
    const std::string pixels = read_file(folder / "p.ppm");
    std::set<std::string> colors;
    for (std::size_t at = 15; at + 3 <= pixels.size(); at += 3) colors.insert(pixels.substr(at, 3));
    EXPECT_GT(colors.size(), 200u) << name;
  }
  EXPECT_EQ(files.size(), table.size());
}

TEST(OurScenes, TheFigureWalks) {
  const TemporaryFolder folder;
  const std::string walk = "'" + (k_source / "spd_scenes/sipp/walk.sipp").string() + "'";
  for (const std::string frame : {"0", "6", "12"}) {
    must(folder, "farop render " + walk + " -q --define frame=" + frame + " -o " + frame +
                     ".ppm --resolution 120x120");
  }
  EXPECT_NE(read_file(folder / "0.ppm"), read_file(folder / "6.ppm"));
  EXPECT_NE(read_file(folder / "0.ppm"), read_file(folder / "12.ppm"));
}

TEST(OurScenes, ConvertToNffPolygonForPolygon) {
  const TemporaryFolder folder;
  for (const std::string name : {"chain", "walk", "shapes"}) {
    const std::string path = "'" + (k_source / "spd_scenes/sipp" / (name + ".sipp")).string() + "'";
    must(folder, "farop convert " + path + " -q -o " + name + ".nff");
    const Outcome script = must(folder, "farop info " + path + " | grep '^polygons'");
    EXPECT_EQ(must(folder, "farop info " + name + ".nff | grep '^polygons'").out, script.out);
  }
}

TEST(OurScenes, ConvertToTriangles) {
  const TemporaryFolder folder;
  for (const std::string name : {"walk", "relief"}) {  // relief has a concave star
    const std::string path = "'" + (k_source / "spd_scenes/sipp" / (name + ".sipp")).string() + "'";
    must(folder, "farop convert " + path + " -q -o all.nff && farop convert " + path + " -q --triangles -o " +
                     "three.nff");
    const auto corner_counts = [&](const char* file) {
      std::vector<int> counts;
      std::istringstream lines(read_file(folder / file));
      for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("p ") || line.starts_with("pp ")) {
          counts.push_back(std::stoi(line.substr(line.find(' '))));
        }
      }
      return counts;
    };
    int triangles = 0;
    for (const int n : corner_counts("all.nff")) triangles += n - 2;
    EXPECT_GT(triangles, 1000);
    EXPECT_EQ(corner_counts("three.nff"), std::vector<int>(static_cast<std::size_t>(triangles), 3)) << name;
    // The same places are covered; where a quadrilateral is not quite flat its silhouette may differ.
    must(folder,
         "for f in all three; do sed '/^f /s/.*/f 1 1 1 0 0 1 0 1/; /^b /s/.*/b 0 0 0/' $f.nff > "
         "white-$f.nff; "
         "farop render white-$f.nff -q --mode flat --resolution 160x160 -o $f.ppm; done");
    const Outcome same = shell(folder, "farop compare all.ppm three.ppm --fail 0.004 --failpercent 0.05");
    EXPECT_EQ(same.status, 0) << name << same.out;
  }
}

TEST(Instances, ShareTheirMemory) {
  const TemporaryFolder folder;
  const std::string script =
      "set o [SippTorus 1 0.4 40 25 [SippShaderBasic 0.3 0.5 0.2 {0.8 0.5 0.2}]]\n"
      "loop i 0 $n {\n  set c [SippObjectInstance $o]\n  SippObjectMove $c [list $i 0 0]\n"
      "  SippObjectAddSubobj WORLD $c\n  SippObjectUnref $c\n}\nSippRender [SippPixMapCreate] 64 64\n";
  write_file(folder / "a.sipp", script);
  const auto memory = [&](const std::string& n) {
    const Outcome run =
        must(folder, "farop info a.sipp --script-memory 64 --define n=" + n + " --stats s.json");
    EXPECT_NE(run.out.find("polygons      " + n + "000\n"), std::string::npos) << run.out;
    std::smatch m;
    const std::string stats = read_file(folder / "s.json");
    EXPECT_TRUE(std::regex_search(stats, m, std::regex("\"memory_bytes\": *([0-9]+)")));
    return std::stod(m[1]);
  };
  const double one = memory("1"), many = memory("10000");
  // As the page says; without sharing the polygons would be 800 MB.
  const std::string page = read_file(k_source / "docs/formats/sipp.md");
  std::smatch said;
  ASSERT_TRUE(std::regex_search(page, said, std::regex("([0-9]+) kB of polygons, ([0-9.]+) MB of tree")));
  EXPECT_NEAR(one / 1e3, std::stod(said[1]), 5);
  EXPECT_NEAR((many - one) / 1e6, std::stod(said[2]), 0.3);
}

// ---- what the pages promise ----

std::string tcl_blocks(const fs::path& page) {
  const std::string text = read_file(page);
  std::string script;
  for (std::size_t at = text.find("```tcl\n"); at != std::string::npos; at = text.find("```tcl\n", at)) {
    at += 7;
    const std::size_t end = text.find("```", at);
    script += text.substr(at, end - at);
    at = end + 3;
  }
  return script;
}

TEST(LanguagePage, ExamplesRunAndPrintWhatTheySay) {
  const TemporaryFolder folder;
  const std::string script = tcl_blocks(k_source / "docs/formats/sipp.md");
  write_file(folder / "page.sipp", script);
  // The file that the page shows.
  const std::string page = read_file(k_source / "docs/formats/sipp.md");
  const std::size_t file = page.find("vase.bez:\n\n```\n");
  ASSERT_NE(file, std::string::npos);
  const std::size_t first = page.find("bezier", file);
  write_file(folder / "vase.bez", page.substr(first, page.find("```", first) - first));
  const Outcome run = must(folder, "farop render page.sipp -o page.ppm --verbose");
  std::string promised, printed;
  std::istringstream lines(script), log(run.err);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("# prints: ")) promised += line.substr(10) + "\n";
  }
  for (std::string line; std::getline(log, line);) {
    if (line.starts_with("script: ")) printed += line.substr(8) + "\n";
  }
  EXPECT_EQ(printed, promised);
  EXPECT_GE(count(promised, "\n"), 10);
}

TEST(LanguagePage, DescribesAndUsesEveryCommand) {
  const TemporaryFolder folder;
  write_file(folder / "list.sipp", "foreach c [lsort [info commands Sipp*]] {puts $c}\n");
  const std::string page = read_file(k_source / "docs/formats/sipp.md");
  const std::string script = tcl_blocks(k_source / "docs/formats/sipp.md");
  std::istringstream log(must(folder, "farop info list.sipp --verbose").err);
  int commands = 0;
  for (std::string line; std::getline(log, line);) {
    if (!line.starts_with("script: Sipp")) continue;
    ++commands;
    std::string name = line.substr(8);
    const bool axis = name.ends_with("RotateX") || name.ends_with("RotateY") || name.ends_with("RotateZ");
    const std::string described = axis ? name.substr(0, name.size() - 1) + "X|Y|Z" : name;
    const std::string escaped = axis ? name.substr(0, name.size() - 1) + "X\\|Y\\|Z" : name;
    EXPECT_TRUE(page.find(described) != std::string::npos || page.find(escaped) != std::string::npos) << name;
    EXPECT_TRUE(std::regex_search(script, std::regex(name + "[ \\]\n}]"))) << name << " has no example";
  }
  EXPECT_GT(commands, 100);
}

TEST(LanguagePage, SaysTheErrorThatItShows) {
  const std::string page = read_file(k_source / "docs/formats/sipp.md");
  EXPECT_NE(
      page.find(
          "parts/leg.tcl:3:22: error: SippCylinder: 'thick' found for the length, expected a finite number"),
      std::string::npos);
}

TEST(Tutorial, EndsInItsPicture) {
  const TemporaryFolder folder;
  write_file(folder / "windmill.sipp", tcl_blocks(k_source / "docs/tutorial-sipp.md"));
  must(folder, "farop render windmill.sipp -o windmill.png --strict");
  const Outcome run =
      shell(folder, "farop compare windmill.png '" + (k_source / "docs/images/windmill.png").string() +
                        "' --fail 0.005 --failpercent 0.05");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  must(folder,
       "farop info windmill.sipp; farop render windmill.sipp -o wire.png --mode line;"
       "farop render windmill.sipp --define angle=45 -o turn-45.png -q;"
       "farop convert windmill.sipp -o windmill.nff; farop export windmill.sipp -o windmill.scr");
  EXPECT_NE(read_file(folder / "turn-45.png"), read_file(folder / "windmill.png"));
}

TEST(Beziers, ComeFromFilesBesideTheScript) {
  const TemporaryFolder folder;
  write_file(folder / "vase.bez",
             "bezier_curves: vertices: 4 vertex_list: 1 0 2  2 0 1  1 0 0.5  1 0 0\ncurves: 1 curve_list: 1 "
             "2 3 4\n");
  write_file(folder / "a.sipp",
             "SippObjectAddSubobj WORLD [SippBezierFile vase.bez 4 [SippShaderBasic 0 0 1 {1 1 1}]]\n");
  EXPECT_NE(must(folder, "farop info a.sipp").out.find("polygons      64\n"), std::string::npos);
  write_file(folder / "vase.bez", "bezier_curves: vertices: 1 vertex_list: 1 0\n");
  const Outcome run = shell(folder, "farop info a.sipp");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("vase.bez:2:1: "), std::string::npos) << run.err;
}

}  // namespace
}  // namespace farop::test
