// SPDX-License-Identifier: GPL-3.0-or-later
// The entities of the format, the text level, the order of things and the warnings.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "nff_text.h"

namespace farop {
namespace {

constexpr const char* k_fill = "f 1 0.5 0.25 0.75 0.125 10 0 1\n";

std::string filled(const std::string& text) {
  return k_fill + text;
}

// Positions of the corners of polygon `index` of the first surface.
std::vector<V3d> corners(const ParsedText& parsed, std::size_t index = 0) {
  std::vector<V3d> points;
  auto polygon = parsed.surface().polygons.begin();
  while (index-- > 0) ++polygon;
  for (const std::uint32_t c : (*polygon).corners) points.push_back(parsed.surface().positions[c]);
  return points;
}

#define ASSERT_CLEAN(parsed)   \
  ASSERT_TRUE((parsed).scene); \
  ASSERT_TRUE((parsed).reports.empty()) << (parsed).report(0)

TEST(NffScene, IsOneObjectUnderTheRootNamedAfterTheFile) {
  const ParsedText parsed = parse_text(filled("s 0 0 0 1\n"));
  ASSERT_CLEAN(parsed);
  ASSERT_EQ(parsed.scene->root.children.size(), 1u);
  EXPECT_TRUE(parsed.scene->root.surfaces.empty());
  EXPECT_EQ(parsed.scene->root.children[0]->name, "scene");
  EXPECT_EQ(parsed.scene->root.children[0]->to_parent, M44d());
}

TEST(NffScene, MayBeEmpty) {
  for (const char* text : {"", "\n\n", "# nothing", "\xEF\xBB\xBF", "b 0 0 0", "f 1 1 1 1 0 0 0 1"}) {
    const ParsedText parsed = parse_text(text);
    ASSERT_CLEAN(parsed);
    EXPECT_EQ(parsed.surfaces(), 0u);
    EXPECT_FALSE(parsed.scene->view.from);
  }
}

TEST(NffScene, SummaryCountsWhatWasRead) {
  const std::string text =
      "l 1 2 3\nl 1 2 3\n" +
      filled("p 3 0 0 0 1 0 0 0 1 0\ns 0 0 0 1\ns 0 0 0 0\nc 0 0 0 1 0 0 1 1\np 2 0 0 0 1 0 0\n") +
      filled("pp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\npp 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1\n");
  const ParsedText parsed = parse_text(text);
  ASSERT_TRUE(parsed.scene);
  const InputSummary& s = parsed.summary();
  EXPECT_EQ(s.file, "folder/scene.nff");
  EXPECT_EQ(s.format, "nff");
  EXPECT_EQ(s.bytes, text.size());
  EXPECT_EQ(s.surfaces, 2u);
  EXPECT_EQ(s.polygons, 1u);
  EXPECT_EQ(s.patches, 2u);
  EXPECT_EQ(s.spheres, 1u);
  EXPECT_EQ(s.cones, 1u);
  EXPECT_EQ(s.lights, 2u);
}

TEST(NffView, HasEverySubKeyword) {
  const ParsedText parsed =
      parse_text("v\nfrom 1 2 3\nat 4 5 6\nup 0 0 2\nangle 45.5\nhither 0.25\nresolution 640 480\n");
  ASSERT_CLEAN(parsed);
  const ViewParameters& view = parsed.scene->view;
  EXPECT_EQ(*view.from, V3d(1, 2, 3));
  EXPECT_EQ(*view.at, V3d(4, 5, 6));
  EXPECT_EQ(*view.up, V3d(0, 0, 2));
  EXPECT_EQ(*view.angle, 45.5);
  EXPECT_EQ(*view.hither, 0.25);
  EXPECT_EQ(view.resolution->x, 640);
  EXPECT_EQ(view.resolution->y, 480);
  EXPECT_FALSE(view.yon);
  EXPECT_FALSE(view.fit);
  EXPECT_FALSE(view.background);
}

TEST(NffView, TakesAnyOrderAndTheLastOfRepeatedParts) {
  const ParsedText parsed =
      parse_text("v resolution 8 9 hither 0 at 1 1 1 angle 20 from 0 0 0 angle 30 at 2 2 2 b 0 0 0");
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(*parsed.scene->view.angle, 30);
  EXPECT_EQ(*parsed.scene->view.at, V3d(2, 2, 2));
  EXPECT_EQ(*parsed.scene->view.hither, 0);
  EXPECT_EQ(parsed.scene->view.resolution->y, 9);
  EXPECT_TRUE(parsed.scene->view.background);
}

TEST(NffView, LeavesMissingPartsEmptyWithoutAWarning) {
  const ParsedText parsed = parse_text("v\nfrom 0 0 1\nat 0 0 0\n");
  ASSERT_CLEAN(parsed);
  EXPECT_FALSE(parsed.scene->view.up);
  EXPECT_FALSE(parsed.scene->view.angle);
  EXPECT_FALSE(parsed.scene->view.hither);
  EXPECT_FALSE(parsed.scene->view.resolution);
}

TEST(NffView, AcceptsTheLargestResolutionAndTheExtremeAngles) {
  const ParsedText parsed = parse_text("v from 0 0 1 at 0 0 0 resolution 32767 1 angle 179.999 hither -0");
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(parsed.scene->view.resolution->x, 32767);
  EXPECT_TRUE(parse_text("v from 0 0 1 at 0 0 0 angle 1e-9").scene);
}

TEST(NffView, SecondOneReplacesTheFirstWithAWarning) {
  const ParsedText parsed = parse_text("b 1 0 0\nv from 0 0 1 at 0 0 0 angle 30\n v from 0 0 2 at 0 0 0\n");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "3:2: second 'v'; the last one counts");
  EXPECT_EQ(parsed.reports[0].severity, Severity::warning);
  EXPECT_EQ(*parsed.scene->view.from, V3d(0, 0, 2));
  EXPECT_FALSE(parsed.scene->view.angle);
  EXPECT_EQ(*parsed.scene->view.background, (Rgb{1, 0, 0}));
}

TEST(NffView, AfterAnObjectIsUsedWithAWarning) {
  const ParsedText parsed = parse_text(filled("s 0 0 0 1\nv from 0 0 1 at 0 0 0\n"));
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "3:1: 'v' after an object; it is used for the whole scene");
  EXPECT_TRUE(parsed.scene->view.from);
}

