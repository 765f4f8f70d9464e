// SPDX-License-Identifier: GPL-3.0-or-later
// What `solids` makes of solids, of what only looks like one, and of its options.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <map>
#include <stdexcept>

#include "plugins/solid_scenes.h"
#include "plugins/visibility.h"

namespace farop::test {
namespace {

constexpr const char* k_solids[] = {"hollow-cube", "solid-torus", "solid-cylinder"};

/// The three variants, side by side.
class Variants {
 public:
  PluginDriver& variant(int number) { return drivers_[static_cast<std::size_t>(number - 1)]; }

  /// Draws with all three; the pictures must be one.
  PluginPicture draw(const PluginFrame& frame, const std::vector<PluginPolygon>& polygons,
                     const std::string& what) {
    const PluginPicture picture = variant(1).draw(frame, polygons);
    for (const int number : {2, 3}) {
      const PluginPicture other = variant(number).draw(frame, polygons);
      int different = 0;
      for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        different += picture.rgb[i] != other.rgb[i] ? 1 : 0;
      EXPECT_EQ(different, 0) << what << ": variants 1 and " << number << " differ";
    }
    return picture;
  }
  /// Of the last picture.
  double statistic(int number, const std::string& key) {
    const std::string& line = variant(number).last_log;
    const std::size_t at = line.find(" " + key + "=");
    EXPECT_NE(at, std::string::npos) << key << " in " << line;
    return at == std::string::npos ? -1 : std::atof(line.c_str() + at + key.size() + 2);
  }

