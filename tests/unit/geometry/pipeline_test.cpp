// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/error.h"
#include "scene/plane.h"
#include "scene/surface_builder.h"
#include "scene/tessellate.h"

namespace farop {
namespace {

/// Keeps what the stage hands over.
class Recorder : public ScreenPolygonSink {
 public:
  explicit Recorder(bool attributes = false) : attributes_(attributes) {}
  PolygonWants wants() const override {
    PolygonWants wants;
    wants.normals = wants.eye_positions = attributes_;
    return wants;
  }
  void begin_frame(const ScreenFrame& f) override { frame = f; }
  void polygons(const ScreenPolygonBatch& batch) override {
    for (const ScreenPolygonRecord& record : batch.polygons) {
      const auto corners = batch.corners(record);
      rings.emplace_back(corners.begin(), corners.end());
      back_facing.push_back(record.back_facing);
      EXPECT_EQ(batch.normals.size(), attributes_ ? batch.vertices.size() : 0u);
      if (attributes_) {
        for (std::uint32_t i = 0; i < record.vertex_count; ++i) {
          normals.push_back(batch.normals[record.first_vertex + i]);
          eye_positions.push_back(batch.eye_positions[record.first_vertex + i]);
        }
      }
    }
  }
  void end_frame() override { ended = true; }

  ScreenFrame frame;
  std::vector<std::vector<ScreenVertex>> rings;
  std::vector<bool> back_facing;
  std::vector<V3f> normals, eye_positions;
  bool ended = false;

 private:
  bool attributes_;
};

/// A scene of one surface, seen from (0,0,10) towards the origin.
struct Bench {
  Scene scene;
  SurfaceBuilder builder;
  GeometryOptions options;
  Camera camera;
  Viewport viewport;
  GeometryReport report;
  GeometryClocks clocks;

  Bench() {
    camera.from = V3d(0, 0, 10);
    camera.at = V3d(0, 0, 0);
    camera.angle_degrees = 90;
    camera.hither = 1;
    viewport.resolution = {201, 201, 65536, 256};
  }
  void add(const std::vector<V3d>& corners) {
    builder.begin_polygon(false);
    for (const V3d& p : corners) builder.add_corner(p);
    builder.end_polygon();
  }
  void add(const std::vector<V3d>& corners, const std::vector<V3d>& normals) {
    builder.begin_polygon(true);
    for (std::size_t i = 0; i < corners.size(); ++i) builder.add_corner(corners[i], normals[i]);
    builder.end_polygon();
  }
  Object& close(const Material& material = {}) {
    auto object = std::make_shared<Object>();
    object->surfaces.push_back(std::make_shared<Surface>(builder.take()));
    object->surfaces.back()->material = material;
    scene.root.children.push_back(object);
    return *object;
  }
  void run(Recorder& recorder) {
    const GeometrySetup setup = prepare_geometry(scene, camera, viewport, options);
    report = run_geometry(scene, setup, options, recorder, clocks);
  }
};

const std::vector<V3d> k_square = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

std::vector<V3d> reversed(std::vector<V3d> ring) {
  return {ring.rbegin(), ring.rend()};
}

TEST(Pipeline, HandsOverAFrontFaceCounterClockwise) {
  Bench bench;
  bench.add(k_square);
  bench.close();
  Recorder got;
  bench.run(got);
  ASSERT_EQ(got.rings.size(), 1u);
  EXPECT_TRUE(got.ended);
  const auto& r = got.rings[0];
  EXPECT_EQ(r[0].x, 90);
  EXPECT_EQ(r[0].y, 90);
  EXPECT_EQ(r[2].x, 110);
  EXPECT_EQ(r[2].y, 110);
  std::int64_t area = 0;
  for (std::size_t i = 0; i < 4; ++i)
    area += std::int64_t{r[i].x} * r[(i + 1) % 4].y - std::int64_t{r[(i + 1) % 4].x} * r[i].y;
  EXPECT_GT(area, 0);
}

/// Wants what a rasterizer may ask for, and keeps the ids.
class IdRecorder : public ScreenPolygonSink {
 public:
  explicit IdRecorder(bool triangles) : triangles_(triangles) {}
  PolygonWants wants() const override {
    PolygonWants wants;
    wants.triangles = triangles_;
    wants.vertex_ids = wants.max_vertices = true;
    return wants;
  }
  void begin_frame(const ScreenFrame& f) override { frame = f; }
  void polygons(const ScreenPolygonBatch& batch) override {
    ASSERT_EQ(batch.vertex_ids.size(), batch.vertices.size());
    for (const ScreenPolygonRecord& record : batch.polygons) {
      EXPECT_LE(record.vertex_count, frame.max_vertices);
      const auto first = batch.vertex_ids.begin() + record.first_vertex;
      ids.emplace_back(first, first + record.vertex_count);
      objects.push_back(record.object_id);
      surfaces.push_back(record.surface_id);
    }
  }
  void end_frame() override {}

