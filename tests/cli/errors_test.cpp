// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong command lines, wrong inputs, hostile surroundings: one clear message, the right exit status, nothing
// broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/shell.h"

namespace farop::test {
namespace {

namespace fs = std::filesystem;

struct Case {
  std::string name;
  std::string
      command;  ///< run in a folder that holds t.nff, t.scr and old.ppm, old.scr, old.nff with the text "old"
  int status;
  std::string message;  ///< must be part of standard error
};

const Case k_cases[] = {
    // The command line: 2
    {"NoCommand", "farop", 2, "subcommand"},
    {"UnknownCommand", "farop rendr t.nff", 2, "unknown command 'rendr'"},
    {"UnknownCommandSuggests", "farop rendr t.nff", 2, "did you mean 'render'?"},
    {"UnknownOption", "farop render t.nff --sampels 4", 2, "unknown option '--sampels'"},
    {"UnknownOptionSuggests", "farop render t.nff --sampels 4", 2, "did you mean '--samples'?"},
    {"NoInput", "farop render", 2, "input is required"},
    {"SamplesOutOfRange", "farop render t.nff --samples 0", 2, "--samples"},
    {"ModeUnknown", "farop render t.nff --mode toon", 2, "--mode"},
    {"PhongForAFlatFile", "farop export t.nff --mode phong", 2, "--mode"},
    {"PhongForAFlatPicture", "farop raster t.scr --mode phong", 2, "--mode"},
    {"ResolutionZero", "farop render t.nff --resolution 0x10", 2, "XRES = 0 is out of range"},
    {"ResolutionTooLarge", "farop render t.nff --resolution 40000x10", 2, "expected 1..32767"},
    {"ResolutionWord", "farop render t.nff --resolution big", 2, "'big' is not a whole number"},
    {"ResolutionDepth", "farop export t.nff --resolution 10 10 1 256", 2, "ZRES = 1 is out of range"},
    {"ResolutionColours", "farop export t.nff --resolution 10 10 100 65537", 2, "CRES = 65537"},
    {"FromIncomplete", "farop render t.nff --from 1 2", 2, "--from"},
    {"AngleFlat", "farop render t.nff --angle 180", 2, "--angle"},
    {"HitherNegative", "farop render t.nff --hither -1", 2, "--hither"},
    {"YonWord", "farop render t.nff --yon far", 2, "'far' found, expected a distance"},
    {"DetailNegative", "farop render t.nff --detail -2", 2, "--detail"},
    {"LightIntensityWord", "farop render t.nff --light-intensity dim", 2, "--light-intensity"},
    {"NullWithPicture", "farop render t.nff --rasterizer null -o a.ppm", 2, "draws nothing"},
    {"PictureSuffixUnknown", "farop render t.nff -o a.xyz", 2, "a.xyz"},
    {"DepthSuffix", "farop render t.nff -o a.ppm --depth z.png", 2, "z.png"},
    {"OutputIsInput", "farop convert t.nff -o ./t.nff", 2, "one of the inputs"},
    {"ConvertNeedsOutput", "farop convert t.nff", 2, "--output is required"},
    {"StdinHasNoName", "farop render - < t.nff", 2, "say where to write"},
    {"StdinTwice", "farop convert - - -o a.nff < t.nff", 2, "given twice"},
    {"SuffixTellsNothing", "cp t.nff t.txt; farop render t.txt", 2, "expected .nff"},
    {"SpdUnknown", "farop spd teapott", 2, "did you mean 'teapot'?"},
    {"SpdSizeZero", "farop spd gears --size 0", 2, "size"},
    {"SpdSizeHuge", "farop spd tetra --size 2000000000", 2, "size"},
    {"SpdNothing", "farop spd", 2, "no scene named"},
    {"CompareOnePicture", "farop compare old.ppm", 2, "pictures"},
    // The input: 1
    {"MissingFile", "farop render none.nff", 1, "none.nff: cannot open: No such file"},
    {"Directory", "mkdir d; farop render d", 1, "d: is a directory"},
    {"EmptyScene", "> e.nff; farop render e.nff", 1, "no view entity"},
    {"NoView", "printf 'p 3\\n0 0 0\\n1 0 0\\n0 1 0\\n' > v.nff; farop export v.nff", 1, "no view entity"},
    {"Truncated", "printf 'v\\nfrom 1 2 3\\nat 0 0\\n' > v.nff; farop render v.nff", 1, "v.nff:3:1: error:"},
    {"NotANumber", "sed 's/^from.*/from nan 0 0/' t.nff > n.nff; farop render n.nff", 1, "n.nff:3:"},
    {"BinaryJunk",
     "head -c 10000 /dev/urandom | tr '\\n#' 'xx' > j.nff; printf '\\0' >> j.nff; farop render j.nff", 1,
     "j.nff:1:"},
    {"DegenerateView", "farop render t.nff --at 1.02285 -3.17715 -2.17451 --from 1.02285 -3.17715 -2.17451",
     1, "degenerate view"},
    {"YonBeforeHither", "farop render t.nff --hither 3 --yon 2", 1, "is not beyond hither"},
    {"StrictWarning", "grep -v angle t.nff > w.nff; farop render w.nff --strict", 1, "error:"},
    {"FlatFileWrong", "sed '4s/.*/3 7/' t.scr > w.scr; farop raster w.scr", 1, "w.scr:4:"},
    {"FlatFileIsNff", "farop raster t.nff -o a.ppm", 1, "t.nff:1:"},
    {"CompareNoPicture", "farop compare t.nff t.nff", 1, "t.nff"},
    // The surroundings: 4
    {"FullDiskPicture", "farop render t.nff -o - > /dev/full", 4, "No space left"},
    {"FullDiskPng", "farop render t.nff -o /dev/full", 4, "No space left"},
    {"FullDiskFlat", "farop export t.nff -o /dev/full", 4, "No space left"},
    {"FullDiskNff", "farop convert t.nff -o /dev/full", 4, "No space left"},
    {"FullDiskSpd", "farop spd tetra > /dev/full", 4, "No space left"},
    {"FullDiskInfo", "farop info t.nff > /dev/full", 4, "No space left"},
    {"FullDiskStats", "farop info t.nff --stats /dev/full > /dev/null", 4, "No space left"},
    {"FullDiskHelp", "farop --help > /dev/full", 4, "cannot write"},
    {"ClosedPipe",
     "set +o pipefail; (farop spd tetra --size 9; echo status $? >&2) | head -c 10 > /dev/null; exit 4", 4,
     "Broken pipe"},
    {"ClosedPipeStatus",
     "set +o pipefail; (farop spd tetra --size 9; echo status $? >&2) | head -c 10 > /dev/null; exit 4", 4,
     "status 4"},
    {"OutputIsAFolder", "mkdir d.ppm; farop render t.nff -o d.ppm", 4, "d.ppm: cannot write: Is a directory"},
    {"OutputFolderMissing", "farop export t.nff -o none/a.scr", 4, "none/a.scr"},
    {"FileSizeLimit", "ulimit -f 1; farop render t.nff -o big.ppm --resolution 500x500", 4, "File too large"},
    {"FileSizeLimitPng", "ulimit -f 1; farop render t.nff -o big.tif --resolution 500x500", 4, "big.tif"},
};

class Refuses : public testing::TestWithParam<Case> {};

TEST_P(Refuses, WithOneMessageAndTheRightStatus) {
  const TemporaryFolder folder;
  shell(folder,
        "farop spd tetra --size 2 -o t.nff -q; farop export t.nff -o t.scr -q; printf old | tee old.ppm "
        "old.scr > old.nff");
  const Outcome run = shell(folder, GetParam().command);
  EXPECT_EQ(run.status, GetParam().status) << run.err;
  EXPECT_NE(run.err.find(GetParam().message), std::string::npos) << run.err;
  std::size_t errors = 0;
  for (std::size_t at = run.err.find("error:"); at != std::string::npos; at = run.err.find("error:", at + 1))
    ++errors;
  EXPECT_EQ(errors, 1u) << run.err;
}

INSTANTIATE_TEST_SUITE_P(CommandLine, Refuses, testing::ValuesIn(k_cases),
                         [](const auto& test) { return test.param.name; });

TEST(FailedRuns, LeaveOldOutputsAndNoTemporaryFiles) {
  const TemporaryFolder folder;
  shell(folder,
        "farop spd tetra --size 4 -o t.nff -q; farop export t.nff -o t.scr -q; head -c 3000 t.nff > cut.nff; "
        "head -c 3000 t.scr > cut.scr");
  shell(folder, "for s in ppm png exr tif scr nff json; do printf old > old.$s; done");
  for (const std::string command :
       {"farop render cut.nff -o old.ppm", "farop render cut.nff -o old.png",
        "farop export cut.nff -o old.scr", "farop convert cut.nff -o old.nff",
        "farop raster cut.scr -o old.ppm", "farop raster cut.scr -o old.exr",
        "ulimit -f 2; farop render t.nff -o old.ppm --resolution 300x300",
        "ulimit -f 2; farop render t.nff -o old.tif --resolution 300x300",
        "ulimit -f 2; farop export t.nff -o old.scr", "ulimit -f 2; farop convert t.nff -o old.nff",
        "ulimit -f 2; farop spd tetra --size 6 -o old.nff"}) {
    EXPECT_NE(shell(folder, command).status, 0) << command;
  }
  for (const std::string suffix : {"ppm", "png", "exr", "tif", "scr", "nff", "json"}) {
    EXPECT_EQ(read_file(folder / ("old." + suffix)), "old") << suffix;
  }
  const auto files = std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
  EXPECT_EQ(files, 7 + 4);
}

TEST(FailedRuns, StillWriteTheirStatistics) {
  const TemporaryFolder folder;
  EXPECT_EQ(shell(folder, "printf 'x' > x.nff; farop render x.nff -o a.ppm --stats s.json").status, 1);
  EXPECT_NE(read_file(folder / "s.json").find("\"status\": 1"), std::string::npos);
}

TEST(Outputs, GoThroughSymbolicLinksAndKeepPermissions) {
  const TemporaryFolder folder;
  const Outcome run =
      shell(folder,
            "farop spd tetra --size 2 -o t.nff; touch real.ppm; chmod 640 real.ppm; ln -s real.ppm link.ppm; "
            "farop render t.nff -o link.ppm; test -L link.ppm && stat -c %a real.ppm; head -c 2 real.ppm");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "640\nP6");
}

TEST(Outputs, WorkIntoPipesAndDevices) {
  const TemporaryFolder folder;
  const Outcome run =
      shell(folder,
            "farop spd tetra --size 2 -o t.nff; farop export t.nff -o a.scr; farop export t.nff -o - | cmp - "
            "a.scr && "
            "mkfifo f && (cat f > b.scr & farop export t.nff -o f && wait) && cmp a.scr b.scr && "
            "farop export t.nff -o /dev/null && farop raster - -o - < a.scr > p.ppm && head -c 2 p.ppm");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "P6");
}

}  // namespace
}  // namespace farop::test
