// SPDX-License-Identifier: GPL-3.0-or-later
// `farop new`: what it makes builds, draws and knows whether it is right; what it cannot make leaves nothing
// behind.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <ostream>
#include <string>

#include "support/shell.h"

namespace farop::test {
namespace {

namespace fs = std::filesystem;

class New : public testing::Test {
 protected:
  Outcome run(const std::string& command, int status = 0) {
    Outcome outcome = shell(folder_, command);
    EXPECT_EQ(outcome.status, status) << command << "\n" << outcome.out << outcome.err;
    return outcome;
  }
  void expect_refusal(const std::string& command, int status, const std::string& message) {
    const Outcome outcome = run(command, status);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << command << "\n" << outcome.err;
  }
  std::string listing() { return run("ls -A").out; }

  TemporaryFolder folder_;
};

// ---- projects ----------------------------------------------------------------------------------------

struct Toolchain {
  const char* language;
  const char* compiler;
  const char* source;
  const char* built;  ///< by `make`; for Python nothing is
};

void PrintTo(const Toolchain& toolchain, std::ostream* out) {
  *out << toolchain.language;
}

class NewProject : public New, public testing::WithParamInterface<Toolchain> {
 protected:
  void SetUp() override {
    const Toolchain& tools = GetParam();
    if (shell(folder_, std::string("command -v ") + tools.compiler).status != 0) {
      GTEST_SKIP() << tools.compiler << " is not installed";
    }
    if (std::string(tools.language) != "python") return;
    if (shell(folder_, "test -e \"${PATH%%:*}/lib/farop/farop-python.so\"").status != 0) {
      GTEST_SKIP() << "this farop was built without Python";
    }
    write_file(folder_ / "probe.py", "import numpy\n");
    const Outcome probe =
        shell(folder_, "farop spd tetra --size 1 | farop render - --rasterizer ./probe.py -o p.ppm");
    if (probe.err.find("No module named 'numpy'") != std::string::npos)
      GTEST_SKIP() << "NumPy is not installed";
    fs::remove(folder_ / "probe.py");
  }
  /// my-own_1, built; nothing in it may bear another name.
  void make_project(const std::string& algorithm, const std::string& start) {
    run(std::string("farop new my-own_1 -q --lang ") + GetParam().language + " --algorithm " + algorithm);
    EXPECT_EQ(run("cd my-own_1; grep -E '@[A-Z]+@|plugins/|" + start + "[._]' *", 1).out, "");
    EXPECT_NE(read_file(project_ / "README.md").find("`" + std::string(GetParam().source) + "`"),
              std::string::npos);
    EXPECT_EQ(run("make -C my-own_1").err, "");  // no warning either
    EXPECT_TRUE(fs::exists(project_ / GetParam().built));
  }

