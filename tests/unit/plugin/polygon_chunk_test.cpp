// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/polygon_chunk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "shading/material.h"

namespace farop {
namespace {

std::vector<farop_vertex> ring(std::initializer_list<std::pair<int, int>> points) {
  std::vector<farop_vertex> corners;
  for (const auto& [x, y] : points) corners.push_back({x, y, 0, 0, 0, 0, 0});
  return corners;
}

TEST(Convex, IsTrueForOneTurnRoundWhicheverWayAndWhereverItStarts) {
  std::vector<std::vector<farop_vertex>> convex = {
      ring({{0, 0}, {4, 0}, {0, 3}}), ring({{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}}),
      ring({{0, 0}, {0, 0}, {4, 0}, {4, 4}, {4, 4}}), ring({{5, 0}, {9, 3}, {7, 8}, {2, 8}, {0, 3}})};
  for (std::vector<farop_vertex>& corners : convex) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      EXPECT_TRUE(is_convex(corners));
    }
    std::reverse(corners.begin(), corners.end());
    EXPECT_TRUE(is_convex(corners));
  }
}

TEST(Convex, IsFalseForNotchesTwoTurnsAndWhatHasNoArea) {
  const std::vector<std::vector<farop_vertex>> others = {
      ring({{0, 0}, {4, 0}, {1, 1}, {0, 4}}),          // notch
      ring({{0, 0}, {4, 4}, {4, 0}, {0, 4}}),          // bow-tie
      ring({{5, 0}, {2, 8}, {9, 3}, {0, 3}, {7, 8}}),  // pentagram: turns one way, twice round
      ring({{0, 0}, {4, 0}, {2, 0}}),
      ring({{3, 3}, {3, 3}, {3, 3}}),
      ring({{0, 0}, {4, 0}, {4, 4}, {4, 0}, {0, 4}}),  // out and back
      ring({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}})};
  for (const std::vector<farop_vertex>& corners : others) EXPECT_FALSE(is_convex(corners));
}

struct Batches {
  Material glass;
  ScreenPolygonBatch batch;
  Batches() {
    glass.transmittance = 0.75;
    glass.kd = 0.5;
    batch.vertices = {{1, 2, 3, 10, 20, 30, 0}, {4, 5, 6, 40, 50, 60, 0}, {7, 9, 9, 70, 80, 90, 0},
                      {0, 0, 0, 0, 0, 0, 0},    {5, 0, 0, 0, 0, 0, 0},    {0, 5, 0, 511, 511, 511, 0}};
    for (int i = 0; i < 6; ++i) {
      batch.normals.emplace_back(0, 0, static_cast<float>(i));
      batch.eye_positions.emplace_back(1, 2, static_cast<float>(i));
      batch.vertex_ids.push_back(100u + static_cast<unsigned>(i));
    }
    batch.polygons.push_back({0, 3, &glass, false, 7, 1});
    batch.polygons.push_back({3, 3, &glass, true, 7, 2});
  }
};

constexpr std::uint32_t k_all =
    FAROP_WANT_NORMALS | FAROP_WANT_EYE_POSITIONS | FAROP_WANT_VERTEX_IDS | FAROP_WANT_MATERIAL;

struct Seen {
  std::vector<std::uint32_t> indices, flags, surfaces, objects, ids;
  std::vector<farop_vertex> vertices;
  std::vector<float> normal_z, opacity;
  int missing = 0;
};

farop_rasterizer recorder() {
  farop_rasterizer table{};
  table.polygon = [](void* self, const farop_polygon* p) -> farop_status {
    Seen& seen = *static_cast<Seen*>(self);
    seen.indices.push_back(p->index);
    seen.flags.push_back(p->flags);
    seen.surfaces.push_back(p->surface_id);
    seen.objects.push_back(p->object_id);
    seen.vertices.insert(seen.vertices.end(), p->vertices, p->vertices + p->vertex_count);
    if (p->normals == nullptr || p->vertex_ids == nullptr || p->material == nullptr) {
      ++seen.missing;
    } else {
      seen.normal_z.push_back(p->normals[1].z);
      seen.ids.push_back(p->vertex_ids[2]);
      seen.opacity.push_back(p->material->opacity[2]);
    }
    return seen.indices.size() == 5 ? FAROP_E_INTERNAL : FAROP_OK;
  };
  return table;
}

/// A packed chunk in a block of exactly its size, so that a sanitizer sees the ends.
struct Block {
  explicit Block(const PolygonChunk& chunk)
      : size(chunk.packed_bytes()),
        memory(static_cast<std::byte*>(std::aligned_alloc(16, size)), &std::free) {
    chunk.pack({memory.get(), size});
  }
  std::size_t size;
  std::unique_ptr<std::byte, decltype(&std::free)> memory;
};