TEST(NffView, YonOfGraphicsGemsIsKeptWithAWarning) {
  const ParsedText parsed = parse_text("v from 0 0 1 at 0 0 0 hither 1 yon 15");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "1:32: 'yon' is not in the NFF format; it is used as the far plane");
  EXPECT_EQ(*parsed.scene->view.yon, 15);
}

TEST(NffBackground, LastOneWins) {
  const ParsedText parsed = parse_text("b 0.25 0.5 0.75\nb 1 0 0.5\n");
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(*parsed.scene->view.background, (Rgb{1, 0, 0.5}));
}

TEST(NffBackground, OutsideTheUnitRangeIsKeptWithAWarning) {
  const ParsedText parsed = parse_text("b 0.25 2 -1\n");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "1:8: colour of 'b' outside 0..1; it is clamped when it is drawn");
  EXPECT_EQ(*parsed.scene->view.background, (Rgb{0.25, 2, -1}));
}

TEST(NffBackground, MayStandBehindLightsAndObjects) {
  const ParsedText parsed = parse_text("l 0 0 0\n" + filled("s 0 0 0 1\nb 1 1 1\n"));
  ASSERT_CLEAN(parsed);
  EXPECT_TRUE(parsed.scene->view.background);
}

TEST(NffLight, HasAColorOnlyWhereOneIsGiven) {
  const ParsedText parsed = parse_text("l 1 2 3\nl 4 5 6 20 20 0.5\nl\n7\n8\n9\n");
  ASSERT_CLEAN(parsed);
  ASSERT_EQ(parsed.scene->lights.size(), 3u);
  EXPECT_EQ(parsed.scene->lights[0], (Light{V3d(1, 2, 3), std::nullopt}));
  EXPECT_EQ(parsed.scene->lights[1], (Light{V3d(4, 5, 6), Rgb{20, 20, 0.5}}));
  EXPECT_EQ(parsed.scene->lights[2], (Light{V3d(7, 8, 9), std::nullopt}));
}

