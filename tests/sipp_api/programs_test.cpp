// SPDX-License-Identifier: GPL-3.0-or-later
// Programs as people wrote them for SIPP, compiled as C of 1989 and of 1999: their pictures, and their scenes
// as files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "core/word_reader.h"
#include "export/flat_reader.h"
#include "export/image_compare.h"
#include "export/image_reader.h"
#include "parse_nff/parse_nff.h"
#include "scene/bounds.h"
#include "scene/traverse.h"
#include "support/shell.h"

namespace farop {
namespace {

using test::Outcome;
using test::read_file;
using test::TemporaryFolder;

const std::vector<std::string> k_programs = {"torus",   "cones",  "ellipsoid", "prisms",  "chain",
                                             "lattice", "holes",  "column",    "strauss", "planet",
                                             "wood",    "scroll", "grid"};

std::string program(const std::string& name, const std::string& standard = "gnu89") {
  return std::string(FAROP_SIPP_PROGRAMS) + "/" + name + "_" + standard;
}

/// SIPP has no call to free a world: programs leave that to the system.
Outcome run(const TemporaryFolder& folder, const std::string& command) {
  return test::shell(folder, "ASAN_OPTIONS=detect_leaks=0 " + command);
}

TEST(SippPrograms, DrawWhatTheyDrew) {
  TemporaryFolder folder;
  for (const std::string& name : k_programs) {
    ASSERT_EQ(run(folder, program(name) + " -s 96").status, 0) << name;
    const std::string golden = std::string(FAROP_SIPP_GOLDEN) + "/" + name + ".png";
    const std::string picture = folder / (name + ".ppm");
    if (std::getenv("FAROP_UPDATE_GOLDEN") != nullptr) {
      ASSERT_EQ(std::system(("oiiotool " + picture + " -o " + golden).c_str()), 0);
    }
    // Compilers differ in the last bit of a sine: a pixel at a silhouette may change.
    CompareThresholds thresholds;
    thresholds.fail = 2.5 / 255;
    thresholds.fail_percent = 0.2;
    const CompareResult result = compare_images(picture, golden, thresholds);
    EXPECT_NE(result.verdict, CompareVerdict::fail)
        << name << ": " << result.fail_pixels << " pixels, at worst " << result.max_error << " at "
        << result.max_x << " " << result.max_row;
  }
}

TEST(SippPrograms, AreTheSameInBothStandards) {
  TemporaryFolder old_c, new_c;
  for (const std::string& name : k_programs) {
    ASSERT_EQ(run(old_c, program(name, "gnu89") + " -s 32").status, 0) << name;
    ASSERT_EQ(run(new_c, program(name, "c99") + " -s 32").status, 0) << name;
    EXPECT_EQ(read_file(old_c / (name + ".ppm")), read_file(new_c / (name + ".ppm"))) << name;
  }
}

TEST(SippPrograms, HaveFourModes) {
  TemporaryFolder folder;
  std::vector<std::string> pictures;
  for (const std::string mode : {"p", "g", "f"}) {
    ASSERT_EQ(run(folder, program("ellipsoid") + " -s 64 -" + mode).status, 0);
    pictures.push_back(read_file(folder / "ellipsoid.ppm"));
    EXPECT_EQ(pictures.back().size(), pictures.front().size());
  }
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_NE(pictures[1], pictures[2]);
  ASSERT_EQ(run(folder, program("ellipsoid") + " -s 64 -l").status, 0);
  const std::string lines = read_file(folder / "ellipsoid.pbm");
  EXPECT_TRUE(lines.starts_with("P4\n#"));
  EXPECT_TRUE(lines.find("\n64\n64\n") != std::string::npos);
  const auto bytes = lines.substr(lines.size() - 64 * 8);
  int black = 0;
  for (const char c : bytes) black += __builtin_popcount(static_cast<unsigned char>(c));
  EXPECT_GT(black, 300);
  EXPECT_LT(black, 2500);
}

std::optional<Scene> read_nff(const std::string& file) {
  WordReader reader(file);
  DiagnosticList messages;
  auto scene = parse_nff(reader, messages);
  // Quadrilaterals of Bezier patches are not planar: warnings.
  EXPECT_EQ(messages.count(Severity::error), 0u);
  return scene;
}

TEST(SippCapture, WritesTheSceneInsteadOfThePicture) {
  TemporaryFolder folder;
  struct Case {
    const char* name;
    std::uint64_t polygons;
    std::size_t lights;
  };
  for (const Case& c : {Case{"torus", 600, 2}, Case{"cones", 40 + 60 + 60, 2}, Case{"chain", 8 * 39 * 15, 2},
                        Case{"lattice", 8 * (80 + 40 * 18) + 12 * 120, 2}, Case{"prisms", 5 + 6 + 7, 2},
                        Case{"holes", 28 * 81 + 3 * 36 + 6, 2}, Case{"column", 28 * 81 + 6 + 16 * 120, 1},
                        Case{"strauss", 4 * (60 + 30 * 13) + 6, 2}, Case{"scroll", 100, 2},
                        Case{"planet", 100 + 50 * 23, 1}, Case{"wood", 6, 1}}) {
    const Outcome outcome =
        run(folder, "FAROP_CAPTURE=" + std::string(c.name) + ".nff " + program(c.name) + " -s 64");
    ASSERT_EQ(outcome.status, 0) << c.name << outcome.err;
    const auto scene = read_nff(folder / (std::string(c.name) + ".nff"));
    ASSERT_TRUE(scene) << c.name;
    EXPECT_EQ(totals(*scene).polygons, c.polygons) << c.name;
    EXPECT_EQ(scene->lights.size(), c.lights) << c.name;
    EXPECT_EQ(scene->view.resolution, (ViewParameters::Size{64, 64})) << c.name;
    if (std::string(c.name) != "wood") {  // which writes its pixmap by itself
      EXPECT_TRUE(read_file(folder / (std::string(c.name) + ".ppm")).empty()) << c.name;
    }
  }
}

TEST(SippCapture, KeepsPlacesMaterialsAndTheView) {
  TemporaryFolder folder;
  ASSERT_EQ(run(folder, "FAROP_CAPTURE=prisms.nff " + program("prisms") + " -s 64").status, 0);
  const auto scene = read_nff(folder / "prisms.nff");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->view.from, V3d(4, -10, 9));
  EXPECT_EQ(scene->view.at, V3d(0, 0.5, 0));
  EXPECT_NEAR(*scene->view.angle, 2 * std::atan(0.4) * 180 / 3.14159265358979, 1e-9);
  // Phong with ambient 0.30 is what NFF says exactly.
  const Surface& first = *scene->root.children[0]->surfaces[0];
  EXPECT_EQ(first.material.kd, 0.7);
  EXPECT_EQ(first.material.ks, 0.4);
  EXPECT_EQ(first.material.shine, 20);
  EXPECT_EQ(first.material.color, (Rgb{0.4, 0.8, 0.4}));
  // The triangular prism, moved by -3: its top is made first.
  EXPECT_EQ(first.positions[0], V3d(-2, -1, 2));
}

TEST(SippCapture, KnowsSippsShadersInProgramsAtFixedAddressesToo) {
  TemporaryFolder folder;
  for (const std::string kind : {"gnu89", "fixed"}) {
    const Outcome outcome = run(folder, "FAROP_CAPTURE=lattice.nff " + program("lattice", kind) + " -s 64");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("functions of the program"), std::string::npos) << kind << outcome.err;
    EXPECT_NE(outcome.err.find("bumpy"), std::string::npos) << kind << outcome.err;
    const auto scene = read_nff(folder / "lattice.nff");
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->root.children[0]->surfaces[0]->material.color, (Rgb{0.8, 0.6, 0.3})) << kind;
  }
}