TEST(PolygonChunk, HandsOverEverythingThatWasAskedForInOrder) {
  const Batches given;
  PolygonChunk chunk(k_all);
  chunk.begin_frame(512);
  chunk.append(given.batch);
  chunk.append(given.batch);
  volatile std::uint32_t current = 0;
  Seen seen;
  const farop_rasterizer table = recorder();
  const Block block(chunk);
  const auto packed = PolygonChunk::unpack({block.memory.get(), block.size});
  ASSERT_TRUE(packed);
  EXPECT_EQ(play_chunk(table, &seen, *packed, &current), FAROP_OK);
  EXPECT_EQ(seen.indices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  const std::uint32_t convex = FAROP_POLYGON_CONVEX, back = FAROP_POLYGON_BACK_FACING;
  EXPECT_EQ(seen.flags, (std::vector<std::uint32_t>{convex, convex | back, convex, convex | back}));
  EXPECT_EQ(seen.objects, (std::vector<std::uint32_t>{1, 2, 1, 2}));
  EXPECT_EQ(seen.surfaces, (std::vector<std::uint32_t>{7, 7, 7, 7}));
  EXPECT_EQ(seen.normal_z, (std::vector<float>{1, 4, 1, 4}));
  EXPECT_EQ(seen.ids, (std::vector<std::uint32_t>{102, 105, 102, 105}));
  EXPECT_EQ(seen.opacity, std::vector<float>(4, 0.25f));
  ASSERT_EQ(seen.vertices.size(), 12u);
  EXPECT_EQ(seen.vertices[1].y, 5);
  EXPECT_EQ(seen.vertices[1].z, 6);
  // CRES 512 -> 8 bits: round(255 c / 511).
  EXPECT_EQ(seen.vertices[2].r, 35);
  EXPECT_EQ(seen.vertices[5].b, 255);
  EXPECT_EQ(current, 3u);
}

TEST(PolygonChunk, NumbersGoOnAndANegativeStatusEndsTheWalk) {
  const Batches given;
  PolygonChunk chunk(k_all);
  chunk.begin_frame(256);
  chunk.append(given.batch);
  chunk.clear();
  chunk.append(given.batch);
  volatile std::uint32_t current = 0;
  Seen seen;
  const farop_rasterizer table = recorder();
  EXPECT_EQ(play_chunk(table, &seen, chunk.view(), &current), FAROP_OK);
  EXPECT_EQ(seen.indices, (std::vector<std::uint32_t>{2, 3}));
  chunk.clear();
  chunk.append(given.batch);
  chunk.append(given.batch);
  EXPECT_EQ(play_chunk(table, &seen, chunk.view(), &current), FAROP_E_INTERNAL);
  EXPECT_EQ(seen.indices.size(), 5u);
  EXPECT_EQ(current, 6u);
}

TEST(PolygonChunk, GivesNullForWhatTheSceneHasNotOrNobodyWants) {
  Batches given;
  volatile std::uint32_t current = 0;
  const farop_rasterizer table = recorder();
  for (const std::uint32_t wants : {0u, k_all}) {
    if (wants != 0) {
      given.batch.normals.clear(), given.batch.eye_positions.clear(), given.batch.vertex_ids.clear();
      for (ScreenPolygonRecord& p : given.batch.polygons) p.material = nullptr;
    }
    PolygonChunk chunk(wants);
    chunk.begin_frame(256);
    chunk.append(given.batch);
    Seen seen;
    const Block block(chunk);
    play_chunk(table, &seen, PolygonChunk::unpack({block.memory.get(), block.size}).value(), &current);
    EXPECT_EQ(seen.missing, 2);
  }
}

TEST(PolygonChunk, RefusesBlocksWhoseNumbersDoNotFit) {
  const Batches given;
  PolygonChunk chunk(k_all);
  chunk.begin_frame(256);
  chunk.append(given.batch);
  const Block block(chunk);
  const std::span<std::byte> memory(block.memory.get(), block.size);
  for (std::size_t size = 0; size < block.size; ++size) {
    EXPECT_FALSE(PolygonChunk::unpack(memory.first(size))) << size;
  }
  for (std::size_t byte = 0; byte < 16; ++byte) {  // counts and wishes of the header
    memory[byte] ^= std::byte{0x40};
    // A wish bit without an array of its own changes nothing; everything else does.
    EXPECT_TRUE(byte >= 12 || !PolygonChunk::unpack(memory)) << byte;
    memory[byte] ^= std::byte{0x40};
  }
  EXPECT_TRUE(PolygonChunk::unpack(memory));
}

}  // namespace
}  // namespace farop