TEST(NffLight, AfterAnObjectIsUsedWithAWarning) {
  const ParsedText parsed = parse_text(filled("s 0 0 0 1\n l 1 2 3\n"));
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "3:2: light after an object; it is used for the whole scene");
  EXPECT_EQ(parsed.scene->lights.size(), 1u);
}

TEST(NffFill, GivesTheMaterialOfWhatFollows) {
  const ParsedText parsed = parse_text("f 1 0.85 0.7 0.3 0.6 3.0827 0.8 1.1\ns 0 0 0 1\n");
  ASSERT_CLEAN(parsed);
  const Material& m = parsed.surface().material;
  EXPECT_EQ(m.color, (Rgb{1, 0.85, 0.7}));
  EXPECT_EQ(m.kd, 0.3);
  EXPECT_EQ(m.ks, 0.6);
  EXPECT_EQ(m.shine, 3.0827);
  EXPECT_EQ(m.transmittance, 0.8);
  EXPECT_EQ(m.refraction, 1.1);
  EXPECT_EQ(m.ka, 0.30);
}

TEST(NffFill, OpensASurfaceOnlyWhereAnObjectFollows) {
  const ParsedText parsed = parse_text(
      "f 1 0 0 1 0 0 0 1\nf 0 1 0 1 0 0 0 1\ns 0 0 0 1\ns 0 0 0 2\nf 0 0 1 1 0 0 0 1\ns 0 0 0 0\nf 1 1 1 1 0 "
      "0 0 1\n"
      "f 0 1 0 1 0 0 0 1\ns 0 0 0 3\nf 0 0 0 1 0 0 0 1\n");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.surfaces(), 2u);
  EXPECT_EQ(parsed.surface(0).curved.size(), 2u);
  EXPECT_EQ(parsed.surface(0).material.color, (Rgb{0, 1, 0}));
  EXPECT_EQ(parsed.surface(1).curved.size(), 1u);
  EXPECT_EQ(parsed.surface(1).material, parsed.surface(0).material);
}

TEST(NffFill, MissingBeforeTheFirstObjectIsWhiteAndDiffuseWithOneWarning) {
  const ParsedText parsed = parse_text("s 0 0 0 1\ns 0 0 0 2\np 3 0 0 0 1 0 0 0 1 0\n");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "1:1: object before the first 'f'; it is white and diffuse");
  const Material& m = parsed.surface().material;
  EXPECT_EQ(m.color, (Rgb{1, 1, 1}));
  EXPECT_EQ(m.kd, 1);
  EXPECT_EQ(m.ks, 0);
  EXPECT_EQ(m.shine, 0);
  EXPECT_EQ(m.transmittance, 0);
  EXPECT_EQ(m.refraction, 1);
}

TEST(NffFill, TransmittanceOutsideTheUnitRangeIsClampedWithAWarning) {
  const ParsedText parsed = parse_text("f 1 1 1 1 0 0 1.5 1\ns 0 0 0 1\nf 1 1 1 1 0 0 -0.5 1\ns 0 0 0 1\n");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 2u);
  EXPECT_EQ(parsed.report(0), "1:15: transmittance of 'f' outside 0..1; it is clamped");
  EXPECT_EQ(parsed.report(1), "3:15: transmittance of 'f' outside 0..1; it is clamped");
  EXPECT_EQ(parsed.surface(0).material.opacity(), (Rgb{0, 0, 0}));
  EXPECT_EQ(parsed.surface(1).material.opacity(), (Rgb{1, 1, 1}));
}

TEST(NffFill, NegativeShineIsTakenAsZeroWithAWarning) {
  const ParsedText parsed = parse_text("f 1 1 1 1 0 -3 0 1\ns 0 0 0 1\n");
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "1:13: negative shine of 'f'; 0 is used");
  EXPECT_EQ(parsed.surface().material.shine, 0);
}

TEST(NffSphere, HasCentreAndRadius) {
  const ParsedText parsed = parse_text(filled("s 1 2 3 4\ns 1 2 3 -4\n"));
  ASSERT_CLEAN(parsed);
  const auto& curved = parsed.surface().curved;
  ASSERT_EQ(curved.size(), 2u);
  EXPECT_EQ(curved[0].sphere, (Sphere{V3d(1, 2, 3), 4, false}));
  EXPECT_EQ(curved[1].sphere, (Sphere{V3d(1, 2, 3), 4, true}));
}