  ScreenFrame frame;
  std::vector<std::vector<std::uint32_t>> ids;
  std::vector<std::uint32_t> objects, surfaces;

 private:
  bool triangles_;
};

void run(Bench& bench, ScreenPolygonSink& sink) {
  const GeometrySetup setup = prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options);
  run_geometry(bench.scene, setup, bench.options, sink, bench.clocks);
}

TEST(Pipeline, NamesCornersByTheirVertexAndMarksThoseThatClippingMade) {
  Bench bench;
  bench.add(k_square);                                          // vertices 0 1 2 3
  bench.add({{1, -1, 0}, {3, -1, 0}, {3, 1, 0}, {1, 1, 0}});    // 1 4 5 2: shares an edge
  bench.add({{8, -1, 0}, {12, -1, 0}, {12, 1, 0}, {8, 1, 0}});  // 6 .. 9, across the right side
  bench.close();
  bench.add(k_square);
  bench.close();
  IdRecorder got(false);
  run(bench, got);
  const std::uint32_t made = k_no_vertex_id;
  EXPECT_EQ(got.ids, (std::vector<std::vector<std::uint32_t>>{
                         {0, 1, 2, 3}, {1, 4, 5, 2}, {6, made, made, 9}, {0, 1, 2, 3}}));
  EXPECT_EQ(got.surfaces, (std::vector<std::uint32_t>{1, 1, 1, 2}));
  EXPECT_EQ(got.objects, (std::vector<std::uint32_t>{1, 1, 1, 2}));
  EXPECT_GE(got.frame.max_vertices, 10u);  // a square that all six planes cut
}

TEST(Pipeline, GivesNothingButTrianglesToASinkThatWantsThem) {
  Bench bench;
  bench.add(k_square);
  bench.close();
  IdRecorder got(true);
  run(bench, got);
  EXPECT_EQ(got.frame.max_vertices, 3u);
  ASSERT_EQ(got.ids.size(), 2u);
  EXPECT_EQ(got.ids[0].size(), 3u);
}

TEST(Pipeline, CountsEveryFateAndTheyAddUp) {
  Bench bench;
  bench.add(k_square);                                          // rendered
  bench.add(reversed(k_square));                                // back-facing
  bench.add({{0, -1, 1}, {0, 1, 1}, {0, 1, -1}, {0, -1, -1}});  // edge-on counts as back-facing
  bench.add({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});                 // degenerate
  bench.add({{30, 0, 0}, {31, 0, 0}, {31, 1, 0}});              // beside the window
  bench.add({{-1, -1, 20}, {1, -1, 20}, {0, 1, 20}});           // behind the eye, facing away
  bench.add({{8, -1, 0}, {12, -1, 0}, {12, 1, 0}, {8, 1, 0}});  // across the right side
  bench.close();
  Recorder got;
  bench.run(got);
  const PolygonCounts& c = bench.report.counts;
  EXPECT_EQ(c.loaded, 7u);
  EXPECT_EQ(c.rendered, 2u);
  EXPECT_EQ(c.partly_clipped, 1u);
  EXPECT_EQ(c.degenerate, 1u);
  EXPECT_EQ(c.totally_clipped + c.back_facing, 4u);
  EXPECT_EQ(c.loaded, c.back_facing + c.degenerate + c.totally_clipped + c.rendered);
  EXPECT_EQ(bench.report.degenerate_of_input, (std::vector<std::uint64_t>{1}));
}

TEST(Pipeline, YonAutomaticLiesJustBehindTheFarthestVertex) {
  Bench bench;
  bench.add(k_square);
  bench.add({{-1, -1, -7}, {1, -1, -7}, {0, 1, -7}});
  bench.close();
  const GeometrySetup setup = prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options);
  EXPECT_DOUBLE_EQ(setup.yon, 17 * 1.000001);
  Recorder got;
  bench.run(got);
  EXPECT_EQ(bench.report.counts.rendered, 2u);
}