  const fs::path project_ = folder_ / "my-own_1";
};

INSTANTIATE_TEST_SUITE_P(, NewProject,
                         testing::Values(Toolchain{"c", "cc", "my-own_1.c", "my-own_1.so"},
                                         Toolchain{"c++", "g++", "my-own_1.cpp", "my-own_1.so"},
                                         Toolchain{"rust", "rustc", "my-own_1.rs", "my-own_1.so"},
                                         Toolchain{"zig", "zig", "my-own_1.zig", "my-own_1.so"},
                                         Toolchain{"python", "python3", "my-own_1.py", ""},
                                         Toolchain{"fortran", "gfortran", "my-own_1.f90", "my-own_1.so"}),
                         [](const auto& row) {
                           const std::string language = row.param.language;
                           return language == "c++" ? "cpp" : language;
                         });

TEST_P(NewProject, DrawsDotsAtOnceAndFailsItsCheckUntilThePartsAreFilledIn) {
  make_project("blank", "dots");
  if (*GetParam().built != '\0') {
    EXPECT_NE(run("make -C my-own_1").out.find("Nothing to be done"), std::string::npos);
  }

  // Not the background, and not the scene yet.
  run("make -C my-own_1 picture");
  std::string background = "P6 512 512 255\n";
  for (int i = 0; i < 512 * 512; ++i) background += "\x14\x5c\xc0";  // of SPD gears
  write_file(folder_ / "background.ppm", background);
  const std::string report = run("farop compare my-own_1/picture.png background.ppm", 1).out;
  int dots = 0;
  const std::size_t over = report.find("over --fail");
  ASSERT_NE(over, std::string::npos) << report;
  ASSERT_EQ(std::sscanf(report.c_str() + over, "over --fail %d", &dots), 1) << report;
  EXPECT_GT(dots, 1000);
  EXPECT_LT(dots, 512 * 512 / 10);

  const std::string check = run("make -C my-own_1 check", 2).out;
  for (const std::string scene : {"hollow-cube", "teapot", "gears"}) {
    EXPECT_NE(check.find("FAIL  " + scene + ": "), std::string::npos) << check;
    EXPECT_NE(check.find("see check/" + scene + ".difference.png"), std::string::npos) << check;
    EXPECT_TRUE(fs::exists(project_ / "check" / (scene + ".difference.png")));
  }
  EXPECT_EQ(check.find("pass"), std::string::npos) << check;
  // What to do, in the order of the work.
  EXPECT_NE(check.find(std::string("still marked in ") + GetParam().source), std::string::npos) << check;
  std::size_t at = 0;
  for (const std::string part : {"1: scan conversion", "2: interpolation", "3, beginning: the depth buffer",
                                 "3, end: the depth test"}) {
    const std::size_t found = check.find(": YOUR PART " + part, at);
    ASSERT_NE(found, std::string::npos) << part << "\n" << check;
    at = found;
  }

  run("make -C my-own_1 clean");
  EXPECT_EQ(run("ls -A my-own_1 | LC_ALL=C sort").out,
            std::string("Makefile\nREADME.md\ncheck.sh\n") + GetParam().source + "\n");
}

TEST_P(NewProject, WithTheZBufferPassesItsCheck) {
  make_project("zbuffer", "zbuffer");
  const std::string check = run("make -s -C my-own_1 check").out;
  EXPECT_EQ(check, "pass  hollow-cube\npass  teapot\npass  gears\n");
}

// ---- the check ---------------------------------------------------------------------------------------

TEST_F(New, ChecksTellWhatIsBroken) {
  if (shell(folder_, "command -v cc").status != 0) GTEST_SKIP() << "cc is not installed";
  run("farop new mine --lang c --algorithm zbuffer -q");
  // No depth test any more; and it gives up at polygon 280, which the teapot alone has.
  run("cd mine; sed -i 's/^ *if (z >= .nearest) continue;.*//; "
      "s/^  farop_vertex a = p/  if (p->index == 280) return FAROP_E_INTERNAL;\\n&/' mine.c");
  const Outcome check = run("make -s -C mine check", 2);
  for (const std::string scene : {"hollow-cube", "gears"}) {
    EXPECT_NE(check.out.find("FAIL  " + scene + ": "), std::string::npos) << check.out;
    EXPECT_NE(check.out.find("see check/" + scene + ".difference.png"), std::string::npos) << check.out;
  }
  EXPECT_NE(check.out.find("FAIL  teapot: it was not drawn"), std::string::npos) << check.out;
  EXPECT_NE(check.err.find("FAROP_E_INTERNAL"), std::string::npos) << check.err;
  EXPECT_NE(check.out.find("What to do: lines along edges come from the fill rule"), std::string::npos)
      << check.out;
}

TEST_F(New, MakefilesSayWhatToDoWithoutFarop) {
  run("farop new mine --lang c -q");
  expect_refusal("make -C mine FAROP=/nowhere/farop", 2, "make FAROP=/folder/farop");
}

// ---- the command -------------------------------------------------------------------------------------

TEST_F(New, SaysWhatItMadeAndWhatComesNext) {
  const Outcome outcome = run("mkdir 'a b' && farop new 'a b/mine/' --lang fortran");
  EXPECT_EQ(outcome.out, "");
  std::size_t at = 0;
  for (const std::string word :
       {"mine.f90", "Makefile", "check.sh", "README.md", "cd 'a b/mine'", "make picture", "make check"}) {
    const std::size_t found = outcome.err.find(word, at);
    ASSERT_NE(found, std::string::npos) << word << "\n" << outcome.err;
    at = found;
  }
  EXPECT_EQ(run("ls -A 'a b'").out, "mine\n");
  EXPECT_EQ(run("farop new quiet --lang c --quiet").err, "");
}

TEST_F(New, TakesAnEmptyFolderAndTheUsersPermissions) {
  run("mkdir mine && farop new mine --lang c -q");
  EXPECT_TRUE(fs::exists(folder_ / "mine" / "mine.c"));
  run("umask 027; farop new guarded --lang c -q");
  EXPECT_EQ(run("stat -c %a guarded guarded/Makefile").out, "750\n640\n");
}

TEST_F(New, RefusesNamesThatARasterizerCannotHave) {
  const auto expect_name = [&](const std::string& path, const std::string& remedy) {
    expect_refusal("farop new --lang c " + path, 2, "cannot be a rasterizer's name");
    expect_refusal("farop new --lang c " + path, 2, ", for instance " + remedy + "\n");
  };
  expect_name("Mine", "mine");
  expect_name("'my raster.c'", "my_raster_c");
  expect_name("some/where/X-Y", "some/where/x-y");
  expect_name("./-x", "./x");
  expect_name("..", "mine");
  expect_name("/", "/mine");
  expect_name("''", "mine");
  expect_name("z\\\\303\\\\251ro", "z_303_251ro");
  expect_name("abcdefghij_bcdefghij_bcdefghij_bcdefghij_", "abcdefghij_bcdefghij_bcdefghij_bcdefghij");
  EXPECT_EQ(listing(), "");
}

TEST_F(New, RefusesWhatExistsAndDoesNotTouchIt) {
  run("mkdir full empty; echo text > full/file; echo text > file; ln -s empty link; ln -s nowhere broken");
  const std::string before = run("ls -lR --time-style=full-iso").out;
  expect_refusal("farop new full --lang c", 2, "full: exists and is not empty");
  for (const std::string name : {"file", "link", "broken"}) {
    expect_refusal("farop new " + name + " --lang c", 2, name + ": exists and is no folder");
  }
  EXPECT_EQ(run("ls -lR --time-style=full-iso").out, before);
}

TEST_F(New, RefusesWhatItDoesNotKnow) {
  expect_refusal("farop new mine", 2, "--lang is required");
  expect_refusal("farop new --lang c", 2, "name is required");
  expect_refusal("farop new mine --lang pyton", 2, "did you mean 'python'?");
  expect_refusal("farop new mine --lang cobol", 2, "expected c, c++, rust, zig, python, fortran");
  expect_refusal("farop new mine --lang c --algorithm zbufer", 2, "did you mean 'zbuffer'?");
  EXPECT_EQ(listing(), "");
}

TEST_F(New, LeavesNothingWhereItCannotWrite) {
  expect_refusal("farop new none/mine --lang c", 4, "none/mine: cannot be made: No such file");
  run("echo text > file");
  expect_refusal("farop new file/mine --lang c", 4, "file/mine: cannot be made: Not a directory");
  EXPECT_EQ(listing(), "file\n");
  // The first file is written, a later one is cut: none stays.
  expect_refusal("ulimit -f 1; farop new mine --lang c", 4, "File too large");
  EXPECT_EQ(listing(), "file\n");
}

TEST_F(New, SaysWhenItsInstallationIsIncomplete) {
  run("mkdir bin; cp \"$(command -v farop)\" bin/farop");
  expect_refusal("bin/farop new mine --lang c", 4, "a part of this installation is missing");
  EXPECT_EQ(listing(), "bin\n");
}

}  // namespace
}  // namespace farop::test