TEST(NffSphere, WithoutRadiusIsSkippedWithAWarning) {
  const ParsedText parsed = parse_text(filled("s 1 2 3 0\ns 1 2 3 -0\n"));
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 2u);
  EXPECT_EQ(parsed.report(0), "2:1: sphere of radius 0 is skipped");
  EXPECT_EQ(parsed.surfaces(), 0u);
}

TEST(NffCone, IsReadFromOneTwoOrThreeLines) {
  const Cone expected{V3d(1, 2, 3), 0.5, V3d(4, 5, 6), 0.25, false};
  for (const char* text :
       {"c 1 2 3 0.5 4 5 6 0.25\n", "c\n1 2 3 0.5\n4 5 6 0.25\n", "c 1 2 3 0.5\n4 5 6 0.25\n",
        "c 1 2 3\n0.5 4 5\n6 0.25", "c\n1\n2\n3\n0.5\n4\n5\n6\n0.25\n"}) {
    const ParsedText parsed = parse_text(filled(text));
    ASSERT_CLEAN(parsed);
    EXPECT_EQ(parsed.surface().curved.at(0).cone, expected) << text;
    EXPECT_EQ(parsed.surface().curved.at(0).kind, CurvedPrimitive::Kind::cone);
  }
}

TEST(NffCone, RadiiDecideWhatIsVisible) {
  const struct {
    const char* text;
    double base, apex;
    bool inside;
  } cases[] = {{"c 0 0 0 1 0 0 1 2", 1, 2, false},  {"c 0 0 0 -1 0 0 1 -2", 1, 2, true},
               {"c 0 0 0 0 0 0 1 2", 0, 2, false},  {"c 0 0 0 0 0 0 1 -2", 0, 2, true},
               {"c 0 0 0 1 0 0 1 0", 1, 0, false},  {"c 0 0 0 -1 0 0 1 0", 1, 0, true},
               {"c 0 0 0 -0 0 0 1 1", 0, 1, false}, {"c 0 0 0 -1 0 0 1 -0", 1, 0, true}};
  for (const auto& c : cases) {
    const ParsedText parsed = parse_text(filled(c.text));
    ASSERT_CLEAN(parsed);
    const Cone& cone = parsed.surface().curved.at(0).cone;
    EXPECT_EQ(cone.base_radius, c.base) << c.text;
    EXPECT_EQ(cone.apex_radius, c.apex) << c.text;
    EXPECT_EQ(cone.inside_visible, c.inside) << c.text;
  }
}

TEST(NffCone, WithoutExtentIsSkippedWithAWarning) {
  const ParsedText parsed = parse_text(filled("c 1 1 1 2 1 1 1 3\nc 0 0 0 0 0 0 1 -0\n"));
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 2u);
  EXPECT_EQ(parsed.report(0), "2:1: cone with its base at the apex is skipped");
  EXPECT_EQ(parsed.report(1), "3:1: cone without a radius is skipped");
  EXPECT_EQ(parsed.summary().cones, 0u);
}

TEST(NffCurvedPrimitives, KeepTheirPlaceAmongPolygons) {
  const ParsedText parsed =
      parse_text(filled("s 0 0 0 1\np 3 0 0 0 1 0 0 0 1 0\np 3 0 0 0 1 0 0 0 1 0\nc 0 0 0 1 0 0 1 1\ns 0 0 0 "
                        "2\np 3 0 0 0 1 0 0 0 1 0\n"));
  ASSERT_CLEAN(parsed);
  const auto& curved = parsed.surface().curved;
  ASSERT_EQ(curved.size(), 3u);
  EXPECT_EQ(curved[0].after_polygons, 0u);
  EXPECT_EQ(curved[1].after_polygons, 2u);
  EXPECT_EQ(curved[2].after_polygons, 2u);
}