TEST(Pipeline, YonAutomaticIsTwiceHitherWhenNothingLiesBeyondIt) {
  Bench bench;
  bench.add({{-1, -1, 20}, {1, -1, 20}, {0, 1, 20}});
  bench.close();
  EXPECT_DOUBLE_EQ(prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options).yon, 2);
}

TEST(Pipeline, RefusesAYonBeforeHither) {
  Bench bench;
  bench.camera.yon = 0.5;
  EXPECT_THROW(prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options), Error);
}

TEST(Pipeline, TwoSidedKeepsWhatFacesAwayAndLightsItFromTheEye) {
  Bench bench;
  bench.options.two_sided = true;
  bench.scene.lights.push_back({V3d(0, 0, 1000), Rgb{1, 1, 1}});
  bench.add(reversed(k_square));
  bench.close();
  Recorder got;
  bench.run(got);
  ASSERT_EQ(got.rings.size(), 1u);
  EXPECT_TRUE(got.back_facing[0]);
  EXPECT_EQ(got.rings[0][0].r, 255);  // 0.3 + 1 cos 0, limited
}

TEST(Pipeline, GivenNormalsThatPointToTheBackAreTurnedForLighting) {
  for (const double sign : {1.0, -1.0}) {
    Bench bench;
    Material m;
    m.ka = 0;
    m.kd = 0.5;
    bench.scene.lights.push_back({V3d(0, 0, 1e9), Rgb{1, 1, 1}});
    bench.add(k_square, std::vector<V3d>(4, V3d(0, 0, 3 * sign)));
    bench.close(m);
    Recorder got(true);
    bench.run(got);
    EXPECT_EQ(got.rings[0][0].r, 128);
    EXPECT_EQ(got.normals[0], V3f(0, 0, -1));  // towards the eye, which looks along +z
  }
}

TEST(Pipeline, AZeroGivenNormalFallsBackToThePlane) {
  Bench bench;
  bench.add(k_square, std::vector<V3d>(4, V3d(0, 0, 0)));
  bench.close();
  Recorder got(true);
  bench.run(got);
  EXPECT_EQ(got.normals[0], V3f(0, 0, -1));
}

TEST(Pipeline, FlatTakesTheColourOfTheFirstStoredVertexAlsoWhenItIsClippedAway) {
  Bench bench;
  bench.options.flat = true;
  Material m;
  m.ka = 0;
  m.kd = 1;
  bench.scene.lights.push_back({V3d(0, 0, 10), Rgb{1, 1, 1}});
  // The first corner lies far outside, where the light falls in flat.
  bench.add({{-60, 0, 0}, {0, -1, 0}, {0, 1, 0}});
  bench.close(m);
  Recorder got;
  bench.run(got);
  ASSERT_EQ(got.rings.size(), 1u);
  const int expected = static_cast<int>(round_half_up(255 * (10 / std::hypot(60, 10))));
  EXPECT_GT(got.rings[0].size(), 3u);
  for (const ScreenVertex& v : got.rings[0]) EXPECT_EQ(v.g, expected);
}

