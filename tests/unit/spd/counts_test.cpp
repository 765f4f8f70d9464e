// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "nff_text.h"

namespace farop {

std::ostream& operator<<(std::ostream& out, const SpdCounts& c) {
  return out << "p " << c.polygons << ", pp " << c.patches << ", s " << c.spheres << ", c " << c.cones
             << ", f " << c.fills << ", l " << c.lights;
}

namespace test {
namespace {

using Column = std::uint64_t SpdCounts::*;

struct CountRow {
  const char* scene;
  const char* column_name;
  Column column;
  std::uint64_t sizes_1_to_6[6];
};

// The published table of counts, not computed by the formulas under test.
constexpr CountRow k_rows[] = {
    {"balls", "spheres", &SpdCounts::spheres, {10, 91, 820, 7381, 66430, 597871}},
    {"gears", "polygons", &SpdCounts::polygons, {147, 1169, 3943, 9345, 18251, 31537}},
    {"gears", "fills", &SpdCounts::fills, {2, 9, 28, 65, 126, 217}},
    {"mount", "polygons", &SpdCounts::polygons, {8, 32, 128, 512, 2048, 8192}},
    {"rings", "spheres", &SpdCounts::spheres, {30, 150, 420, 900, 1650, 2730}},
    {"rings", "cones", &SpdCounts::cones, {30, 150, 420, 900, 1650, 2730}},
    {"rings", "fills", &SpdCounts::fills, {7, 31, 85, 181, 331, 547}},
    {"teapot", "polygons", &SpdCounts::polygons, {1, 4, 9, 16, 25, 36}},
    {"teapot", "patches", &SpdCounts::patches, {56, 240, 552, 992, 1560, 2256}},
    {"tetra", "polygons", &SpdCounts::polygons, {4, 16, 64, 256, 1024, 4096}},
    {"tree", "spheres", &SpdCounts::spheres, {3, 7, 15, 31, 63, 127}},
    {"tree", "cones", &SpdCounts::cones, {3, 7, 15, 31, 63, 127}},
    {"jacks", "spheres", &SpdCounts::spheres, {6, 54, 438, 3510, 28086, 224694}},
    {"jacks", "cones", &SpdCounts::cones, {3, 27, 219, 1755, 14043, 112347}},
    {"lattice", "spheres", &SpdCounts::spheres, {8, 27, 64, 125, 216, 343}},
    {"lattice", "cones", &SpdCounts::cones, {12, 54, 144, 300, 540, 882}},
    {"lattice", "fills", &SpdCounts::fills, {20, 81, 208, 425, 756, 1225}},
    {"shells", "spheres", &SpdCounts::spheres, {361, 721, 1441, 2881, 5761, 11521}},
    {"sombrero", "polygons", &SpdCounts::polygons, {1922, 7938, 32258, 130050, 522242, 2093058}},
};

class CountsOfSizes : public testing::TestWithParam<CountRow> {};

TEST_P(CountsOfSizes, PredictedAndPrintedAreThoseOfTheTable) {
  const CountRow& row = GetParam();
  for (int size = 1; size <= 6; ++size) {
    const std::uint64_t expected = row.sizes_1_to_6[size - 1];
    EXPECT_EQ(spd_counts(request(row.scene, size)).*row.column, expected) << "size " << size;
    EXPECT_EQ(scanned_counts(request(row.scene, size)).*row.column, expected) << "size " << size;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, CountsOfSizes, testing::ValuesIn(k_rows), [](const auto& test) {
  return std::string(test.param.scene) + "_" + test.param.column_name;
});

struct DefaultRow {
  const char* scene;
  int default_size;
  SpdCounts counts;
};

const std::vector<DefaultRow> k_defaults = {
    {"balls", 4, {.polygons = 1, .spheres = 7381, .fills = 2, .lights = 3}},
    {"gears", 4, {.polygons = 9345, .fills = 65, .lights = 5}},
    {"mount", 6, {.polygons = 8192, .spheres = 4, .fills = 2, .lights = 1}},
    {"rings", 7, {.polygons = 1, .spheres = 4200, .cones = 4200, .fills = 841, .lights = 3}},
    {"teapot", 6, {.polygons = 36, .patches = 2256, .fills = 3, .lights = 2}},
    {"tetra", 6, {.polygons = 4096, .fills = 1, .lights = 1}},
    {"tree", 11, {.polygons = 1, .spheres = 4095, .cones = 4095, .fills = 2, .lights = 7}},
    {"jacks", 1, {.spheres = 6, .cones = 3, .fills = 1, .lights = 1}},
    {"lattice", 12, {.spheres = 2197, .cones = 6084, .fills = 8281, .lights = 6}},
    {"shells", 5, {.spheres = 5761, .fills = 1, .lights = 1}},
    {"sombrero", 1, {.polygons = 1922, .fills = 1, .lights = 1}},
    {"nurbtst", 1, {.patches = 1500, .fills = 1, .lights = 1}},
    {"sample", 1, {.polygons = 16, .patches = 864, .cones = 1, .fills = 5, .lights = 1}},
    {"hollow-cube", 1, {.polygons = 128, .fills = 1, .lights = 1}},
    {"solid-torus", 1, {.polygons = 624, .fills = 1, .lights = 1}},
    {"solid-cylinder", 1, {.polygons = 1992, .fills = 1, .lights = 1}},
};

TEST(SceneList, HoldsTheThirteenDatabasesAndTheThreeSolidsWithTheirDefaults) {
  ASSERT_EQ(spd_scenes().size(), k_defaults.size());
  for (std::size_t i = 0; i < k_defaults.size(); ++i) {
    EXPECT_EQ(spd_scenes()[i].name, k_defaults[i].scene);
    EXPECT_EQ(spd_scenes()[i].default_size, k_defaults[i].default_size);
    EXPECT_FALSE(spd_scenes()[i].description.empty());
  }
}

TEST(DefaultSizes, PredictedAndPrintedCountsAreThePublishedOnes) {
  for (const DefaultRow& row : k_defaults) {
    EXPECT_EQ(spd_counts(request(row.scene)), row.counts) << row.scene;
    EXPECT_EQ(scanned_counts(request(row.scene)), row.counts) << row.scene;
  }
}

TEST(TessellatedCounts, PredictedAreThePrintedOnes) {
  for (const SpdSceneInfo& scene : spd_scenes()) {
    for (const int resolution : {1, 2, 3, 5}) {
      const SpdRequest r = request(std::string(scene.name), 2, true, resolution);
      EXPECT_EQ(spd_counts(r), scanned_counts(r)) << scene.name << ", resolution " << resolution;
    }
  }
}

TEST(TessellatedCounts, AreThePublishedOnesOfTheDefaultSizes) {
  const auto total = [](const char* scene) {
    const SpdCounts c = spd_counts(request(scene, {}, true));
    EXPECT_EQ(c.spheres + c.cones, 0u) << scene;
    return c.polygons + c.patches;
  };
  EXPECT_EQ(total("balls"), 797149u);
  EXPECT_EQ(total("rings"), 554401u);
  EXPECT_EQ(total("tree"), 540541u);
  EXPECT_EQ(total("lattice"), 383292u);
  EXPECT_EQ(total("shells"), 622188u);
  EXPECT_EQ(total("jacks"), 336u);
  EXPECT_EQ(total("sample"), 904u);
}

TEST(TessellatedCounts, OfJacksAreThoseOfResolutionTwoWhateverIsAsked) {
  EXPECT_EQ(printed(request("jacks", 1, true, 7)), printed(request("jacks", 1, true)));
  EXPECT_EQ(scanned_counts(request("jacks", 1, true, 7)).patches, 6u * 48 + 3u * 16);
}

TEST(TessellatedForm, OfScenesWithoutSpheresAndConesIsTheDefaultForm) {
  for (const char* scene :
       {"gears", "tetra", "teapot", "sombrero", "nurbtst", "hollow-cube", "solid-torus", "solid-cylinder"})
    EXPECT_TRUE(printed(request(scene, 2, true, 4)) == printed(request(scene, 2))) << scene;
}

TEST(LargestSizes, HaveCountsWithinSixtyFourBits) {
  for (const SpdSceneInfo& scene : spd_scenes()) {
    const SpdCounts plain = spd_counts(request(std::string(scene.name), scene.max_size));
    const std::uint64_t objects = plain.polygons + plain.patches + plain.spheres + plain.cones;
    EXPECT_GT(objects, 0u) << scene.name;
    EXPECT_LT(objects, 1'000'000'000'000u) << scene.name;
    // The sum of an overflow would be smaller than what exact real arithmetic gives.
    const SpdCounts fine = spd_counts(request(std::string(scene.name), scene.max_size, true, 1024));
    const double r = scene.name == "jacks" ? 2 : 1024;
    const double real =
        static_cast<double>(plain.spheres) * 12 * r * r + static_cast<double>(plain.cones) * 8 * r;
    EXPECT_GE(static_cast<double>(fine.patches), real * 0.999) << scene.name;
  }
}

}  // namespace
}  // namespace test
}  // namespace farop