TEST(NffPolygon, KeepsItsVerticesInOrder) {
  const ParsedText parsed = parse_text(filled("p 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"));
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(corners(parsed), (std::vector<V3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_FALSE((*parsed.surface().polygons.begin()).has_given_normals);
  EXPECT_TRUE(parsed.surface().normals.empty());
}

TEST(NffPolygon, MayBreakItsLinesAnywhere) {
  const std::vector<V3d> expected{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const char* text :
       {"p 3 0 0 0 1 0 0 0 1 0", "p\n3\n0\n0\n0\n1 0 0 0\n1 0\n", "p 3\n0 0 0 1 0 0\n\n\n0 1 0\n",
        "p 3 # triangle\n0 0 0# first\n# between\n1 0 0 #\n0 1 0", "p\t3\v0\f0 0\r1 0 0\r\n0 1 0\r",
        "p 3\n% AFF\n0 0 0 % AFF\n1 0 0\n0 1 0\n"}) {
    const ParsedText parsed = parse_text(filled(text));
    ASSERT_CLEAN(parsed);
    EXPECT_EQ(corners(parsed), expected) << text;
  }
}

TEST(NffPolygon, KeepsRepeatedVertices) {
  const ParsedText parsed = parse_text(filled("p 5\n0 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n"));
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(corners(parsed).size(), 5u);
  EXPECT_EQ(parsed.surface().positions.size(), 3u);
}

TEST(NffPolygon, OfLessThanThreeVerticesIsSkippedWithAWarning) {
  const ParsedText parsed =
      parse_text(filled("p 1\n5 5 5\n pp 2\n0 0 0 0 0 1\n1 0 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\n"));
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 2u);
  EXPECT_EQ(parsed.report(0), "2:1: polygon of less than 3 vertices is skipped");
  EXPECT_EQ(parsed.report(1), "4:2: polygon of less than 3 vertices is skipped");
  EXPECT_EQ(parsed.summary().polygons, 1u);
  EXPECT_EQ(parsed.summary().patches, 0u);
  EXPECT_EQ(parsed.surface().positions.size(), 3u);
}

TEST(NffPolygon, DegenerateOnesAreLoadedWithoutAWordHere) {
  const ParsedText parsed = parse_text(filled("p 3\n1 1 1\n1 1 1\n1 1 1\np 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n"));
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(parsed.summary().polygons, 2u);
}

TEST(NffPolygon, BentMoreThanAThousandthOfItsExtentIsKeptWithAWarning) {
  // The box of 3 x 4 has the diagonal 5 (and the height, which adds nothing to speak of): the limit is 0.005.
  for (const auto& [height, warns] :
       {std::pair{0.0049, false}, {0.0051, true}, {-0.0049, false}, {-0.0051, true}}) {
    const ParsedText parsed = parse_text(filled(fmt::format("p 4\n0 0 0\n3 0 0\n3 4 0\n0 4 {}\n", height)));
    ASSERT_TRUE(parsed.scene);
    EXPECT_EQ(parsed.reports.size(), warns ? 1u : 0u) << height;
    EXPECT_EQ(corners(parsed)[3], V3d(0, 4, height));
  }
  const ParsedText parsed = parse_text(filled("p 4\n0 0 0\n3 0 0\n3 4 0\n0 4 1\n"));
  EXPECT_EQ(parsed.report(0).substr(0, 29), "2:1: polygon is not planar: a");
}

TEST(NffPolygon, PlanarityNeedsNoThirdDimensionOfItsFirstCorners) {
  // Collinear first corners give no plane to be off; extreme coordinates are not judged.
  for (const char* text : {"p 4\n0 0 0\n1 0 0\n2 0 0\n0 1 5\n", "p 4\n0 0 0\n0 0 0\n0 0 0\n0 1 5\n",
                           "p 4\n0 0 0\n1e300 0 0\n0 1e300 0\n0 0 1e300\n", "p 3\n0 0 0\n1 0 0\n0 1 0\n"}) {
    ASSERT_CLEAN(parse_text(filled(text)));
  }
}

TEST(NffPatch, KeepsItsNormalsAsRead) {
  const ParsedText parsed =
      parse_text(filled("pp 4\n0 0 0 0 0 2\n1 0 0 0 0 0\n1 1 0\n0 0 -1\n0 1 0 1 1 1\n"));
  ASSERT_CLEAN(parsed);
  const Surface& surface = parsed.surface();
  EXPECT_TRUE((*surface.polygons.begin()).has_given_normals);
  EXPECT_EQ(surface.normals, (std::vector<V3d>{{0, 0, 2}, {0, 0, 0}, {0, 0, -1}, {1, 1, 1}}));
}

TEST(NffVertices, AreSharedWhereEveryBitIsEqual) {
  const ParsedText parsed = parse_text(
      filled("p 3\n0 0 0\n1 0 0\n0 1 0\np 3\n1.0 0 0\n-0 0 0\n0 1e0 0\n"
             "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\npp 3\n0 0 0 0 0 1\n0 1 0 0 0 -1\n1 0 0 0 0 1\n"));
  ASSERT_CLEAN(parsed);
  std::vector<std::uint32_t> indices;
  for (const PolygonView polygon : parsed.surface().polygons) {
    indices.insert(indices.end(), polygon.corners.begin(), polygon.corners.end());
  }
  EXPECT_EQ(indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 4, 5, 6, 4, 7, 5}));
  EXPECT_TRUE(std::signbit(parsed.surface().positions[3].x));
}