 private:
  static std::map<std::string, std::string> options(const char* variant) {
    return {{"variant", variant}, {"statistics", "1"}};
  }
  std::array<PluginDriver, 3> drivers_ = {PluginDriver(FAROP_SOLIDS, options("1")),
                                          PluginDriver(FAROP_SOLIDS, options("2")),
                                          PluginDriver(FAROP_SOLIDS, options("3"))};
};

// ---- solids made of lattice points --------------------------------------------------------------

/// Triangles over corners that they share; seen from outside counter-clockwise (x right, y up, z away).
struct Mesh {
  Corners corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Six times the signed volume of a tetrahedron; positive if a b c is seen counter-clockwise from outside and
/// p lies inside.
Int128 volume(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, const ScreenVertex& p) {
  const Int128 ax = a.x - p.x, ay = a.y - p.y, az = a.z - p.z;
  const Int128 bx = b.x - p.x, by = b.y - p.y, bz = b.z - p.z;
  const Int128 cx = c.x - p.x, cy = c.y - p.y, cz = c.z - p.z;
  return -(ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx));
}

/// A sphere of about `rings` x `sides` triangles with a middle from which all of its surface is seen, so that
/// it cannot cut through itself; `rough` makes it concave. `rings` = 1 and not rough: a double pyramid,
/// convex.
Mesh random_star(Random& random, const PluginFrame& frame, bool rough, int rings = 0) {
  if (rings == 0) rings = random.integer(1, 5);
  for (;;) {
    const int sides = random.integer(3, 9);
    const int bits = frame.subpixel_bits, size = (frame.width - 1) << bits;
    const ScreenVertex middle =
        vertex(random.integer(size / 3, 2 * size / 3), random.integer(size / 3, 2 * size / 3),
               random.integer(frame.z_far / 3, 2 * frame.z_far / 3));
    const double tilt = random.integer(0, 628) / 100.0, turn = random.integer(0, 628) / 100.0;
    const double across = size / 3.1, deep = frame.z_far / 3.1;
    Mesh mesh;
    const auto add = [&](double latitude, double longitude) {
      const double r = rough ? random.integer(30, 100) / 100.0 : 1.0;
      double x = std::cos(latitude) * std::cos(longitude), y = std::cos(latitude) * std::sin(longitude),
             z = std::sin(latitude);
      const double y2 = y * std::cos(tilt) - z * std::sin(tilt), z2 = y * std::sin(tilt) + z * std::cos(tilt);
      const double x3 = x * std::cos(turn) - y2 * std::sin(turn),
                   y3 = x * std::sin(turn) + y2 * std::cos(turn);
      mesh.corners.push_back(vertex(middle.x + std::llround(across * r * x3),
                                    middle.y + std::llround(across * r * y3),
                                    middle.z + std::llround(deep * r * z2)));
    };
    constexpr double pi = 3.14159265358979;
    add(-pi / 2, 0);
    for (int ring = 1; ring <= rings; ++ring) {
      for (int side = 0; side < sides; ++side) add(-pi / 2 + pi * ring / (rings + 1), 2 * pi * side / sides);
    }
    add(pi / 2, 0);
    const auto at = [&](int ring, int side) {
      return static_cast<std::uint32_t>(1 + ring * sides + side % sides);
    };
    const auto last = static_cast<std::uint32_t>(mesh.corners.size() - 1);
    for (int side = 0; side < sides; ++side) {
      mesh.triangles.push_back({0, at(0, side), at(0, side + 1)});
      for (int ring = 0; ring + 1 < rings; ++ring) {
        mesh.triangles.push_back({at(ring, side), at(ring + 1, side), at(ring, side + 1)});
        mesh.triangles.push_back({at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1)});
      }
      mesh.triangles.push_back({last, at(rings - 1, side + 1), at(rings - 1, side)});
    }
    int right = 0, wrong = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Int128 v = volume(mesh.corners[a], mesh.corners[b], mesh.corners[c], middle);
      ++(v > 0 ? right : wrong);
      if (v == 0) right = wrong = 1;
    }
    if (right > 0 && wrong > 0) continue;  // too rough for the lattice
    if (wrong > 0) {
      for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    return mesh;
  }
}

void add_mesh(VisibilityScene& scene, const Mesh& mesh, std::uint32_t object_id, bool y_down = false,
              std::int32_t top = 0) {
  for (const auto& triangle : mesh.triangles) {
    Corners corners;
    for (const std::uint32_t corner : triangle) corners.push_back(mesh.corners[corner]);
    PluginPolygon polygon;
    polygon.ids.assign(triangle.begin(), triangle.end());
    polygon.object_id = object_id, polygon.surface_id = 1;
    polygon.flags = FAROP_POLYGON_CONVEX;
    if (twice_area(corners) <= 0) polygon.flags |= FAROP_POLYGON_BACK_FACING;
    if (y_down) {
      for (ScreenVertex& v : corners) v.y = top - v.y;
    }
    scene.add(corners, std::move(polygon));
  }
}

PluginFrame random_frame(int number) {
  PluginFrame frame;
  frame.width = frame.height = 48;
  frame.subpixel_bits = number % 4 == 3 ? 4 : 0;
  return frame;
}

TEST(Solids, DrawsRandomSolidsWithEveryVariant) {
  Variants variants;
  Random random(201);
  for (int i = 0; i < 300; ++i) {
    const PluginFrame frame = random_frame(i);
    VisibilityScene scene;
    const bool y_down = i % 5 == 4;
    add_mesh(scene, random_star(random, frame, i % 3 != 0), 1, y_down,
             (frame.height - 1) << frame.subpixel_bits);
    const std::string what = "solid " + std::to_string(i);
    scene.expect_seen(variants.draw(frame, scene.polygons(), what), frame, false, what);
    if (testing::Test::HasFailure()) return;
    EXPECT_EQ(2 * variants.statistic(2, "edge_table"), variants.statistic(1, "edge_table")) << what;
    EXPECT_LT(variants.statistic(3, "edge_table"), variants.statistic(2, "edge_table")) << what;
  }
}

/// Their front faces never lie behind each other.
TEST(Solids, ComparesNoDepthsOfConvexSolids) {
  Variants variants;
  Random random(202);
  for (int i = 0; i < 60; ++i) {
    PluginFrame frame;
    frame.width = frame.height = 400;
    VisibilityScene scene;
    add_mesh(scene, random_star(random, frame, false, 1), 1);
    variants.draw(frame, scene.polygons(), "convex solid");
    EXPECT_GT(variants.statistic(1, "depth_comparisons"), 1000);
    EXPECT_LT(variants.statistic(2, "depth_comparisons"), variants.statistic(1, "depth_comparisons") / 4);
    EXPECT_EQ(variants.statistic(3, "depth_comparisons"), 0);
  }
}

/// The same solid twice in one place: ids are those of a surface.
TEST(Solids, KeepsTheEdgesOfSurfacesApart) {
  Variants variants;
  Random random(207);
  for (int i = 0; i < 20; ++i) {
    const PluginFrame frame = random_frame(i);
    const Mesh mesh = random_star(random, frame, true);
    VisibilityScene scene;
    for (std::uint32_t object = 1; object <= 2; ++object) add_mesh(scene, mesh, object);
    variants.draw(frame, scene.polygons(), "solid " + std::to_string(i));
    EXPECT_EQ(2 * variants.statistic(2, "edge_table"), variants.statistic(1, "edge_table"));
  }
}

/// Solids that stand in front of each other and cut through each other: no longer one solid.
TEST(Solids, DrawsSeveralSolidsThatCrossEachOther) {
  Variants variants;
  Random random(203);
  for (int i = 0; i < 150; ++i) {
    const PluginFrame frame = random_frame(i);
    VisibilityScene scene;
    for (std::uint32_t object = 1; object <= 3; ++object)
      add_mesh(scene, random_star(random, frame, true), object);
    const std::string what = "scene " + std::to_string(i);
    scene.expect_seen(variants.draw(frame, scene.polygons(), what), frame, false, what);
    if (testing::Test::HasFailure()) return;
  }
}

/// Surfaces with holes, and what has no ids at all, beside and in a solid: inside and outside are seen.
TEST(Solids, FallsBackForOpenSurfaces) {
  Variants variants;
  Random random(204);
  for (int i = 0; i < 200; ++i) {
    const PluginFrame frame = random_frame(i);
    VisibilityScene scene;
    Mesh open = random_star(random, frame, true);
    const std::size_t holes = 1 + random.bits() % 4;
    for (std::size_t k = 0; k < holes; ++k) {
      open.triangles.erase(open.triangles.begin() +
                           static_cast<std::ptrdiff_t>(random.bits() % open.triangles.size()));
    }
    add_mesh(scene, open, 1);
    if (i % 2 == 0) add_mesh(scene, random_star(random, frame, true), 2);
    if (i % 3 == 0) {
      const int high = (frame.width - 1) << frame.subpixel_bits;
      for (int k = 0; k < 4; ++k) {
        Corners corners = random_polygon(random, Shape::triangle, 0, high, 0, high);
        scatter(random, corners, Attribute::z, frame.z_far);
        scene.add(corners);
      }
    }
    const std::string what = "scene " + std::to_string(i);
    scene.expect_seen(variants.draw(frame, scene.polygons(), what), frame, false, what);
    if (testing::Test::HasFailure()) return;
  }
}

/// Two open surfaces, each of which has just the edges that the other one lacks.
TEST(Solids, IsNotTakenInByTwoHalves) {
  Variants variants;
  Random random(205);
  for (int i = 0; i < 150; ++i) {
    const PluginFrame frame = random_frame(i);
    const Mesh whole = random_star(random, frame, true);
    Mesh half = whole, rest = whole;
    half.triangles.resize(whole.triangles.size() / 2);
    rest.triangles.erase(rest.triangles.begin(),
                         rest.triangles.begin() + static_cast<std::ptrdiff_t>(half.triangles.size()));
    for (ScreenVertex& v : rest.corners) {  // pushed through the other half
      v.z = std::clamp(v.z + random.integer(-9000, 9000), 0, frame.z_far);
    }
    const std::string what = "scene " + std::to_string(i);
    VisibilityScene two_objects, one_object;
    add_mesh(two_objects, half, 1), add_mesh(two_objects, rest, 2);
    two_objects.expect_seen(variants.draw(frame, two_objects.polygons(), what), frame, false, what);
    // The same ids in the same surface at other places: a host that breaks its word.
    add_mesh(one_object, half, 1), add_mesh(one_object, rest, 1);
    one_object.expect_seen(variants.variant(2).draw(frame, one_object.polygons()), frame, false, what);
    if (testing::Test::HasFailure()) return;
  }
}

/// Corners that clipping made have no id, and their edges no neighbour.
TEST(Solids, FallsBackAtCornersWithoutAnId) {
  Variants variants;
  Random random(206);
  for (int i = 0; i < 100; ++i) {
    const PluginFrame frame = random_frame(i);
    VisibilityScene scene;
    const Mesh mesh = random_star(random, frame, true);
    const auto nameless = static_cast<std::uint32_t>(random.bits() % mesh.corners.size());
    for (const auto& triangle : mesh.triangles) {
      Corners corners;
      PluginPolygon polygon;
      for (const std::uint32_t corner : triangle) {
        corners.push_back(mesh.corners[corner]);
        polygon.ids.push_back(corner == nameless ? FAROP_NO_VERTEX_ID : corner);
      }
      polygon.object_id = polygon.surface_id = 1;
      if (twice_area(corners) <= 0) polygon.flags |= FAROP_POLYGON_BACK_FACING;
      scene.add(corners, std::move(polygon));
    }
    const std::string what = "scene " + std::to_string(i);
    scene.expect_seen(variants.draw(frame, scene.polygons(), what), frame, false, what);
    if (testing::Test::HasFailure()) return;
    EXPECT_LT(variants.statistic(2, "edge_table"), variants.statistic(1, "edge_table"));
  }
}

// ---- the solids that ship -----------------------------------------------------------------------

TEST(Solids, DrawsTheShippedSolidsWithEveryVariant) {
  Variants variants;
  for (const char* name : k_solids) {
    const Scene scene = load_solid(name);
    // The first ones: faces that turn over where others touch them.
    std::vector<int> views = {24, 90, 131, 150, 184};
    for (int view = -1; view < 30; ++view) views.push_back(view);
    for (const int view : views) {
      SolidRequest request;
      request.flat = view % 3 != 0;
      request.subpixel_bits = view % 7 == 5 ? 4 : 0;
      const auto polygons = screen_polygons(
          scene, view < 0 ? own_view(scene) : other_view(scene, static_cast<unsigned>(view)), request);
      ASSERT_FALSE(polygons.at(0).ids.empty()) << name << " " << view;
      PluginFrame frame;
      frame.width = request.width, frame.height = request.height, frame.subpixel_bits = request.subpixel_bits;
      variants.draw(frame, polygons, name + (" from view " + std::to_string(view)));
      EXPECT_GT(variants.statistic(3, "pixels"), 20000);
    }
  }
}

/// So few pixels that rounding folds the surface: a back face comes into sight, and must not stay there for
/// the rest of the line. (Variant 3 cannot show it.)
TEST(Solids, RecoversFromFolds) {
  Variants variants;
  const Scene scene = load_solid("solid-cylinder");
  for (const unsigned view : {64u, 263u}) {
    SolidRequest request;
    request.width = 60, request.height = 90;
    const auto polygons = screen_polygons(scene, other_view(scene, view), request);
    PluginFrame frame;
    frame.width = request.width, frame.height = request.height;
    EXPECT_EQ(variants.variant(1).draw(frame, polygons), variants.variant(2).draw(frame, polygons)) << view;
  }
}

/// Faces of one colour each: at every pixel a face is seen that lies there and has no other one in front.
TEST(Solids, ShowsTheNearestFaceOfTheShippedSolids) {
  PluginDriver driver(FAROP_SOLIDS, {{"variant", "3"}});
  for (const char* name : k_solids) {
    const Scene scene = load_solid(name);
    SolidRequest request;
    request.width = 100, request.height = 150;
    request.triangles = true;  // planar after rounding, too
    VisibilityScene expected;
    PluginFrame frame;
    frame.width = request.width, frame.height = request.height;
    for (PluginPolygon& polygon : screen_polygons(scene, own_view(scene), request)) {
      Corners corners;
      for (const farop_vertex& v : polygon.corners) corners.push_back(vertex(v.x, v.y, v.z));
      expected.add(corners, std::move(polygon));
    }
    expected.expect_seen(driver.draw(frame, expected.polygons()), frame, false, name);
  }
}

TEST(Solids, EntersHalfAndAQuarterOfTheEdges) {
  Variants variants;
  for (const char* name : k_solids) {
    const Scene scene = load_solid(name);
    PluginFrame frame;
    frame.width = 400, frame.height = 600;
    variants.draw(frame, screen_polygons(scene, own_view(scene), {}), name);
    const double all = variants.statistic(1, "edge_table");
    EXPECT_EQ(variants.statistic(2, "edge_table"), all / 2) << name;
    EXPECT_GT(variants.statistic(3, "edge_table"), all * 0.23) << name;
    EXPECT_LT(variants.statistic(3, "edge_table"), all * 0.30) << name;
    EXPECT_EQ(variants.statistic(2, "active_edges_sum"), variants.statistic(1, "active_edges_sum") / 2)
        << name;
    EXPECT_LT(variants.statistic(2, "depth_comparisons"), variants.statistic(1, "depth_comparisons") / 10)
        << name;
    EXPECT_LT(variants.statistic(3, "depth_comparisons"), variants.statistic(2, "depth_comparisons") / 2)
        << name;
  }
}

/// What FAROP sends without --two-sided: the same picture, more work.
TEST(Solids, DrawsWithoutTheBackFaces) {
  Variants variants;
  const Scene scene = load_solid("solid-torus");
  std::vector<PluginPolygon> polygons = screen_polygons(scene, own_view(scene), {});
  PluginFrame frame;
  frame.width = 400, frame.height = 600;
  const PluginPicture picture = variants.draw(frame, polygons, "all faces");
  std::erase_if(polygons, [](const PluginPolygon& p) { return (p.flags & FAROP_POLYGON_BACK_FACING) != 0; });
  const PluginPicture front = variants.draw(frame, polygons, "front faces");
  EXPECT_EQ(variants.statistic(2, "edge_table"), variants.statistic(3, "edge_table"));
  int different = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) different += picture.rgb[i] != front.rgb[i] ? 1 : 0;
  // Back faces that rounding has turned over stand at the outline in one picture only.
  EXPECT_LT(different, 10);
}

