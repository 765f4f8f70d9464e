// SPDX-License-Identifier: GPL-3.0-or-later
// The batched path hands over what the plain path does, bit for bit: random scenes in all modes, every
// instruction set, several threads.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "geometry/batched/kernels.h"
#include "random_scene.h"
#include "support/sanitizers.h"
#include "support/vector_targets.h"

namespace farop {
namespace {

/// Everything that comes, whatever the batches.
class Everything : public ScreenPolygonSink {
 public:
  explicit Everything(const PolygonWants& wants) : wants_(wants) {}
  PolygonWants wants() const override { return wants_; }
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& b) override {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (ScreenPolygonRecord record : b.polygons) {
      record.first_vertex += first;
      all.polygons.push_back(record);
    }
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.vertices, b.vertices), append(all.normals, b.normals);
    append(all.eye_positions, b.eye_positions), append(all.vertex_ids, b.vertex_ids);
    append(all.textures, b.textures), append(all.opacities, b.opacities);
  }
  void end_frame() override {}

  ScreenPolygonBatch all;
  PolygonCounts counts;
  std::vector<std::uint64_t> degenerate;
  std::vector<V3d> shaded;

 private:
  PolygonWants wants_;
};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_record(const ScreenPolygonRecord& a, const ScreenPolygonRecord& b) {
  return a.first_vertex == b.first_vertex && a.vertex_count == b.vertex_count && a.material == b.material &&
         a.back_facing == b.back_facing && a.surface_id == b.surface_id && a.object_id == b.object_id &&
         a.shader == b.shader;
}

/// What differs, or nothing.
std::string difference(const Everything& a, const Everything& b) {
  if (a.counts != b.counts) return "counts";
  if (a.degenerate != b.degenerate) return "degenerate polygons by input";
  const bool records = std::equal(a.all.polygons.begin(), a.all.polygons.end(), b.all.polygons.begin(),
                                  b.all.polygons.end(), same_record);
  if (!records) return "records";
  for (std::size_t i = 0; i < a.all.vertices.size(); ++i) {
    const ScreenVertex &v = a.all.vertices[i], &w = b.all.vertices[i];
    if (v == w) continue;
    const bool place = v.x == w.x && v.y == w.y && v.z == w.z;
    const auto text = [place](const ScreenVertex& c) {
      const auto [p, q, r] = place ? std::array<int, 3>{c.r, c.g, c.b} : std::array<int, 3>{c.x, c.y, c.z};
      return std::to_string(p) + ' ' + std::to_string(q) + ' ' + std::to_string(r);
    };
    return (place ? "colour of corner " : "place of corner ") + std::to_string(i) + ": " + text(v) + ", " +
           text(w);
  }
  if (!same_bits(a.all.normals, b.all.normals)) return "normals";
  if (!same_bits(a.all.eye_positions, b.all.eye_positions)) return "eye positions";
  if (!same_bits(a.all.vertex_ids, b.all.vertex_ids)) return "vertex ids";
  if (!same_bits(a.all.textures, b.all.textures)) return "texture coordinates";
  if (!same_bits(a.all.opacities, b.all.opacities)) return "opacities";
  if (!same_bits(a.shaded, b.shaded)) return "calls of shaders that are not pure";
  return {};
}

Everything run(const test::RandomScene& scene, GeometryPath path, int threads) {
  Everything got(scene.wants);
  GeometryOptions options = scene.options;
  options.path = path, options.threads = threads;
  GeometryClocks clocks;
  scene.shaded->clear();
  const GeometryReport report = run_geometry(scene.scene, test::prepare(scene), options, got, clocks);
  got.counts = report.counts, got.degenerate = report.degenerate_of_input;
  got.shaded = *scene.shaded;
  return got;
}

TEST(Batched, HandsOverWhatThePlainPathDoesOnEveryInstructionSet) {
  const int scenes = std::getenv("FAROP_LONG_TESTS") != nullptr ? 20'000 : test::rounds(250);
  const std::vector<std::int64_t> targets = test::vector_targets();
  PolygonCounts seen;
  for (int i = 0; i < scenes; ++i) {
    const test::RandomScene scene = test::random_scene(static_cast<std::uint32_t>(i));
    const Everything plain = run(scene, GeometryPath::plain, 1);
    seen.rendered += plain.counts.rendered, seen.partly_clipped += plain.counts.partly_clipped;
    seen.totally_clipped += plain.counts.totally_clipped, seen.degenerate += plain.counts.degenerate;
    for (const std::int64_t target : targets) {
      const test::VectorTarget only(target);
      ASSERT_EQ(difference(plain, run(scene, GeometryPath::batched, 1)), "")
          << "scene " << i << ", target " << hwy::TargetName(target);
    }
    const int threads = 2 + i % 3;
    ASSERT_EQ(difference(plain, run(scene, GeometryPath::batched, threads)), "")
        << "scene " << i << ", " << threads << " threads";
  }
  EXPECT_GT(seen.rendered, 10'000u);
  EXPECT_GT(seen.partly_clipped, 1'000u);
  EXPECT_GT(seen.totally_clipped, 1'000u);
  EXPECT_GT(seen.degenerate, 100u);
}

TEST(Batched, KeepsTheOrderOfSurfacesThatManyThreadsWorkOn) {
  test::RandomScene scene = test::random_scene(1);
  scene.options = {}, scene.wants = {};
  const std::vector<std::shared_ptr<Object>> children = scene.scene.root.children;
  for (int i = 0; i < 300; ++i) {
    for (const auto& child : children) scene.scene.root.children.push_back(child);
  }
  const Everything plain = run(scene, GeometryPath::plain, 1);
  ASSERT_GT(plain.all.vertices.size(), 100'000u);
  for (const int threads : {0, 1, 2, 3, 8})
    ASSERT_EQ(difference(plain, run(scene, GeometryPath::batched, threads)), "") << threads << " threads";
}

TEST(Batched, FindsTheNearestAndFarthestVertexOnEveryInstructionSet) {
  std::vector<V3d> points;
  for (int i = 0; i < 37; ++i) points.emplace_back(std::sin(i), std::cos(3 * i), std::sin(7 * i));
  for (std::size_t size = 0; size <= points.size(); ++size) {
    double nearest = 0.1, farthest = 0.2;
    for (std::size_t i = 0; i < size; ++i) {
      const V3d& p = points[i];
      const double depth = p.x * 0.3 + p.y * -0.7 + p.z * 0.9 + 0.1;
      nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
    }
    for (const std::int64_t target : test::vector_targets()) {
      const test::VectorTarget only(target);
      double low = 0.1, high = 0.2;
      batched::depth_range({points.data(), size}, 0.3, -0.7, 0.9, 0.1, low, high);
      EXPECT_EQ(low, nearest) << size;
      EXPECT_EQ(high, farthest) << size;
    }
  }
}

}  // namespace
}  // namespace farop