TEST(NffText, AcceptsCommentsAnywhere) {
  const ParsedText parsed = parse_text("# start\nv # view\nfrom 0 0 1#eye\n# p 3\nat 0 #x\n0 0\n#\n" +
                                       filled("#s 1 1 1 1\ns 0 0 #\n0 1 # end without a line end"));
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(parsed.surface().curved.size(), 1u);
}

TEST(NffText, LineEndsOfAllKindsAreWhiteSpace) {
  const std::string unix_text = "b 0 0 1\n# c\nl 1 2 3\n" + filled("p 3\n0 0 0\n1 0 0\n\n0 1 0\ns 0 0 0 0\n");
  for (const std::string& line_end : {std::string("\r\n"), std::string("\r")}) {
    std::string text;
    for (const char c : unix_text) text += c == '\n' ? line_end : std::string(1, c);
    const ParsedText parsed = parse_text(text);
    ASSERT_TRUE(parsed.scene);
    EXPECT_TRUE(same_content(*parsed.scene, *parse_text(unix_text).scene));
    EXPECT_EQ(parsed.report(0), parse_text(unix_text).report(0));
  }
}

TEST(NffText, SkipsAByteOrderMark) {
  const ParsedText parsed = parse_text("\xEF\xBB\xBF" + filled("s 0 0 0 0\n"));
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.report(0), "2:1: sphere of radius 0 is skipped");
}

TEST(NffText, ReadsTheNumbersOfWindowsPrintf) {
  const ParsedText parsed = parse_text(filled("s 1.11022e-016 .5 5. +1e+000\n"));
  ASSERT_CLEAN(parsed);
  EXPECT_EQ(parsed.surface().curved[0].sphere.center, V3d(1.11022e-16, 0.5, 5));
}

