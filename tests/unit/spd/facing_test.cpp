// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex orders and normals of the databases, checked by facts that need no reference file.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "nff_text.h"

namespace farop::test {
namespace {

struct FacingRow {
  const char* scene;
  int size;
  bool tessellated;
  int polygons, back_faces;
};

// The published cull table of the databases.
constexpr FacingRow k_rows[] = {
    {"balls", 4, false, 1, 0},      {"gears", 4, false, 9345, 4864},  {"mount", 6, false, 8192, 3067},
    {"rings", 7, false, 1, 0},      {"teapot", 6, false, 2292, 1149}, {"tetra", 6, false, 4096, 1600},
    {"tree", 11, false, 1, 0},      {"sombrero", 1, false, 1922, 48}, {"nurbtst", 1, false, 1500, 1128},
    {"sample", 1, false, 880, 452}, {"gears", 1, false, 147, 84},     {"mount", 2, false, 32, 7},
    {"teapot", 2, false, 244, 123}, {"tetra", 2, false, 16, 7},       {"sombrero", 2, false, 7938, 207},
    {"balls", 1, true, 1081, 571},  {"rings", 1, true, 3961, 2012},   {"mount", 2, true, 464, 243},
    {"tree", 2, true, 925, 470},    {"lattice", 1, true, 1152, 696},  {"jacks", 1, true, 336, 168},
    {"sample", 1, true, 904, 464},
};

V3d normal_of(const PrintedPolygon& polygon) {
  const auto& p = polygon.positions;
  return (p[1] - p[0]).cross(p[2] - p[1]);
}

class Facing : public testing::TestWithParam<FacingRow> {};

TEST_P(Facing, HasThePublishedNumberOfBackFaces) {
  const FacingRow& row = GetParam();
  const std::string text = printed(request(row.scene, row.size, row.tessellated));
  const V3d eye = vector_after(text, "from");
  const auto polygons = polygons_of(text);
  EXPECT_EQ(polygons.size(), static_cast<std::size_t>(row.polygons));
  const auto back_facing = [&eye](const PrintedPolygon& p) {
    return normal_of(p).dot(p.positions[0] - eye) >= 0;
  };
  EXPECT_EQ(std::ranges::count_if(polygons, back_facing), row.back_faces);
}

INSTANTIATE_TEST_SUITE_P(CullTable, Facing, testing::ValuesIn(k_rows), [](const auto& test) {
  const FacingRow& row = test.param;
  return std::string(row.scene) + "_" + std::to_string(row.size) + (row.tessellated ? "_t" : "");
});

TEST(Teapot, OfSizeOneHasFourPatchesWithoutArea) {
  const std::string text = printed(request("teapot", 1));
  const auto polygons = polygons_of(text);
  const auto flat = [](const PrintedPolygon& p) { return normal_of(p).length() < 1e-9; };
  EXPECT_EQ(std::ranges::count_if(polygons, flat), 4);
}

TEST(Teapot, OfLargerSizesHasNoPatchWithoutArea) {
  for (const int size : {2, 5, 6}) {
    const std::string text = printed(request("teapot", size));
    const auto polygons = polygons_of(text);
    EXPECT_TRUE(std::ranges::none_of(polygons, [](const auto& p) { return normal_of(p).length() < 1e-9; }))
        << size;
  }
}

TEST(SplinePatch, HasNormalsThatPointToTheBackOfEveryPatch) {
  const std::string text = printed(request("nurbtst"));
  for (const PrintedPolygon& polygon : polygons_of(text))
    for (const V3d& normal : polygon.normals) ASSERT_LT(normal.dot(normal_of(polygon)), 0);
}

TEST(Jacks, TessellatedHaveNormalsOfTheInverseScale) {
  const std::string text = printed(request("jacks", 1, true));
  for (const PrintedPolygon& polygon : polygons_of(text))
    for (const V3d& normal : polygon.normals) ASSERT_NEAR(normal.length(), 1 / 0.75, 1e-5);
}

TEST(Balls, OfADeeperLevelTouchTheirParents) {
  // The first ten spheres of size 1: a ball of radius 1/2 and nine of a third of it, at 2/3 from its centre.
  const std::string text = printed(request("balls", 1));
  int children = 0;
  for (const std::string_view line : lines_of(text)) {
    const auto words = words_of(line);
    if (words[0] != "s" || words[4] == "0.5") continue;
    ++children;
    EXPECT_NEAR(to_number(words[4]), 1.0 / 6, 1e-6);
    EXPECT_NEAR(V3d(to_number(words[1]), to_number(words[2]), to_number(words[3])).length(), 2.0 / 3, 2e-6);
  }
  EXPECT_EQ(children, 9);
}

}  // namespace
}  // namespace farop::test
