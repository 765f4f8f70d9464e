// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/screen_triangles.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace farop {
namespace {

class Recorder : public ScreenPolygonSink {
 public:
  PolygonWants wants() const override {
    PolygonWants wants;
    wants.vertex_ids = true;
    return wants;
  }
  void begin_frame(const ScreenFrame& f) override { frame = f; }
  void polygons(const ScreenPolygonBatch& b) override { batch = b; }
  void end_frame() override { ended = true; }

  ScreenFrame frame;
  ScreenPolygonBatch batch;
  bool ended = false;
};

std::int64_t twice_area(std::span<const ScreenVertex> corners) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ScreenVertex &a = corners[i], &b = corners[(i + 1) % corners.size()];
    sum += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
  }
  return sum;
}

TEST(ScreenTriangles, CutAConcavePolygonAndLeaveTrianglesAlone) {
  Recorder got;
  ScreenTriangles triangles(got);
  EXPECT_TRUE(triangles.wants().vertex_ids);
  ScreenFrame frame;
  frame.max_vertices = 12;
  triangles.begin_frame(frame);
  EXPECT_EQ(got.frame.max_vertices, 3u);
  ScreenPolygonBatch batch;
  batch.vertices = {
      {0, 0, 1, 10, 0, 0, 0}, {8, 0, 2, 20, 0, 0, 0}, {0, 9, 3, 30, 0, 0, 0},  // triangle
      {0, 0, 4, 40, 0, 0, 0}, {9, 0, 5, 50, 0, 0, 0}, {2, 2, 6, 60, 0, 0, 0}, {0, 9, 7, 70, 0, 0, 0},  // dart
      {5, 5, 8, 80, 0, 0, 0}, {5, 5, 8, 80, 0, 0, 0}, {5, 5, 8, 80, 0, 0, 0}, {5, 5, 8, 80, 0, 0, 0}};
  for (std::uint32_t i = 0; i < batch.vertices.size(); ++i) batch.vertex_ids.push_back(i);
  batch.polygons = {{0, 3, nullptr, true, 4, 5}, {3, 4, nullptr, false, 6, 7}, {7, 4, nullptr, false, 0, 0}};
  triangles.polygons(batch);
  triangles.end_frame();
  EXPECT_TRUE(got.ended);
  ASSERT_EQ(got.batch.polygons.size(), 1u + 2u + 2u);
  EXPECT_TRUE(got.batch.polygons[0].back_facing);
  EXPECT_EQ(got.batch.polygons[2].surface_id, 6u);
  EXPECT_EQ(got.batch.polygons[2].object_id, 7u);
  std::int64_t area = 0;
  for (const ScreenPolygonRecord& record : got.batch.polygons) {
    ASSERT_EQ(record.vertex_count, 3u);
    for (std::uint32_t i = 0; i < 3; ++i) {  // every corner is one of its polygon's, whole
      const std::uint32_t id = got.batch.vertex_ids[record.first_vertex + i];
      EXPECT_EQ(got.batch.vertices[record.first_vertex + i], batch.vertices[id]);
    }
    if (record.surface_id == 6) {
      EXPECT_GT(twice_area(got.batch.corners(record)), 0);
      area += twice_area(got.batch.corners(record));
    }
  }
  EXPECT_EQ(area, twice_area(batch.corners(batch.polygons[1])));
}

}  // namespace
}  // namespace farop
