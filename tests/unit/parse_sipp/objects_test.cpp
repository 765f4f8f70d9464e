// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"
#include "parse_sipp/sipp_objects.h"
#include "parse_sipp/sipp_shapes.h"
#include "parse_sipp/sipp_transform.h"
#include "scene/traverse.h"

namespace farop::sipp {
namespace {

/// An arm: a block, moved, with a moved sphere as sub-object.
std::shared_ptr<Object> arm() {
  auto top = block(V3d(1, 2, 3), {});
  top->to_parent.setTranslation(V3d(5, 0, 0));
  auto child = sphere(1, 8, {});
  child->to_parent.setTranslation(V3d(0, 7, 0));
  top->children.push_back(child);
  return top;
}

TEST(SippObjects, AnInstanceSharesChildrenAndSurfacesAndStandsAtTheOrigin) {
  const auto original = arm();
  const auto copy = instance(*original);
  EXPECT_EQ(copy->to_parent, M44d());
  EXPECT_EQ(copy->children, original->children);
  EXPECT_EQ(copy->surfaces, original->surfaces);
}

TEST(SippObjects, ADupSharesSurfacesOnlyAndLosesAllMatrices) {
  const auto original = arm();
  const auto copy = dup(*original);
  EXPECT_EQ(copy->to_parent, M44d());
  EXPECT_EQ(copy->surfaces, original->surfaces);
  ASSERT_EQ(copy->children.size(), 1u);
  EXPECT_NE(copy->children[0], original->children[0]);
  EXPECT_EQ(copy->children[0]->to_parent, M44d());
  EXPECT_EQ(copy->children[0]->surfaces, original->children[0]->surfaces);
}

TEST(SippObjects, ADeepDupSharesNothingButShaders) {
  const auto original = arm();
  const auto copy = deep_dup(*original);
  EXPECT_EQ(copy->children[0]->to_parent, M44d());
  ASSERT_EQ(copy->surfaces.size(), 6u);
  EXPECT_NE(copy->surfaces[0], original->surfaces[0]);
  EXPECT_EQ(copy->surfaces[0]->positions, original->surfaces[0]->positions);
  EXPECT_EQ(copy->surfaces[0]->polygons, original->surfaces[0]->polygons);
  EXPECT_EQ(copy->surfaces[0]->averaged_normals, original->surfaces[0]->averaged_normals);
  EXPECT_EQ(copy->surfaces[0]->shader, original->surfaces[0]->shader);
  EXPECT_NE(copy->children[0]->surfaces[0], original->children[0]->surfaces[0]);
}

TEST(SippObjects, CopiesOfTreesThatNoMemoryHoldsAreRefused) {
  auto object = cube(1, {});
  for (int level = 0; level < 60; ++level) {
    auto parent = std::make_shared<Object>();
    parent->children = {object, object};
    object = parent;
  }
  const TreeSize size = tree_size(*object);
  EXPECT_EQ(size.objects, (std::uint64_t{1} << 61) - 1);
  EXPECT_EQ(size.depth, 61u);
  EXPECT_THROW(dup(*object), Error);
  EXPECT_THROW(deep_dup(*object), Error);
  for (int level = 0; level < 10; ++level) {
    auto parent = std::make_shared<Object>();
    parent->children = {object, object};
    object = parent;
  }
  EXPECT_EQ(tree_size(*object).polygons, std::uint64_t{1} << 63);
}

TEST(SippObjects, DeepTreesAreMeasuredAndRefused) {
  std::vector<std::shared_ptr<Object>> chain{std::make_shared<Object>()};
  for (int level = 1; level < 100'000; ++level) {
    chain.push_back(std::make_shared<Object>());
    chain.back()->children = {chain[chain.size() - 2]};
  }
  EXPECT_EQ(tree_size(*chain.back()).depth, 100'000u);
  EXPECT_THROW(dup(*chain.back()), Error);
  EXPECT_TRUE(contains(*chain.back(), *chain.front()));
  EXPECT_FALSE(contains(*chain.front(), *chain.back()));
  EXPECT_TRUE(contains(*chain.front(), *chain.front()));
  while (!chain.empty()) chain.pop_back();  // from the top: freeing the chain by itself would be recursive
}

/// World positions of all vertices, in the order of drawing.
std::vector<V3d> world_positions(const Object& object) {
  std::vector<V3d> out;
  for_each_surface(object, M44d(), [&](const SurfacePlacement& placed) {
    for (const V3d& p : placed.surface.positions) out.push_back(p * placed.local_to_world);
  });
  return out;
}

TEST(SippObjects, MovingAParentMovesEveryDescendant) {
  const auto tree = arm();
  auto grandchild = cone(1, 0, 2, 9, {});
  grandchild->to_parent.setEulerAngles(V3d(0.1, 0.2, 0.3));
  tree->children[0]->children.push_back(grandchild);
  const std::vector<V3d> before = world_positions(*tree);
  M44d m;
  rotate(m, V3d(1, 2, 3), V3d(0, 1, 1), 0.7);
  scale(m, V3d(1, 2, -0.5));
  translate(m, V3d(-4, 0, 2));
  transform(tree->to_parent, m);
  const std::vector<V3d> after = world_positions(*tree);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR((after[i] - before[i] * m).length(), 0, 1e-12);
  }
}

TEST(SippObjects, TenThousandInstancesShareTheirPolygons) {
  const auto original = torus(1, 0.4, 40, 25, {});
  Scene scene;
  scene.root.children.push_back(std::make_shared<Object>());
  Object& world = *scene.root.children[0];
  for (int i = 0; i < 10'000; ++i) world.children.push_back(instance(*original));
  const SceneTotals sums = totals(scene);
  EXPECT_EQ(sums.polygons, 10'000'000u);
  // 2.6 MB, where as many tori would have 0.8 GB.
  EXPECT_LT(sums.memory_bytes, 3'000'000u);
  scene.root.children[0] = original;
  EXPECT_GT(totals(scene).memory_bytes, 80'000u);
}

TEST(SippObjects, SizesAgreeWithTheSceneTotals) {
  Scene scene;
  const auto one = arm();
  scene.root.children = {one, instance(*one), deep_dup(*one)};
  const SceneTotals expected = totals(scene);
  const TreeSize size = tree_size(scene.root);
  EXPECT_EQ(size.objects, expected.objects + 1);
  EXPECT_EQ(size.polygons, expected.polygons);
}

}  // namespace
}  // namespace farop::sipp
