// SPDX-License-Identifier: GPL-3.0-or-later
// Every command as a user runs it: what it writes, what it says, and that its paths agree with each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/shell.h"

namespace farop::test {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> k_commands = {"render", "export",     "raster",  "convert", "spd",
                                             "info",   "compare",    "plugins", "doctor",  "table",
                                             "new",    "completion", "check",   "bench"};

Outcome must(const TemporaryFolder& folder, const std::string& command) {
  const Outcome run = shell(folder, command);
  EXPECT_EQ(run.status, 0) << command << "\n" << run.err;
  return run;
}

TEST(Help, OfEveryCommandFitsAScreenAndGroupsItsOptions) {
  const TemporaryFolder folder;
  std::vector<std::string> pages = k_commands;
  pages.emplace_back();
  for (const std::string& command : pages) {
    const Outcome run = must(folder, "farop " + command + " --help");
    EXPECT_TRUE(run.err.empty());
    EXPECT_LE(std::count(run.out.begin(), run.out.end(), '\n'), 60) << command;
    std::istringstream lines(run.out);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), 110u) << command << ": " << line;
    EXPECT_NE(run.out.find(command.empty() ? "First steps" : "Examples"), std::string::npos) << command;
  }
}

TEST(Help, ExamplesOfEveryCommandWork) {
  const TemporaryFolder folder;
  must(folder,
       "farop spd gears --size 1 -o gears.nff; farop spd teapot --size 2 -o pot.nff; farop spd hollow-cube "
       "-o cube.nff");
  must(folder,
       "farop export gears.nff -o gears.scr; farop render gears.nff -o mine.ppm; cp mine.ppm theirs.ppm");
  int examples = 0;
  for (const std::string& command : k_commands) {
    const std::string help = must(folder, "farop " + command + " --help").out;
    std::istringstream lines(help.substr(help.find("\nExamples\n") + 10));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("      ")) continue;  // the meaning
      must(folder, line);
      ++examples;
    }
  }
  EXPECT_EQ(examples, 28);
}

TEST(Trace, HasASliceOfEveryStageInsideTheWholeRun) {
  const TemporaryFolder folder;
  must(folder, "farop spd gears -q | farop render - -o g.ppm -q --trace t.json");
  const Json trace = Json::parse(read_file(folder / "t.json"));
  EXPECT_EQ(trace["otherData"]["slices_left_out"], 0);
  std::map<std::string, int> slices;
  double end = 0, total = 0, inside = 0;
  for (const Json& event : trace["traceEvents"]) {
    if (event["ph"] != "X") continue;
    ++slices[event["name"]];
    const double duration = event["dur"];
    EXPECT_GE(event["ts"].get<double>(), 0);
    end = std::max(end, event["ts"].get<double>() + duration);
    (event["name"] == "total" ? total : inside) += duration;
  }
  EXPECT_EQ(slices["total"], 1);
  EXPECT_EQ(slices["parse"], 1);
  EXPECT_GT(slices["geometry"], 2);  // batch by batch
  EXPECT_GT(slices["rasterize"], 2);
  EXPECT_LE(inside, total + 1);  // stages do not overlap; microseconds
  EXPECT_LE(end, total + 1);
}

TEST(Manual, ListsEveryCommandAndIsCleanRoff) {
  const TemporaryFolder folder;
  const std::string page = must(folder, "farop man > farop.1; cat farop.1").out;
  for (const std::string command : {"render", "export", "raster", "convert", "spd", "info", "compare"}) {
    EXPECT_NE(page.find(".SS " + command), std::string::npos);
  }
  if (shell(folder, "command -v groff").status != 0) GTEST_SKIP() << "groff is not installed";
  const Outcome groff = must(folder, "groff -man -Tascii -P-cbou -wall farop.1");
  EXPECT_TRUE(groff.err.empty()) << groff.err;
  EXPECT_NE(groff.out.find("EXIT STATUS"), std::string::npos);
}

