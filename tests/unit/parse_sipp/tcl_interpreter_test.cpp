// SPDX-License-Identifier: GPL-3.0-or-later
// Tcl as scripts meet it: what of Extended Tcl is there, limits, files, and the way of the scene between
// processes.
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <filesystem>

#include "parse_sipp/scene_stream.h"
#include "parse_sipp/script_shader.h"
#include "parse_sipp/sipp_shapes.h"
#include "scene/merge.h"
#include "support/shell.h"
#include "unit/parse_sipp/script_scene.h"

namespace farop::test {
namespace {

using Lines = std::vector<std::string>;

// ---- Extended Tcl ----

TEST(TclxHelpers, Loop) {
  EXPECT_EQ(
      prints("loop i 0 3 {puts $i}\nloop i 3 0 -2 {puts $i}\nset n 2\nloop i $n $n+2 {puts $i}\nputs $i\n"
             "loop i 0 9 {if {$i == 1} continue; if {$i == 3} break; puts b$i}\n"
             "proc f {} {loop i 0 5 {if {$i == 2} {return r$i}}}\nputs [f]\n"),
      (Lines{"0", "1", "2", "3", "1", "2", "3", "4", "b0", "b2", "r2"}));
}

TEST(TclxHelpers, Lists) {
  EXPECT_EQ(
      prints(
          "puts [lempty {}][lempty { }][lempty {a}]\nset l {a b c}\nputs [lvarpop l]\nputs [lvarpop l 1 z]\n"
          "puts $l\nlvarpush l q\nputs $l\nputs [cindex abc 1][crange abcdef 2 end][clength abc]\n"
          "puts [cexpand {a\\tb $c [d]}]\n"),
      (Lines{"110", "a", "c", "b z", "q b z", "bcdef3", "a?b $c [d]"}));
}

TEST(TclxHelpers, Numbers) {
  EXPECT_EQ(
      prints("puts [min 3 1 2]\nputs [max 3 4.5 2]\nputs [sqrt 16]\nputs [expr {max(1, 7, 3) + min(2, 1)}]\n"
             "puts [pow 2 10]\nset x 0\nputs [cos $x]\nputs [round 2.6]\necho a b c\n"),
      (Lines{"1", "4.5", "4.0", "8", "1024.0", "1.0", "3", "a b c"}));
  const Lines first = prints("loop i 0 5 {puts [random 1000]}\n");
  EXPECT_EQ(first, prints("loop i 0 5 {puts [random 1000]}\n"));  // the same in every run
  EXPECT_NE(first, prints("random seed 7\nloop i 0 5 {puts [random 1000]}\n"));
}

TEST(TclxHelpers, KeyedLists) {
  EXPECT_EQ(
      prints("keylset k name robot leg.left 3 leg.right 4\nputs $k\nputs [keylget k leg.right]\n"
             "puts [keylget k arm x]\nputs [keylget k name x]$x\nputs [keylkeys k]\nputs [keylkeys k leg]\n"
             "keyldel k leg.left\nputs $k\nkeyldel k leg.right\nputs $k\nputs [catch {keylget k leg}]\n"),
      (Lines{"{name robot} {leg {{left 3} {right 4}}}", "4", "0", "1robot", "name leg", "left right",
             "{name robot} {leg {{right 4}}}", "{name robot}", "1"}));
}

TEST(TclLanguage, IsThereWithoutTheRest) {
  EXPECT_EQ(
      prints("dict set d a 1\nputs [dict get $d a]\nputs [lmap x {1 2} {expr {$x * 2}}]\nputs [regexp {b+} "
             "abbc m]$m\n"
             "namespace eval n {variable v 5}\nputs $n::v\nputs [string map {a b} aa]\nputs [format %.3f 2]\n"
             "puts [package require Tclx]\nputs [file join a b c.tcl][file extension x/y.z][file tail "
             "x/y.z][file dirname x/y.z]\n"
             "puts <$argc$argv>\nputs -nonewline x\nputs stderr y\n"),
      (Lines{"1", "2 4", "1bb", "5", "bb", "2.000", "3.1", "a/b/c.tcl.zy.zx", "<0>", "xy"}));
}

TEST(TclLanguage, PrintsAreBoundedAndHarmless) {
  const ScriptRun run =
      run_script("puts \"\\033\\[31m bell \\a\"\nloop i 0 5000 {puts [string repeat x 400]}\n");
  ASSERT_TRUE(run.scene) << run.error();
  EXPECT_EQ(run.printed.at(0), "?[31m bell ?");
  std::size_t bytes = 0;
  for (const std::string& line : run.printed) bytes += line.size() + 1;
  EXPECT_LT(bytes, k_max_script_output + 200);
  EXPECT_NE(run.printed.back().find("the rest is left out"), std::string::npos);
}

// ---- limits ----

double seconds_of(const std::string& text, const SippOptions& options, ScriptRun& run) {
  const auto start = std::chrono::steady_clock::now();
  run = run_script(text, options);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(TclLimits, OfTimeAreKept) {
  SippOptions options;
  options.limits.seconds = 0.3;
  ScriptRun run;
  EXPECT_LT(seconds_of("while 1 {catch {while 1 {}}}\n", options, run), 3);
  EXPECT_NE(run.error().find("runs longer than 0.3 seconds"), std::string::npos) << run.error();
  EXPECT_NE(run.error().find("--script-time"), std::string::npos);
}

TEST(TclLimits, AreExact) {
  SippOptions options;
  options.limits.polygons = 12;
  const std::string cube = "SippObjectAddSubobj WORLD [SippCube 1 [SippShaderBasic 0 0 1 {1 1 1}]]\n";
  EXPECT_TRUE(run_script(cube + cube, options).scene);
  EXPECT_NE(run_script(cube + cube + cube, options).error().find("of 12, 12 are made already"),
            std::string::npos);
  // Drawn, as opposed to made:
  const std::string twice =
      "set c [SippCube 1 [SippShaderBasic 0 0 1 {1 1 1}]]\nSippObjectAddSubobj WORLD [list $c $c]\n";
  EXPECT_TRUE(run_script(twice, options).scene);
  EXPECT_NE(run_script(twice + "SippObjectAddSubobj WORLD $c\n", options)
                .error()
                .find("has 18 polygons, at most 12"),
            std::string::npos);
}

TEST(TclLimits, LeaveTheNextScriptAlone) {
  SippOptions options;
  options.limits.memory_mb = 100;
  EXPECT_FALSE(run_script("while 1 {append s xxxxxxxxxxxxxxxxxxxxxxxxxxx}\n", options).scene);
  EXPECT_TRUE(run_script("puts ok\n", options).scene);
}

TEST(TclVariables, AreSetBeforeTheScriptStarts) {
  SippOptions options;
  options.variables = {{"frame", "12"}, {"odd", "[exec ls] $x {"}};
  const ScriptRun run = run_script("puts $frame\nputs $odd\n", options);
  EXPECT_EQ(run.printed, (Lines{"12", "[exec ls] $x {"}));
  EXPECT_TRUE(is_variable_name("a_1"));
  for (const char* wrong : {"", "1a", "a b", "a(b)", "::x", "a$"})
    EXPECT_FALSE(is_variable_name(wrong)) << wrong;
}

// ---- files ----

TEST(TclFiles, AreThoseBelowTheFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "scene/parts");
  write_file(folder / "scene/parts/a.tcl",
             "proc hello {} {puts \"hello [file tail [info script]]\"}\nset result 5\n");
  write_file(folder / "scene/main.sipp",
             "puts [source parts/a.tcl]\nhello\ninclude [file join [file dirname [info script]] parts "
             "a.tcl]\nputs done\n");
  DiagnosticList messages;
  SippOptions options;
  Lines printed;
  options.log = [&](const std::string& line) { printed.push_back(line); };
  ASSERT_TRUE(parse_sipp((folder / "scene/main.sipp").string(), messages, options))
      << messages.items.back().message;
  EXPECT_EQ(printed, (Lines{"5", "hello main.sipp", "done"}));
}

TEST(TclFiles, WithoutAFolderThereAreNone) {
  EXPECT_NE(run_script("source /etc/hosts\n").error().find("no folder to read files from"),
            std::string::npos);
}

// ---- the way between processes ----

TEST(SceneStream, UnguardedAndGuardedRunsGiveTheSameScene) {
  const std::string text =
      "set s [SippShaderBozo {{1 0 0} {0 1 0}} .1 .2 .3 4]\nset t [SippTeapot 3 [SippShaderBumpy $s 2 "
      "HOLES]]\n"
      "SippObjectAddSubobj WORLD [list $t $t [SippCube 2 $s]]\nSippLightSourceCreate {1 2 3} {1 1 1}\n"
      "SippRender [SippPixMapCreate] 20 30 GOURAUD 3\n";
  const ScriptRun run = run_script(text);
  DiagnosticList messages;
  const std::optional<Scene> here = parse_sipp_unguarded(text, "test.sipp", messages, {});
  ASSERT_TRUE(run.scene && here) << run.error();
  EXPECT_TRUE(same_content(*run.scene, *here));
  EXPECT_EQ(run.scene->drawing, here->drawing);
  EXPECT_EQ(run.scene->inputs.at(0).bytes, text.size());
}

std::string sent(const Scene& scene) {
  std::string bytes;
  sipp::write_scene(
      scene, [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); });
  return bytes;
}

Scene received(const std::string& bytes) {
  std::size_t at = 0;
  return sipp::read_scene(
      [&](void* data, std::size_t size) {
        if (size > bytes.size() - at) throw std::runtime_error("the end");
        std::memcpy(data, bytes.data() + at, size);
        at += size;
      },
      1 << 20);
}

Scene small_scene() {
  Scene scene;
  sipp::ShapeLook look;
  look.shader = std::make_shared<sipp::ScriptShader>(
      sipp::ShaderSpec(PhongParameters{.1, .2, .3, 4, {1, 0, 0}, {1, 1, 1}}));
  scene.root.children.push_back(sipp::cone(1, .5, 2, 5, look));
  scene.lights.emplace_back();
  scene.view.from = V3d(1, 2, 3);
  scene.view.fit = Fit::smaller;
  scene.inputs.push_back({"a", "sipp", 1, 2, 3, 0, 0, 0, 1});
  return scene;
}

TEST(SceneStream, EveryPrefixIsRefused) {
  const std::string bytes = sent(small_scene());
  EXPECT_EQ(received(bytes).root.children.size(), 1u);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(received(bytes.substr(0, size)), std::runtime_error) << size;
  }
}

TEST(SceneStream, WrongBytesNeverCrashOrAskForMuchMemory) {
  const std::string bytes = sent(small_scene());
  int refused = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int change : {1, 0x80, 0xFF}) {
      std::string wrong = bytes;
      wrong[at] = static_cast<char>(wrong[at] ^ change);
      try {
        const Scene scene = received(wrong);
        for (const auto& object : scene.root.children) {
          for (const auto& surface : object->surfaces) {
            for (const PolygonView polygon : surface->polygons) {
              for (const std::uint32_t corner : polygon.corners) ASSERT_LT(corner, surface->positions.size());
            }
          }
        }
      } catch (const std::runtime_error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace farop::test