TEST(Pipeline, TransformedObjectsEqualTransformedVertices) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int round = 0; round < 200; ++round) {
    M44d m;
    m.rotate(V3d(u(random), u(random), u(random)));
    m.scale(V3d(1 + 0.5 * u(random), 1 + 0.5 * u(random), 1 + 0.5 * u(random)));
    m.translate(V3d(u(random), u(random), u(random)));
    Bench moved, direct;
    for (int i = 0; i < 5; ++i) {
      const std::vector<V3d> ring = {V3d(u(random), u(random), u(random)) * 6.0,
                                     V3d(u(random), u(random), u(random)) * 6.0,
                                     V3d(u(random), u(random), u(random)) * 6.0};
      moved.add(ring);
      direct.add({ring[0] * m, ring[1] * m, ring[2] * m});
    }
    moved.close().to_parent = m;
    direct.close();
    Recorder a, b;
    moved.run(a);
    direct.run(b);
    ASSERT_EQ(moved.report.counts, direct.report.counts);
    for (std::size_t i = 0; i < a.rings.size(); ++i) {
      ASSERT_EQ(a.rings[i].size(), b.rings[i].size());
      for (std::size_t k = 0; k < a.rings[i].size(); ++k) {
        // Two orders of rounding may straddle a rounding boundary of the grid.
        EXPECT_NEAR(a.rings[i][k].x, b.rings[i][k].x, 1);
        EXPECT_NEAR(a.rings[i][k].r, b.rings[i][k].r, 1);
      }
    }
  }
}