TEST(Completion, BashCompletesCommandsOptionsChoicesAndScenes) {
  const TemporaryFolder folder;
  const auto complete = [&](const std::string& words) {
    return must(folder, "source <(farop completion bash); COMP_WORDS=(" + words +
                            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _farop; echo \"${COMPREPLY[*]}\"")
        .out;
  };
  EXPECT_EQ(complete("farop ren"), "render\n");
  EXPECT_EQ(complete("farop render --sam"), "--samples\n");
  EXPECT_EQ(complete("farop render --mode ph"), "phong\n");
  EXPECT_EQ(complete("farop spd tea"), "teapot\n");
}

TEST(Completion, ZshAndFishScriptsParse) {
  const TemporaryFolder folder;
  must(folder, "farop completion zsh > _farop; farop completion fish > farop.fish");
  EXPECT_NE(read_file(folder / "_farop").find("#compdef farop"), std::string::npos);
  EXPECT_NE(read_file(folder / "farop.fish").find("-l samples"), std::string::npos);
  for (const std::string shell_name : {"zsh", "fish"}) {
    if (shell(folder, "command -v " + shell_name).status != 0) continue;
    must(folder, shell_name + " -n " + (shell_name == "zsh" ? "_farop" : "farop.fish"));
  }
}

TEST(Version, IsPrinted) {
  const TemporaryFolder folder;
  int major = -1, minor = -1, patch = -1;
  const std::string text = must(folder, "farop --version").out;
  EXPECT_EQ(std::sscanf(text.c_str(), "farop %d.%d.%d", &major, &minor, &patch), 3) << text;
}

TEST(Spd, ListsSixteenScenes) {
  const TemporaryFolder folder;
  const std::string list = must(folder, "farop spd --list").out;
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 16);
  EXPECT_NE(list.find("9345 polygons"), std::string::npos);
}