TEST(SippCapture, AsksShaderFunctionsWhatTheyScatter) {
  TemporaryFolder folder;
  const Outcome outcome = run(folder, "FAROP_CAPTURE=holes.nff " + program("holes") + " -s 64");
  EXPECT_NE(outcome.err.find("functions of the program"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("how opacities"), std::string::npos) << outcome.err;
  const Outcome opaque = run(folder, "FAROP_CAPTURE=scroll.nff " + program("scroll") + " -s 64");
  EXPECT_NE(opaque.err.find("functions of the program"), std::string::npos) << opaque.err;
  EXPECT_EQ(opaque.err.find("how opacities"), std::string::npos) << opaque.err;
  const auto scene = read_nff(folder / "holes.nff");
  ASSERT_TRUE(scene);
  const auto& surfaces = scene->root.children[0]->surfaces;
  const Material& glaze = surfaces.front()->material;
  EXPECT_GT(glaze.color.r, 0.4);  // 0.9 where there is no hole
  EXPECT_LT(glaze.color.r, 0.9);
  EXPECT_NEAR(glaze.color.b / glaze.color.r, 0.85 / 0.9, 1e-4);
  EXPECT_GT(glaze.transmittance, 0.1);
  EXPECT_LT(glaze.transmittance, 0.7);
  const Material& tiles = surfaces.back()->material;
  EXPECT_NEAR(tiles.color.r, 0.7, 0.1);  // half of 0.9, half of 0.5
  EXPECT_EQ(tiles.transmittance, 0);
}

/// Counts what a flat file holds.
class Counter : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame& frame) override { resolution = frame.resolution; }
  void polygons(const ScreenPolygonBatch& batch) override {
    count += batch.polygons.size();
    for (const ScreenVertex& v : batch.vertices) brightest = std::max<int>(brightest, v.r);
  }
  void end_frame() override {}
  std::size_t count = 0;
  int brightest = 0;
  Resolution resolution;
};