TEST(Pipeline, TrianglesKeepVerticesColoursAndCounts) {
  Bench whole, split;
  const std::vector<V3d> concave = {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {0, 0, 0}, {-3, 3, 0}};
  for (Bench* bench : {&whole, &split}) {
    bench->add(concave);
    bench->add(k_square);
    bench->add({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
    bench->close();
  }
  split.options.triangles = true;
  Recorder a, b;
  whole.run(a);
  split.run(b);
  EXPECT_EQ(split.report.counts.rendered, 3u);
  EXPECT_EQ(split.report.counts.split_to_triangles, 2u);
  EXPECT_EQ(split.report.counts.triangles, 3u + 2u + 1u);
  EXPECT_EQ(b.rings.size(), 6u);
  for (const auto& triangle : b.rings) {
    ASSERT_EQ(triangle.size(), 3u);
    for (const ScreenVertex& v : triangle) {
      bool found = false;
      for (const auto& ring : a.rings) found = found || std::find(ring.begin(), ring.end(), v) != ring.end();
      EXPECT_TRUE(found);
    }
  }
}

TEST(Pipeline, HandsOverLongRunsInBatchesWithoutLosingAny) {
  Bench bench;
  for (int i = 0; i < 5000; ++i) {
    const double x = (i % 100) * 0.1 - 5, y = (i / 100) * 0.1 - 3;
    bench.add({{x, y, 0}, {x + 0.09, y, 0}, {x, y + 0.09, 0}});
  }
  bench.close();
  Recorder got;
  bench.run(got);
  EXPECT_EQ(got.rings.size(), 5000u);
  EXPECT_EQ(bench.report.counts.vertices, 15000u);
}

TEST(Pipeline, TipsOfTessellatedConesAreExpectedToBeDegenerate) {
  Bench bench;
  bench.builder.add(Cone{V3d(0, 0, 0), 1, V3d(0, 2, 0), 0, false});
  bench.add({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  bench.close();
  tessellate_scene(bench.scene, {3, std::nullopt});
  Recorder got;
  bench.run(got);
  EXPECT_EQ(bench.report.counts.degenerate, 13u);
  EXPECT_EQ(bench.report.degenerate_of_input, (std::vector<std::uint64_t>{1}));
}

TEST(Pipeline, NormalsSharedMakesAFoldSmooth) {
  Bench bench;
  bench.add({{-1, -1, 0}, {0, -1, 1}, {0, 1, 1}, {-1, 1, 0}});
  bench.add({{0, -1, 1}, {1, -1, 0}, {1, 1, 0}, {0, 1, 1}});
  Object& object = bench.close();
  average_normals(*object.surfaces[0]);
  Recorder got(true);
  bench.run(got);
  EXPECT_NEAR(got.normals[1].z, -1, 1e-6);  // on the fold: between the two planes
  EXPECT_NEAR(got.normals[0].z, -std::sqrt(0.5), 1e-6);
}

// ---------------------------------------------------------------------- what SIPP scenes ask of the stage

/// Its normal rule, and an object's matrix.
Object& close_as_sipp(Bench& bench, const M44d& matrix) {
  Object& object = bench.close();
  object.surfaces.front()->normal_rule = NormalRule::sipp;
  object.to_parent = matrix;
  return object;
}

M44d scaling(double x, double y, double z) {
  M44d m;
  m.setScale(V3d(x, y, z));
  return m;
}

V3d in_world(const V3f& eye_normal) {
  return {eye_normal.x, eye_normal.y, -eye_normal.z};  // of Bench's camera, which looks along -z
}

TEST(SippNormals, AreMovedByTheMatrixItself) {
  for (const bool sipp : {true, false}) {
    Bench bench;
    bench.add(k_square, std::vector<V3d>(4, V3d(0, 1, 1)));
    Object& object = bench.close();
    object.to_parent = scaling(1, 3, 0.5);
    if (sipp) object.surfaces.front()->normal_rule = NormalRule::sipp;
    Recorder got(true);
    bench.run(got);
    ASSERT_EQ(got.normals.size(), 4u);
    const V3d expected = sipp ? V3d(0, 3, 0.5) : V3d(0, 1.0 / 3, 2);  // or by the inverse transpose
    EXPECT_NEAR((in_world(got.normals[0]) - expected.normalized()).length(), 0, 1e-6);
  }
}

TEST(SippNormals, AveragedOnesToo) {
  Bench bench;
  bench.add({{-1, 0, 0}, {1, 0, 0}, {1, 2, 1}, {-1, 2, 1}});  // slopes that meet in y = 0
  bench.add({{-1, -2, 1}, {1, -2, 1}, {1, 0, 0}, {-1, 0, 0}});
  Object& object = close_as_sipp(bench, scaling(1, 1, 2));
  Surface& surface = *object.surfaces.front();
  average_normals(surface);
  surface.averaged_normals[0] = V3d(0.6, 0, 0.8);
  Recorder got(true);
  bench.run(got);
  EXPECT_NEAR((in_world(got.normals[0]) - V3d(0.6, 0, 1.6).normalized()).length(), 0, 1e-6);
}

TEST(SippNormals, ThatPointToTheBackStayAsTheyAre) {
  Bench bench;
  bench.add(k_square, std::vector<V3d>(4, V3d(0, 0, -1)));
  close_as_sipp(bench, M44d());
  Recorder got(true);
  bench.run(got);
  EXPECT_EQ(in_world(got.normals[0]), V3d(0, 0, -1));
}

TEST(MirroredObjects, ShowTheSameSideCounterClockwiseFromTheSameFirstCorner) {
  for (const bool triangles : {false, true}) {
    Bench bench;
    bench.options.triangles = triangles;
    bench.add({{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {0, 0, 0}, {-3, 3, 0}});
    close_as_sipp(bench, scaling(-1, 1, 1));
    Recorder got;
    bench.run(got);
    EXPECT_EQ(bench.report.counts.rendered, 1u);
    std::int64_t doubled_area = 0;
    for (const auto& r : got.rings) {
      std::int64_t doubled = 0;
      for (std::size_t i = 0; i < r.size(); ++i) {
        const ScreenVertex &a = r[i], &b = r[(i + 1) % r.size()];
        doubled += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
      }
      EXPECT_GE(doubled, 0);
      doubled_area += doubled;
    }
    EXPECT_EQ(doubled_area, 2 * (60 * 60 - 60 * 30 / 2));
    EXPECT_EQ(got.rings.size(), triangles ? 3u : 1u);
    EXPECT_TRUE(triangles || got.rings[0][0].x == 130);
  }
}

TEST(MirroredObjects, DropTheSameSideAsBefore) {
  Bench bench;
  bench.add(reversed(k_square));
  close_as_sipp(bench, scaling(-1, 1, 1));
  Recorder got;
  bench.run(got);
  EXPECT_EQ(bench.report.counts.back_facing, 1u);
}

struct DepthCase {
  const char* what;
  double hither, yon, nearest, farthest;  ///< of the camera; of the depths that come out
};

TEST(FitDepth, SpreadsDepthsOverTheVerticesWithinThePlanes) {
  // Vertices from 8 to 12 in front of the eye.
  constexpr DepthCase cases[] = {{"planes far outside", 0.1, 1000, 8 * 0.999999, 12 * 1.000001},
                                 {"a vertex before hither", 9, 1000, 9, 12 * 1.000001},
                                 {"a vertex beyond yon", 0.1, 11, 8 * 0.999999, 11},
                                 {"both", 9, 11, 9, 11}};
  for (const DepthCase& c : cases) {
    Bench bench;
    bench.add({{-1, -1, 2}, {1, -1, 2}, {0, 1, -2}});
    bench.close();
    bench.camera.hither = c.hither, bench.camera.yon = c.yon;
    bench.camera.fit_depth = true;
    const GeometrySetup setup = prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options);
    EXPECT_DOUBLE_EQ(setup.nearest_depth, c.nearest) << c.what;
    EXPECT_DOUBLE_EQ(setup.farthest_depth, c.farthest) << c.what;
    EXPECT_EQ(setup.hither, c.hither) << c.what;
    EXPECT_EQ(setup.yon, c.yon) << c.what;
    Recorder got;
    bench.run(got);
    ASSERT_EQ(got.rings.size(), 1u);
    const auto [low, high] = std::minmax_element(got.rings[0].begin(), got.rings[0].end(),
                                                 [](const auto& a, const auto& b) { return a.z < b.z; });
    EXPECT_EQ(low->z, 0) << c.what;
    EXPECT_EQ(high->z, 65535) << c.what;
  }
}

TEST(FitDepth, WithoutAnythingBetweenThePlanesTheyCount) {
  Bench bench;
  bench.add({{-1, -1, 2}, {1, -1, 2}, {0, 1, -2}});
  bench.close();
  bench.camera.hither = 20, bench.camera.yon = 30;
  bench.camera.fit_depth = true;
  const GeometrySetup setup = prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options);
  EXPECT_EQ(setup.nearest_depth, 20);
  EXPECT_EQ(setup.farthest_depth, 30);
}

/// Opacity and colour by texture coordinates, so that it shows what arrives.
class Gauge : public Shader {
 public:
  Shaded shade(const ShadingPoint& point, const ShadingFrame&) const override {
    return {{point.texture.x, point.texture.y, point.texture.z}, {point.texture.z, point.texture.x, 0.25}};
  }
  bool opaque() const override { return false; }
  bool wants_texture() const override { return true; }
  Material approximate(std::vector<std::string>*) const override { return {}; }
  std::string describe() const override { return "gauge"; }
};

class TextureRecorder : public ScreenPolygonSink {
 public:
  PolygonWants wants() const override {
    PolygonWants wants;
    wants.textures = wants.opacities = true;
    wants.triangles = triangles;
    return wants;
  }
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& b) override {
    EXPECT_EQ(b.textures.size(), b.vertices.size());
    EXPECT_EQ(b.opacities.size(), b.vertices.size());
    batch = b;
  }
  void end_frame() override {}
  bool triangles = false;
  ScreenPolygonBatch batch;
};

TEST(Shaders, AreCalledWithTheTextureCoordinatesOfEveryCornerAlsoOfCutOnes) {
  for (const bool triangles : {false, true}) {
    Bench bench;
    bench.add({{-20, -1, 0}, {20, -1, 0}, {20, 1, 0}, {-20, 1, 0}});  // the window ends at +-10
    Object& object = bench.close();
    Surface& surface = *object.surfaces.front();
    const auto gauge = std::make_shared<const Gauge>();
    surface.shader = gauge;
    surface.textures = {V3f(0, 0, 0.5f), V3f(1, 0, 0.5f), V3f(1, 1, 0.5f), V3f(0, 1, 0.5f)};
    TextureRecorder got;
    got.triangles = triangles;
    const GeometrySetup setup = prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options);
    run_geometry(bench.scene, setup, bench.options, got, bench.clocks);
    ASSERT_EQ(got.batch.polygons.size(), triangles ? 2u : 1u);
    for (const ScreenPolygonRecord& record : got.batch.polygons) {
      EXPECT_EQ(record.shader, gauge.get());
      for (std::uint32_t i = record.first_vertex; i < record.first_vertex + record.vertex_count; ++i) {
        const ScreenVertex& v = got.batch.vertices[i];
        const V3f& t = got.batch.textures[i];
        EXPECT_NEAR(t.x, v.x == 0 ? 0.25 : 0.75, 1e-6);
        EXPECT_NEAR(v.r, 255 * t.x, 0.51);
        EXPECT_NEAR(v.g, 255 * t.y, 0.51);
        EXPECT_NEAR(v.b, 127.5, 0.51);
        EXPECT_EQ(got.batch.opacities[i], V3f(0.5f, t.x, 0.25f));
      }
    }
  }
}

TEST(Shaders, UnlitDrawingDoesNotCallThem) {
  class Trap : public Gauge {
   public:
    Shaded shade(const ShadingPoint&, const ShadingFrame&) const override {
      ADD_FAILURE();
      return {};
    }
  };
  for (const bool flat : {false, true}) {
    Bench bench;
    bench.add(k_square);
    bench.close().surfaces.front()->shader = std::make_shared<const Trap>();
    bench.options.unlit = true, bench.options.flat = flat;
    Recorder got;
    bench.run(got);
    EXPECT_EQ(got.rings.size(), 1u);
  }
}

TEST(Lights, ReachTheStageInEyeSpaceWithoutThoseThatAreOff) {
  Bench bench;
  Light off, sun, spot;
  off.active = false;
  sun.kind = LightKind::directional, sun.position = V3d(0, 0, 1);
  spot.kind = LightKind::spot_soft, spot.position = V3d(1, 2, 3), spot.target = V3d(1, 2, -5),
  spot.opening_degrees = 60;
  spot.color = Rgb{1, 2, 3};
  bench.scene.lights = {off, sun, spot};
  const GeometrySetup setup = prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options);
  ASSERT_EQ(setup.shading.lights.size(), 2u);
  EXPECT_EQ(setup.shading.lights[0].position, V3d(0, 0, -1)) << "towards the eye, against the depth axis";
  EXPECT_NEAR((setup.shading.lights[1].position - V3d(1, 2, 7)).length(), 0, 1e-12);
  EXPECT_NEAR((setup.shading.lights[1].axis - V3d(0, 0, 1)).length(), 0, 1e-12);
  EXPECT_NEAR(setup.shading.lights[1].cos_half_angle, std::sqrt(0.75), 1e-12);
  EXPECT_EQ(setup.shading.lights[1].color, (Rgb{1, 2, 3}));
  bench.scene.lights = {off};
  EXPECT_TRUE(
      prepare_geometry(bench.scene, bench.camera, bench.viewport, bench.options).shading.lights.empty());
}

}  // namespace
}  // namespace farop