// ---- options ------------------------------------------------------------------------------------

TEST(SolidsOptions, RefusesWhatItDoesNotKnow) {
  const std::map<std::string, std::string> wrong[] = {{{"variant", "4"}},
                                                      {{"variant", ""}},
                                                      {{"variant", "12"}},
                                                      {{"variant", "x"}},
                                                      {{"statistics", "yes"}}};
  for (const auto& options : wrong) {
    try {
      PluginDriver driver(FAROP_SOLIDS, options);
      ADD_FAILURE() << options.begin()->first << "=" << options.begin()->second << " was taken";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("create returned -2"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("solids: option " + options.begin()->first), std::string::npos)
          << error.what();
    }
  }
}

TEST(SolidsOptions, TakesVariantThreeIfNotTold) {
  PluginDriver plain(FAROP_SOLIDS, {{"statistics", "1"}}),
      third(FAROP_SOLIDS, {{"statistics", "1"}, {"variant", "3"}});
  const Scene scene = load_solid("hollow-cube");
  PluginFrame frame;
  frame.width = 400, frame.height = 600;
  const auto polygons = screen_polygons(scene, own_view(scene), {});
  EXPECT_EQ(plain.draw(frame, polygons), third.draw(frame, polygons));
  const auto counts = [](const std::string& line) { return line.substr(0, line.find(" build_seconds")); };
  EXPECT_EQ(counts(plain.last_log), counts(third.last_log));
  EXPECT_EQ(counts(plain.last_log).find("statistics edge_table=110 "), 0u) << plain.last_log;
}

TEST(SolidsOptions, LogsNothingIfNotAsked) {
  PluginDriver driver(FAROP_SOLIDS, {{"statistics", "0"}});
  driver.draw({}, std::vector{plugin_polygon(rectangle(2, 2, 9, 9, 5, 1, 2, 3))});
  EXPECT_TRUE(driver.logs.empty());
}

TEST(SolidsOptions, CountsPixels) {
  PluginDriver driver(FAROP_SOLIDS, {{"statistics", "1"}});
  driver.draw({}, std::vector{plugin_polygon(rectangle(10, 10, 30, 20, 5, 1, 2, 3)),
                              plugin_polygon(rectangle(20, 10, 40, 20, 9, 1, 2, 3))});
  ASSERT_EQ(driver.logs.size(), 1u);
  EXPECT_EQ(driver.last_log.find("statistics edge_table=4 active_edges_max=4 active_edges_sum=40 spans=30 "
                                 "depth_comparisons="),
            0u)
      << driver.last_log;
  EXPECT_NE(driver.last_log.find(" pixels=300 build_seconds="), std::string::npos) << driver.last_log;
}

}  // namespace
}  // namespace farop::test