TEST(Spd, TessellateTakesAnOptionalResolution) {
  const TemporaryFolder folder;
  const auto patches = [&](const std::string& options) {
    const std::string text = must(folder, "farop spd balls --size 1 " + options).out;
    std::size_t n = 0;
    for (std::size_t at = text.find("\npp "); at != std::string::npos; at = text.find("\npp ", at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(patches(""), 0u);
  EXPECT_EQ(patches("--tessellate"), 1080u);
  EXPECT_EQ(patches("--tessellate 2"), 480u);
  EXPECT_EQ(patches("--tessellate=1"), 120u);
}

// The two ways to a picture must agree to the last bit: straight, and by the flat file.
TEST(Render, EqualsThePictureOfTheFlatFile) {
  const TemporaryFolder folder;
  for (const std::string scene : {"teapot --size 4", "tetra --size 4", "sombrero"}) {
    must(folder, "farop spd " + scene + " -o s.nff");
    for (const std::string mode : {"line", "flat", "gouraud"}) {
      const std::string flat = mode == "flat" ? " --mode flat" : "";
      must(folder, "farop export s.nff -o s.scr --resolution 300 200 4096 256" + flat);
      must(folder, "farop raster s.scr -o a.ppm --background 0.078 0.361 0.753 --mode " + mode);
      must(folder,
           "farop render s.nff -o b.ppm --subpixel-bits 0 --resolution 300 200 4096 256 --mode " + mode);
      EXPECT_EQ(read_file(folder / "a.ppm"), read_file(folder / "b.ppm")) << scene << " " << mode;
    }
  }
}

TEST(Render, AFlatFileWithRowsFromTheTopGivesTheSamePicture) {
  const TemporaryFolder folder;
  must(folder,
       "farop spd tetra --size 3 -o s.nff; farop export s.nff -o up.scr; farop export s.nff -o down.scr "
       "--y-down");
  must(folder, "farop raster up.scr -o up.ppm; farop raster down.scr -o down.ppm --y-down");
  EXPECT_NE(read_file(folder / "up.scr"), read_file(folder / "down.scr"));
  EXPECT_EQ(read_file(folder / "up.ppm"), read_file(folder / "down.ppm"));
}

TEST(Render, DrawsTheSamePictureOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  must(folder, "farop spd gears --size 2 -q -o g.nff");
  for (const std::string mode : {"flat", "gouraud", "phong"}) {
    const std::string draw = "farop render g.nff --resolution 300x200 --mode " + mode;
    must(folder,
         draw + " -o 1.ppm --threads 1 && " + draw + " -o 3.ppm --threads 3 && " + draw + " -o all.ppm");
    must(folder, "cmp 1.ppm 3.ppm && cmp 1.ppm all.ppm");
  }
  EXPECT_EQ(shell(folder, "farop render g.nff -o 0.ppm --threads 0").status, 2);
}

TEST(Render, SamplesAreMeansOfTheLargerPicture) {
  const TemporaryFolder folder;
  must(folder, "farop spd balls --size 1 -o s.nff");
  for (const int samples : {2, 3, 4}) {
    const std::string large = std::to_string(60 * samples) + "x" + std::to_string(40 * samples);
    must(folder,
         "farop render s.nff -o a.ppm --detail 4 --resolution 60x40 --samples " + std::to_string(samples));
    must(folder, "farop render s.nff -o b.ppm --detail 4 --resolution " + large);
    const std::string a = read_file(folder / "a.ppm"), b = read_file(folder / "b.ppm");
    const std::size_t head_a = a.find("255\n") + 4, head_b = b.find("255\n") + 4;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) {
        for (int c = 0; c < 3; ++c) {
          int sum = 0;
          for (int j = 0; j < samples; ++j) {
            for (int i = 0; i < samples; ++i) {
              const int at = ((y * samples + j) * 60 * samples + x * samples + i) * 3 + c;
              sum += static_cast<unsigned char>(b[head_b + static_cast<std::size_t>(at)]);
            }
          }
          const int n = samples * samples;
          const int got =
              static_cast<unsigned char>(a[head_a + static_cast<std::size_t>((y * 60 + x) * 3 + c)]);
          ASSERT_EQ(got, (2 * sum + n) / (2 * n)) << samples << " samples, pixel " << x << " " << y;
        }
      }
    }
  }
}

TEST(Render, YDownDoesNotChangeItsPictures) {
  const TemporaryFolder folder;
  must(
      folder,
      "farop spd gears --size 1 -o s.nff; farop render s.nff -o a.ppm; farop render s.nff -o b.ppm --y-down");
  EXPECT_EQ(read_file(folder / "a.ppm"), read_file(folder / "b.ppm"));
}

TEST(Render, NamesItsOutputAfterTheInput) {
  const TemporaryFolder folder;
  const Outcome run = must(
      folder, "farop spd tetra --size 2 -o t.nff; mkdir sub; cp t.nff sub/u.nff; farop render sub/u.nff");
  EXPECT_TRUE(std::filesystem::exists(folder / "u.ppm"));
  EXPECT_NE(run.err.find("u.ppm"), std::string::npos) << run.err;
}

TEST(Render, OptionsOverrideTheScene) {
  const TemporaryFolder folder;
  must(folder, "farop spd tetra --size 2 -o t.nff");
  must(folder,
       "farop render t.nff -o a.ppm --from 3,0,0 --at 0 0 0 --up 0 0 1 --angle 60 --hither 0.5 --yon 9 --fit "
       "smaller "
       "--background 1 0 0 --resolution 40x30 --stats s.json");
  const Json v = Json::parse(read_file(folder / "s.json")).at("view");
  EXPECT_EQ(v.at("from"), Json({3, 0, 0}));
  EXPECT_EQ(v.at("angle"), 60);
  EXPECT_EQ(v.at("hither"), 0.5);
  EXPECT_EQ(v.at("yon"), 9);
  EXPECT_EQ(v.at("fit"), "smaller");
  EXPECT_EQ(v.at("resolution"), Json({40, 30, 16777216, 256}));
  const std::string ppm = read_file(folder / "a.ppm");
  EXPECT_EQ(ppm.substr(ppm.find("255\n") + 4, 3), std::string("\xFF\0\0", 3));
}

TEST(Render, ResolutionMayStandBeforeAnInput) {
  const TemporaryFolder folder;
  must(folder, "farop spd tetra --size 2 -o t.nff; farop export --resolution 64 48 512 128 t.nff -o t.scr");
  EXPECT_EQ(read_file(folder / "t.scr").substr(0, 14), "64 48 512 128\n");
}

TEST(Render, OptionsComeFromTheEnvironmentAndFromAFileToo) {
  const TemporaryFolder folder;
  must(folder, "farop spd tetra --size 2 -o t.nff; FAROP_RESOLUTION=31x21 farop render t.nff -o a.ppm");
  EXPECT_EQ(read_file(folder / "a.ppm").substr(0, 9), "P6\n31 21\n");
  must(folder,
       "printf '[render]\\nresolution=\"33x22\"\\n' > c.toml; farop --config c.toml render t.nff -o a.ppm");
  EXPECT_EQ(read_file(folder / "a.ppm").substr(0, 9), "P6\n33 22\n");
}

TEST(Render, DepthKeepsTheIntegerZAndZresWhereNothingIs) {
  const TemporaryFolder folder;
  must(folder,
       "farop spd tetra --size 2 -o t.nff; farop render t.nff -o a.ppm --depth z.tif --resolution 32 32 1000 "
       "256");
  if (shell(folder, "command -v oiiotool").status != 0) GTEST_SKIP() << "oiiotool is not installed";
  const std::string text = must(folder, "oiiotool --stats z.tif").out;
  EXPECT_NE(text.find("Stats Max: 1000.0"), std::string::npos) << text;
}

TEST(Render, MergesInputsAndSaysWhoseViewCounts) {
  const TemporaryFolder folder;
  must(folder, "farop spd tetra --size 2 -o t.nff; farop spd gears --size 1 -o g.nff");
  const Outcome run = must(folder, "farop render t.nff g.nff -o a.ppm --stats s.json");
  EXPECT_NE(run.err.find("g.nff: warning: overrides from, at, up"), std::string::npos) << run.err;
  const Json s = Json::parse(read_file(folder / "s.json"));
  EXPECT_EQ(s.at("scene").at("objects"), 2);
  EXPECT_EQ(s.at("polygons").at("loaded"), 16 + 147);
  EXPECT_EQ(s.at("view").at("from"), Json({-1.1, -2.1, 2.6}));
}

TEST(Render, SaysWhenItAddsALight) {
  const TemporaryFolder folder;
  must(folder, "farop spd tetra --size 2 | grep -v '^l' > t.nff");
  const Outcome run = must(folder, "farop render t.nff -o a.ppm");
  EXPECT_NE(run.err.find("no light"), std::string::npos) << run.err;
}

TEST(Render, TwoRunsGiveTheSameBytes) {
  const TemporaryFolder folder;
  for (const std::string suffix : {"ppm", "png", "exr", "tif"}) {
    must(folder, "farop spd mount --size 3 | farop render - -o a." + suffix);
    must(folder, "sleep 1.1; farop spd mount --size 3 | farop render - -o b." + suffix);
    EXPECT_EQ(read_file(folder / ("a." + suffix)), read_file(folder / ("b." + suffix))) << suffix;
  }
}

TEST(Verbose, SpeaksTheWordsOf1997) {
  const TemporaryFolder folder;
  const std::string log = must(folder, "farop spd gears --size 1 | farop render - -o a.ppm --verbose").err;
  std::size_t at = 0;
  for (const std::string word :
       {"Parsing NFF file", "NFF background loaded", "NFF view parameters loaded",
        "NFF light loaded (2.00 4.00 4.00) (1.00 1.00 1.00)",
        "NFF surface with 1 polygons (0.30,0.60,0.30,3.0827,1.00,0.85,0.70)", "NFF surface with 146 polygons",
        "Imported 2 surfaces with 147 polygons, 0 spheres and 0 cones.", "NFF parser done",
        "Hither:1.00, Yon:", "Objects loaded: 1", "Surfaces loaded: 2", "Polygons loaded: 147",
        "Polygons backfacing: 84", "Polygons totally clipped: 0", "Polygons splited to triangles: 0",
        "Polygons rendered: 63"}) {
    const std::size_t found = log.find(word, at);
    EXPECT_NE(found, std::string::npos) << word << "\n" << log;
    if (found != std::string::npos) at = found;
  }
}

TEST(Quiet, SaysNothingWhenAllIsWell) {
  const TemporaryFolder folder;
  const Outcome run = must(folder, "farop spd gears --size 1 | farop render - -o a.ppm --quiet");
  EXPECT_EQ(run.err + run.out, "");
}

TEST(Convert, RoundTripsAndKeepsCounts) {
  const TemporaryFolder folder;
  must(folder, "farop spd sample -o s.nff");
  must(folder,
       "farop convert s.nff -o a.nff --detail 3; farop convert a.nff -o b.nff; farop convert b.nff -o c.nff");
  EXPECT_EQ(read_file(folder / "b.nff"), read_file(folder / "c.nff"));
  must(folder, "farop export s.nff -o s.scr --detail 3; farop export a.nff -o a.scr");
  EXPECT_EQ(read_file(folder / "s.scr"), read_file(folder / "a.scr"));
}

TEST(Convert, TrianglesOnly) {
  const TemporaryFolder folder;
  must(folder,
       "farop spd gears --size 1 | farop convert - -o t.nff --triangles; farop info t.nff --stats s.json");
  // Two 144-gons, 144 quadrilaterals, the ground.
  EXPECT_EQ(Json::parse(read_file(folder / "s.json")).at("polygons").at("loaded"), 2 * 142 + 144 * 2 + 2);
  const std::string text = read_file(folder / "t.nff");
  EXPECT_EQ(text.find("\np 4"), std::string::npos);
  EXPECT_EQ(text.find("\np 144"), std::string::npos);
}

TEST(Info, ShowsCountsViewLightsAndTheTree) {
  const TemporaryFolder folder;
  const std::string out = must(folder, "farop spd mount --size 2 | farop info - --verbose").out;
  for (const std::string word :
       {"polygons      32", "from        -1.6 1.6 1.7", "angle       45 degrees",
        "light         -100 -100 100", "4 spheres", "bounds", "background  0.078 0.361 0.753"}) {
    EXPECT_NE(out.find(word), std::string::npos) << word << "\n" << out;
  }
}

TEST(Compare, PassesForEqualPicturesAndFailsWithNumbersForDifferentOnes) {
  const TemporaryFolder folder;
  must(folder,
       "farop spd tetra --size 2 -o t.nff; farop render t.nff -o a.ppm; farop render t.nff -o b.ppm --mode "
       "flat");
  EXPECT_NE(must(folder, "farop compare a.ppm a.ppm").out.find("PASS"), std::string::npos);
  const Outcome run = shell(folder, "farop compare a.ppm b.ppm -o d.png");
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("FAILURE"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "d.png"));
  EXPECT_EQ(shell(folder, "farop compare a.ppm b.ppm --fail 1").status, 0);
  EXPECT_EQ(shell(folder, "farop compare a.ppm b.ppm --failpercent 100").status, 0);
}

TEST(Progress, AppearsOnlyOnATerminal) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      must(folder, "farop spd tetra --size 9 | farop render - -o a.ppm --rasterizer internal").err.find('\r'),
      std::string::npos);
}

}  // namespace
}  // namespace farop::test
