// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/bezier_file.h"

#include <gtest/gtest.h>

#include <string>

namespace farop::sipp {
namespace {

const std::string k_curve =
    "# a vase\n"
    "bezier_curves:\n"
    "vertices: 4\n"
    "vertex_list: 1 0 0  2 0 1  0.5e0 0 -2 # the neck\n"
    "  1. 0 3\n"
    "curves: 1\n"
    "curve_list: 4 3 2 1\n";

std::optional<BezierDescription> read(const std::string& text, DiagnosticList& messages) {
  WordReader reader(text, "vase.bez");
  return read_bezier_file(reader, messages);
}

TEST(BezierFile, TakesCurvesInReverseOrder) {
  DiagnosticList messages;
  const auto description = read(k_curve, messages);
  ASSERT_TRUE(description);
  EXPECT_TRUE(description->curves);
  EXPECT_EQ(description->points,
            (std::vector<V3d>{V3d(1, 0, 0), V3d(2, 0, 1), V3d(0.5, 0, -2), V3d(1, 0, 3)}));
  EXPECT_EQ(description->indices, (std::vector<int>{0, 1, 2, 3}));
  const auto object = bezier(*description, 3, {});
  ASSERT_TRUE(object);
  EXPECT_EQ(object->surfaces.at(0)->polygons.size(), 36u);
}

TEST(BezierFile, ReadsPatchesAsTheyStand) {
  std::string text = "bezier_patches: vertices: 16 vertex_list:\n";
  for (int i = 0; i < 16; ++i) text += std::to_string(i % 4) + " " + std::to_string(i / 4) + " 0\n";
  text += "patches: 1 patch_list: 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\n";
  DiagnosticList messages;
  const auto description = read(text, messages);
  ASSERT_TRUE(description);
  EXPECT_FALSE(description->curves);
  EXPECT_EQ(description->indices.front(), 0);
  EXPECT_EQ(description->indices.back(), 15);
  EXPECT_EQ(bezier(*description, 2, {})->surfaces.at(0)->polygons.size(), 4u);
}

TEST(BezierFile, SaysWhereAndWhatIsWrong) {
  struct Case {
    const char* from;
    const char* to;
    std::uint64_t line, column;
    const char* message;
  };
  for (const Case& c : {
           Case{"bezier_curves:", "bezier_curve:", 2, 1,
                "found 'bezier_curve:', expected 'bezier_patches:' or 'bezier_curves:'"},
           Case{"vertices: 4", "vertices: four", 3, 11, "found 'four', expected a count, a whole number"},
           Case{"vertices: 4", "vertices: 0", 3, 11, "found '0', expected a count from 1 to 100000000"},
           Case{"vertices: 4", "vertices: 4000000000000000000000", 3, 11,
                "found '4000000000000000000000', expected a count, a whole number"},
           Case{"vertices: 4", "vertices: 3", 5, 3, "found '1.', expected 'curves:'"},
           Case{"vertices: 4", "vertices: 90000000", 6, 1,
                "found 'curves:', expected a coordinate, a number"},
           Case{"2 0 1", "2 nan 1", 4, 23, "found 'nan', expected a coordinate, a number"},
           Case{"2 0 1", "2 1e999 1", 4, 23, "found '1e999', expected a coordinate, a number"},
           Case{"4 3 2 1", "4 3 5 1", 7, 17, "found '5', there is no such vertex: they count from 1 to 4"},
           Case{"4 3 2 1", "4 3 0 1", 7, 17, "found '0', there is no such vertex: they count from 1 to 4"},
           Case{"4 3 2 1", "4 3 2.5 1", 7, 17,
                "found '2.5', expected the number of a vertex, a whole number"},
           Case{"4 3 2 1\n", "4 3 2", 7, 18, "the file ends where the number of a vertex was expected"},
           Case{"4 3 2 1", "4 3 2 1 4", 7, 21, "found '4', expected the end of the file"},
       }) {
    std::string text = k_curve;
    text.replace(text.find(c.from), std::string(c.from).size(), c.to);
    DiagnosticList messages;
    EXPECT_FALSE(read(text, messages)) << c.to;
    ASSERT_EQ(messages.items.size(), 1u) << c.to;
    EXPECT_EQ(messages.items[0].message, c.message);
    EXPECT_EQ(messages.items[0].where.line, c.line) << c.to;
    EXPECT_EQ(messages.items[0].where.column, c.column) << c.to;
  }
}

TEST(BezierFile, EveryPrefixEndsInAMessage) {
  for (std::size_t length = 0; length + 2 < k_curve.size(); ++length) {
    DiagnosticList messages;
    EXPECT_FALSE(read(k_curve.substr(0, length), messages)) << length;
    EXPECT_EQ(messages.items.size(), 1u) << length;
  }
}

}  // namespace
}  // namespace farop::sipp