TEST(SippCapture, WritesScreenPolygonsToo) {
  TemporaryFolder folder;
  for (const std::string name : {"torus", "holes"}) {
    ASSERT_EQ(run(folder, "FAROP_CAPTURE=" + name + ".scr " + program(name) + " -s 64").status, 0);
    WordReader reader(folder / (name + ".scr"));
    DiagnosticList messages;
    Counter counter;
    ASSERT_TRUE(read_flat(reader, messages, counter));
    EXPECT_EQ(counter.resolution.x, 64);
    EXPECT_GT(counter.count, 200u);
    EXPECT_GT(counter.brightest, 150);
  }
}

TEST(SippCapture, CanDrawAsWell) {
  TemporaryFolder folder;
  ASSERT_EQ(run(folder, program("torus") + " -s 32 && mv torus.ppm alone.ppm && FAROP_CAPTURE=torus.nff " +
                            "FAROP_CAPTURE_DRAW=1 " + program("torus") + " -s 32")
                .status,
            0);
  EXPECT_EQ(read_file(folder / "alone.ppm"), read_file(folder / "torus.ppm"));
  EXPECT_FALSE(read_file(folder / "torus.nff").empty());
}

TEST(SippCapture, NumbersTheScenesOfASequence) {
  TemporaryFolder folder;
  ASSERT_EQ(run(folder, program("walk") + " -s 32").status, 0);
  EXPECT_FALSE(read_file(folder / "walk0.ppm").empty());
  EXPECT_TRUE(read_file(folder / "walk1.ppm").empty());
  EXPECT_FALSE(read_file(folder / "walk2.ppm").empty());
  double x = 0.5;  // of the block in the second image
  for (const std::string file : {"walk.nff", "", "frame.nff", "frame-2.nff", "frame-3.nff"}) {
    if (!file.empty()) {
      const auto scene = read_nff(folder / file);
      ASSERT_TRUE(scene) << file;
      const Bounds box = world_bounds(*scene).value();
      EXPECT_NEAR((box.low.x + box.high.x) / 2, x, 1e-12) << file;
    }
    x += 0.5;
  }
}

TEST(SippCapture, SaysWhatItCannotDo) {
  TemporaryFolder folder;
  Outcome outcome = run(folder, "FAROP_CAPTURE=torus.obj " + program("torus") + " -s 32");
  EXPECT_EQ(outcome.err,
            "sipp: FAROP_CAPTURE: 'torus.obj' ends in neither .nff nor .scr: nothing is captured\n");
  EXPECT_FALSE(read_file(folder / "torus.ppm").empty());
  outcome = run(folder, "FAROP_CAPTURE=nowhere/torus.nff " + program("torus") + " -s 32");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("nowhere/torus.nff"), std::string::npos) << outcome.err;
}

TEST(SippCapture, IsDrawnByFaropAsTheProgramDrawsIt) {
  TemporaryFolder folder;
  // Phong shaders with ambient 0.30 and directional lights: NFF says all of it.
  ASSERT_EQ(run(folder, "FAROP_CAPTURE=prisms.nff " + program("prisms") + " -s 128").status, 0);
  ASSERT_EQ(run(folder, program("prisms") + " -s 128").status, 0);
  const Outcome outcome =
      run(folder, "farop render prisms.nff -o nff.ppm --mode phong --samples 2 --resolution 128 128");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  CompareThresholds thresholds;
  thresholds.fail = 1.5 / 255;
  thresholds.fail_percent = 0.5;
  const CompareResult result = compare_images(folder / "nff.ppm", folder / "prisms.ppm", thresholds);
  EXPECT_NE(result.verdict, CompareVerdict::fail) << result.fail_pixels << " " << result.max_error;
}

}  // namespace
}  // namespace farop