TEST(NffWarnings, RepeatAFewTimesAndAreThenCounted) {
  std::string text = k_fill;
  for (int i = 0; i < 10; ++i) text += "s 0 0 0 0\n";
  text += "s 0 0 0 1\nl 1 1 1\n";
  const ParsedText parsed = parse_text(text);
  ASSERT_TRUE(parsed.scene);
  ASSERT_EQ(parsed.reports.size(), 5u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(parsed.report(i), fmt::format("{}:1: sphere of radius 0 is skipped", i + 2));
  EXPECT_EQ(parsed.report(3), "13:1: light after an object; it is used for the whole scene");
  EXPECT_EQ(parsed.report(4),
            "11:1: sphere of radius 0 is skipped ... and 7 more of this kind, the last one here");
  EXPECT_EQ(parsed.count(Severity::warning), 5u);
}

TEST(NffWarnings, TheirNumberIsAnOption) {
  const std::string text = filled("s 0 0 0 0\ns 0 0 0 0\ns 0 0 0 0\n");
  NffOptions options;
  options.warnings_per_kind = 1;
  EXPECT_EQ(parse_text(text, options).reports.size(), 2u);
  options.warnings_per_kind = 0;
  ASSERT_EQ(parse_text(text, options).reports.size(), 1u);
  EXPECT_EQ(parse_text(text, options).report(0),
            "4:1: sphere of radius 0 is skipped ... and 3 more of this kind, the last one here");
  options.warnings_per_kind = -5;
  EXPECT_EQ(parse_text(text, options).reports.size(), 1u);
}

TEST(NffWarnings, BeforeAnErrorAreReportedAndNothingAfterIt) {
  std::string text = k_fill;
  for (int i = 0; i < 10; ++i) text += "s 0 0 0 0\n";
  const ParsedText parsed = parse_text(text + "q\n");
  ASSERT_EQ(parsed.reports.size(), 4u);
  EXPECT_EQ(parsed.report(3), "12:1: unknown keyword 'q'");
}

TEST(NffErrors, CarryARemedyWhereThereIsOne) {
  const std::pair<std::string, std::string> cases[] = {
      {"sphere 0 0 0 1", "did you mean 's'?"},
      {"Cylinder 0 0 0 1", "did you mean 'c'?"},
      {"Polygon 3", "did you mean 'p'?"},
      {"P 3", "did you mean 'p'?"},
      {"pp: 3", "did you mean 'pp'?"},
      {"ppp 3", "did you mean 'pp'?"},
      {"v form 0 0 0", "did you mean 'from'?"},
      {"v from 0 0 0 at 0 0 1 resolutoin 4 4", "did you mean 'resolution'?"},
      {"v from 0 0 0 at 0 0 1 hihter 4", "did you mean 'hither'?"},
      {"v from 0 0 0 at 0 0 1 angl 4", "did you mean 'angle'?"},
      {"v from 0 0 0 at 0 0 1 uup 4", "did you mean 'up'?"},
      {"p4 0 0 0", "put a blank between keyword and number: 'p 4'"},
      {"l1.5 0 0", "put a blank between keyword and number: 'l 1.5'"},
      {"c-1 0 0", "put a blank between keyword and number: 'c -1'"},
      {"tpp3 0 0", "put a blank between keyword and number: 'tpp 3'"},
      {"xyzzy", "keywords are v, b, l, f, c, s, p and pp, in lower case; '#' starts a comment"},
      {"p 3 0 0 0 0 0 1 1 0 0 0 0 1 0 1 0 0 0 1", "six numbers a vertex: is this 'pp'?"},
      {"p 3 0 0 0 1 0 0 0 1 0 1 1 1", "is the vertex count 4, or has another polygon lost its keyword?"},
      {"pp 3 0 0 0 1 0 0 0 1 0", "three numbers a vertex: is this 'p'?"},
      {"// comment", "use '#'"},
      {"s 0 0 0 1 2", "ellipsoids are not supported"},
      {"\x1F\x8B\x08", "the file is compressed with gzip: unpack it first"},
  };
  for (const auto& [text, hint] : cases) {
    const ParsedText parsed = parse_text(text);
    ASSERT_FALSE(parsed.scene) << text;
    EXPECT_EQ(parsed.reports.back().hint, hint) << text;
  }
}

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    path_ = (std::filesystem::path(testing::TempDir()) /
             fmt::format("farop_nff_{}.nff", static_cast<void*>(this)))
                .string();
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(NffFile, OfManyBlocksGivesTheSceneOfItsText) {
  std::string text = k_fill;
  for (int i = 0; i < 60'000; ++i)
    text += fmt::format("p 3\n{} {} 0\n{} 0.5 1e-3\n0 {} -7.25\n", i, i % 7, i + 1, i % 11);
  const TemporaryFile file(text);
  WordReader reader(file.path());
  DiagnosticList list;
  NffOptions options;
  std::uint64_t calls = 0;
  std::uint64_t last = 0;
  options.progress = [&](std::uint64_t done, std::uint64_t total) {
    EXPECT_GE(done, last);
    EXPECT_EQ(total, text.size());
    last = done;
    ++calls;
  };
  std::optional<Scene> scene = parse_nff(reader, list, options);
  ASSERT_TRUE(scene);
  EXPECT_GE(calls, 4u);
  scene->root.children[0]->name = "scene";
  EXPECT_TRUE(same_content(*scene, *parse_text(text).scene));
  EXPECT_EQ(scene->inputs[0].bytes, text.size());
}

}  // namespace
}  // namespace farop
