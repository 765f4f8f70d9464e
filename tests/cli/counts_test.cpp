// SPDX-License-Identifier: GPL-3.0-or-later
// The published numbers, through the program as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/shell.h"

namespace farop::test {
namespace {

using Json = nlohmann::json;

Json stats(const TemporaryFolder& folder) {
  return Json::parse(read_file(folder / "s.json"));
}

void expect_identity(const Json& polygons) {
  const auto n = [&](const char* name) { return polygons.at(name).get<std::uint64_t>(); };
  EXPECT_EQ(n("loaded"), n("back_facing") + n("degenerate") + n("totally_clipped") + n("rendered"));
}

/// The log of the 1997 paper (appendix A.3): gears at 1024 x 1024.
TEST(PublishedCounts, GearsAsTheFaropPaperPrintsThem) {
  for (const std::string yon : {"", " --yon 15", " --yon inf"}) {
    const TemporaryFolder folder;
    const Outcome run = shell(
        folder, "farop spd gears | farop render - --resolution 1024x1024 -o g.ppm --stats s.json" + yon);
    ASSERT_EQ(run.status, 0) << run.err;
    const Json p = stats(folder).at("polygons");
    EXPECT_EQ(p.at("loaded"), 9345);
    EXPECT_EQ(p.at("back_facing"), 4864);
    EXPECT_EQ(p.at("totally_clipped"), 39);
    EXPECT_EQ(p.at("rendered"), 4442);
    EXPECT_EQ(p.at("partly_clipped"), 45);
    expect_identity(p);
    EXPECT_EQ(read_file(folder / "g.ppm").substr(0, 17), "P6\n1024 1024\n255\n");
  }
}

TEST(PublishedCounts, TrianglesDoNotChangeThem) {
  const TemporaryFolder folder;
  const Outcome run = shell(
      folder, "farop spd gears | farop export - --resolution 1024x1024 -o g.scr --triangles --stats s.json");
  ASSERT_EQ(run.status, 0) << run.err;
  const Json p = stats(folder).at("polygons");
  EXPECT_EQ(p.at("rendered"), 4442);
  EXPECT_GT(p.at("split_to_triangles"), 4000);
  const std::string scr = read_file(folder / "g.scr");
  const std::size_t second_line = scr.find('\n') + 1;
  EXPECT_EQ(std::stoull(scr.substr(second_line)), p.at("triangles").get<std::uint64_t>());
}

struct Row {
  std::string scene;  ///< name-size, -t for the tessellated form
  int polygons, back_faces, clipped_away, partly, inside, rendered, skipped;
};

/// Counts of two independent implementations, one of them for the log above.
const Row k_rows[] = {
    {"balls-4", 1, 0, 0, 1, 0, 1, 7381},
    {"gears-4", 9345, 4864, 39, 45, 4397, 4442, 0},
    {"mount-6", 8192, 3067, 190, 83, 4852, 4935, 4},
    {"rings-7", 1, 0, 0, 1, 0, 1, 8400},
    {"teapot-6", 2292, 1149, 0, 8, 1135, 1143, 0},
    {"tetra-6", 4096, 1600, 0, 0, 2496, 2496, 0},
    {"tree-11", 1, 0, 0, 1, 0, 1, 8190},
    {"lattice-12", 0, 0, 0, 0, 0, 0, 8281},
    {"shells-5", 0, 0, 0, 0, 0, 0, 5761},
    {"jacks-1", 0, 0, 0, 0, 0, 0, 9},
    {"sombrero-1", 1922, 48, 514, 86, 1274, 1360, 0},
    {"nurbtst-1", 1500, 1128, 0, 0, 372, 372, 0},
    {"sample-1", 880, 452, 12, 40, 376, 416, 1},
    {"balls-1", 1, 0, 0, 1, 0, 1, 10},
    {"gears-1", 147, 84, 0, 1, 62, 63, 0},
    {"mount-2", 32, 7, 0, 4, 21, 25, 4},
    {"teapot-2", 244, 123, 0, 3, 118, 121, 0},
    {"tetra-2", 16, 7, 0, 0, 9, 9, 0},
    {"sombrero-2", 7938, 207, 2224, 181, 5326, 5507, 0},
    {"balls-1-t", 1081, 571, 0, 1, 509, 510, 0},
    {"rings-1-t", 3961, 2012, 0, 1, 1948, 1949, 0},
    {"mount-2-t", 464, 243, 0, 4, 217, 221, 0},
    {"tree-2-t", 925, 470, 0, 1, 454, 455, 0},
    {"lattice-1-t", 1152, 696, 344, 61, 51, 112, 0},
    {"jacks-1-t", 336, 168, 0, 0, 168, 168, 0},
    {"sample-1-t", 904, 464, 12, 40, 388, 428, 0},
};

class CullAndClipTable : public testing::TestWithParam<Row> {};

TEST_P(CullAndClipTable, ComesOut) {
  const Row& row = GetParam();
  const std::string name = row.scene.substr(0, row.scene.find('-'));
  const bool tessellated = row.scene.ends_with("-t");
  const std::string size =
      row.scene.substr(name.size() + 1, row.scene.size() - name.size() - 1 - (tessellated ? 2 : 0));
  const TemporaryFolder folder;
  const Outcome run =
      shell(folder, "farop spd " + name + " --size " + size + (tessellated ? " --tessellate" : "") +
                        " | farop export - -o /dev/null --detail 0 --stats s.json");
  ASSERT_EQ(run.status, 0) << run.err;
  const Json s = stats(folder);
  const Json p = s.at("polygons");
  EXPECT_EQ(p.at("loaded"), row.polygons);
  EXPECT_EQ(p.at("back_facing"), row.back_faces);
  EXPECT_EQ(p.at("totally_clipped"), row.clipped_away);
  EXPECT_EQ(p.at("partly_clipped"), row.partly);
  EXPECT_EQ(p.at("rendered"), row.rendered);
  EXPECT_EQ(p.at("degenerate"), 0);
  EXPECT_EQ(s.at("scene").at("spheres_skipped").get<int>() + s.at("scene").at("cones_skipped").get<int>(),
            row.skipped);
  expect_identity(p);
}

INSTANTIATE_TEST_SUITE_P(Spd, CullAndClipTable, testing::ValuesIn(k_rows), [](const auto& test) {
  std::string name = test.param.scene;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

TEST(PublishedCounts, TheIdentityHoldsForEverySceneAtItsDefaultDetail) {
  for (const std::string scene : {"balls --size 2", "gears", "mount", "rings --size 2", "teapot", "tetra",
                                  "tree --size 5", "lattice --size 3", "shells --size 1", "jacks", "sombrero",
                                  "nurbtst", "sample", "hollow-cube", "solid-torus", "solid-cylinder"}) {
    const TemporaryFolder folder;
    const Outcome run =
        shell(folder, "farop spd " + scene + " | farop render - --rasterizer null --stats s.json");
    ASSERT_EQ(run.status, 0) << scene << run.err;
    expect_identity(stats(folder).at("polygons"));
    EXPECT_GT(stats(folder).at("polygons").at("rendered"), 0) << scene;
  }
}

TEST(PublishedCounts, TeapotOfSizeOneHasFourDegeneratePatchesAndSaysSo) {
  const TemporaryFolder folder;
  const Outcome run = shell(folder, "farop spd teapot --size 1 | farop export - -o t.scr --stats s.json");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(stats(folder).at("polygons").at("degenerate"), 4);
  EXPECT_NE(run.err.find("4 polygons without area"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace farop::test
