// SPDX-License-Identifier: GPL-3.0-or-later
// The three solids are what scan-line algorithms for solids need: closed 2-manifolds, oriented outwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "nff_text.h"

namespace farop::test {
namespace {

struct Solid {
  const char* name;
  std::size_t faces;
  std::size_t triangles, quadrilaterals;
  int euler_characteristic;  ///< V - E + F: 2 for a ball, 0 for a ring
  double volume;             ///< of the ideal body; the polyhedron's is a little smaller where it is round
};

const Solid k_solids[] = {
    {"hollow-cube", 128, 128, 0, 0, 8 - 8.0 / 9},
    {"solid-torus", 624, 0, 624, 0, 2 * M_PI* M_PI * 0.16},
    {"solid-cylinder", 1992, 166, 1826, 2, 2 * M_PI},
};

/// Corners are the same vertex when they are printed alike.
using Edge = std::pair<std::string_view, std::string_view>;

class SolidScene : public testing::TestWithParam<Solid> {
 protected:
  std::string text = printed(request(GetParam().name));
  std::vector<PrintedPolygon> faces = polygons_of(text);

  std::map<Edge, int> directed_edges() const {
    std::map<Edge, int> edges;
    for (const PrintedPolygon& face : faces)
      for (std::size_t i = 0; i < face.lines.size(); ++i)
        ++edges[{face.lines[i], face.lines[(i + 1) % face.lines.size()]}];
    return edges;
  }
};

TEST_P(SolidScene, HasTheFaceCountOfThePaper) {
  EXPECT_EQ(faces.size(), GetParam().faces);
  const auto corners = [this](std::size_t n) {
    return static_cast<std::size_t>(
        std::ranges::count_if(faces, [n](const auto& f) { return f.lines.size() == n; }));
  };
  EXPECT_EQ(corners(3), GetParam().triangles);
  EXPECT_EQ(corners(4), GetParam().quadrilaterals);
}

TEST_P(SolidScene, HasEveryEdgeOnceInEachDirection) {
  const auto edges = directed_edges();
  for (const auto& [edge, uses] : edges) {
    ASSERT_EQ(uses, 1) << edge.first << " -> " << edge.second;
    ASSERT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << " -> " << edge.second;
  }
}

TEST_P(SolidScene, HasOneFanOfFacesAroundEveryVertex) {
  // Around a vertex every face leads from the corner behind it to the corner before it; all must form one
  // cycle.
  std::map<std::string_view, std::map<std::string_view, std::string_view>> around;
  for (const PrintedPolygon& face : faces) {
    const std::size_t n = face.lines.size();
    for (std::size_t i = 0; i < n; ++i)
      around[face.lines[i]][face.lines[(i + 1) % n]] = face.lines[(i + n - 1) % n];
  }
  for (const auto& [vertex, next] : around) {
    const std::string_view start = next.begin()->first;
    std::string_view at = next.at(start);
    std::size_t steps = 1;
    for (; at != start && steps <= next.size(); ++steps) at = next.at(at);
    ASSERT_EQ(steps, next.size()) << vertex;
  }
}

TEST_P(SolidScene, HasTheEulerCharacteristicOfItsShape) {
  std::set<std::string_view> vertices;
  for (const PrintedPolygon& face : faces) vertices.insert(face.lines.begin(), face.lines.end());
  const auto edges = static_cast<int>(directed_edges().size() / 2);
  EXPECT_EQ(static_cast<int>(vertices.size()) - edges + static_cast<int>(faces.size()),
            GetParam().euler_characteristic);
}

TEST_P(SolidScene, EnclosesItsVolumeWithFacesThatLookOutwards) {
  double volume = 0;
  for (const PrintedPolygon& face : faces)
    for (std::size_t i = 2; i < face.positions.size(); ++i)
      volume += face.positions[0].dot(face.positions[i - 1].cross(face.positions[i])) / 6;
  EXPECT_LE(volume, GetParam().volume * 1.00001);
  EXPECT_GE(volume, GetParam().volume * 0.97);
}

TEST_P(SolidScene, HasPlanarFaces) {
  for (const PrintedPolygon& face : faces) {
    if (face.positions.size() < 4) continue;
    const V3d normal =
        (face.positions[1] - face.positions[0]).cross(face.positions[2] - face.positions[1]).normalized();
    ASSERT_NEAR(normal.dot(face.positions[3] - face.positions[0]), 0, 1e-5);
  }
}

TEST_P(SolidScene, IsSeenFromTheAgreedPlace) {
  EXPECT_TRUE(text.starts_with(
      "b 0 0 0\nv\nfrom 3.6 -4.8 3.6\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 400 600\n"
      "l 1e+06 -2e+06 3e+06\nf 0.8 0.8 0.8 1 0 0 0 1\np "));
}

INSTANTIATE_TEST_SUITE_P(Solids, SolidScene, testing::ValuesIn(k_solids), [](const auto& test) {
  std::string name = test.param.name;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace farop::test
