// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>

#include "core/error.h"
#include "scene/bounds.h"
#include "scene/merge.h"
#include "scene/surface_builder.h"
#include "scene/traverse.h"

namespace farop {
namespace {

std::shared_ptr<Surface> triangle_surface() {
  SurfaceBuilder builder;
  builder.begin_polygon(false);
  for (const V3d& p : {V3d(0, 0, 0), V3d(1, 0, 0), V3d(0, 1, 0)}) builder.add_corner(p);
  builder.end_polygon();
  return std::make_shared<Surface>(builder.take());
}

Scene scene_with(const std::string& name) {
  Scene scene;
  auto object = std::make_shared<Object>();
  object->name = name;
  object->surfaces.push_back(triangle_surface());
  scene.root.children.push_back(object);
  scene.inputs.push_back({});
  scene.inputs.back().file = name;
  return scene;
}

TEST(Traverse, TransformationsReachAllSubObjects) {
  Scene scene = scene_with("parent");
  Object& parent = *scene.root.children[0];
  parent.to_parent.setTranslation(V3d(10, 0, 0));
  auto child = std::make_shared<Object>();
  child->to_parent.setScale(V3d(2, 2, 2));
  child->surfaces = parent.surfaces;
  parent.children.push_back(child);
  std::vector<V3d> corner;
  for_each_surface(
      scene, [&](const SurfacePlacement& p) { corner.push_back(p.surface.positions[1] * p.local_to_world); });
  EXPECT_EQ(corner, (std::vector<V3d>{{11, 0, 0}, {12, 0, 0}}));
}

TEST(Traverse, NumbersPlacedObjectsAnewAndSharedSurfacesOnce) {
  Scene scene = scene_with("a");
  const auto first = scene.root.children[0];
  first->surfaces.push_back(triangle_surface());
  auto second = std::make_shared<Object>();
  second->surfaces = {triangle_surface(), first->surfaces[1]};
  auto inner = std::make_shared<Object>();
  inner->surfaces = {first->surfaces[0]};
  first->children.push_back(inner);
  scene.root.children.push_back(second);
  std::vector<std::array<std::size_t, 3>> ids;  // object, surface, input
  for_each_surface(scene, [&](const SurfacePlacement& p) {
    ids.push_back({p.object_id, p.surface_id, p.input});
  });
  EXPECT_EQ(ids,
            (std::vector<std::array<std::size_t, 3>>{{1, 1, 0}, {1, 2, 0}, {2, 1, 0}, {3, 3, 1}, {3, 2, 1}}));
}

TEST(Traverse, TotalsCountInstancesEachTimeAndTheirMemoryOnce) {
  Scene scene = scene_with("a");
  const std::uint64_t single = totals(scene).memory_bytes;
  for (int i = 0; i < 9; ++i) {
    auto instance = std::make_shared<Object>();
    instance->surfaces = scene.root.children[0]->surfaces;
    scene.root.children.push_back(instance);
  }
  const SceneTotals sums = totals(scene);
  EXPECT_EQ(sums.objects, 10u);
  EXPECT_EQ(sums.polygons, 10u);
  EXPECT_EQ(sums.vertices, 30u);
  EXPECT_LT(sums.memory_bytes, single + 20 * sizeof(Object));
}

TEST(Bounds, AreThoseOfTheTransformedVertices) {
  Scene scene = scene_with("a");
  EXPECT_FALSE(world_bounds(Scene{}));
  scene.root.children[0]->to_parent.setTranslation(V3d(5, -5, 1));
  const auto box = world_bounds(scene);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->low, V3d(5, -5, 1));
  EXPECT_EQ(box->high, V3d(6, -4, 1));
}

TEST(Merge, AddsObjectsAndLightsInOrder) {
  Scene scene;
  DiagnosticList messages;
  Scene a = scene_with("a"), b = scene_with("b");
  a.lights.push_back({V3d(1, 1, 1), {}});
  b.lights.push_back({V3d(2, 2, 2), Rgb{1, 0, 0}});
  merge_into(scene, a, messages);
  merge_into(scene, b, messages);
  ASSERT_EQ(scene.root.children.size(), 2u);
  EXPECT_EQ(scene.root.children[1]->name, "b");
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.inputs.size(), 2u);
  EXPECT_TRUE(messages.items.empty());
}

TEST(Merge, OverridesViewParametersOneByOneAndNamesThem) {
  Scene scene = scene_with("a"), next = scene_with("b");
  scene.view.from = V3d(1, 2, 3);
  scene.view.at = V3d(0, 0, 0);
  scene.view.angle = 30;
  scene.view.background = Rgb{0, 0, 1};
  next.view.from = V3d(9, 9, 9);
  next.view.at = V3d(0, 0, 0);
  next.view.yon = 50;
  next.view.background = Rgb{1, 0, 0};
  DiagnosticList messages;
  merge_into(scene, next, messages);
  EXPECT_EQ(scene.view.from, V3d(9, 9, 9));
  EXPECT_EQ(scene.view.angle, 30);
  EXPECT_EQ(scene.view.yon, 50);
  EXPECT_EQ(scene.view.background, (Rgb{1, 0, 0}));
  ASSERT_EQ(messages.items.size(), 1u);
  EXPECT_EQ(messages.items[0].severity, Severity::warning);
  EXPECT_EQ(messages.items[0].where.file, "b");
  EXPECT_EQ(messages.items[0].message, "overrides from, background of the inputs before it");
}

TEST(Camera, CannotBeCompletedWithoutAView) {
  DiagnosticList messages;
  ViewParameters view;
  try {
    complete_camera(view, messages);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.status(), ExitStatus::input);
    EXPECT_NE(std::string(e.what()).find("no view entity"), std::string::npos);
  }
  view.from = view.at = V3d(1, 1, 1);
  try {
    complete_camera(view, messages);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("degenerate view"), std::string::npos);
  }
}

TEST(Camera, DefaultsFillWhatIsMissingWithAWarningEach) {
  DiagnosticList messages;
  ViewParameters view;
  view.from = V3d(0, 0, 5);
  view.at = V3d(0, 0, 0);
  const Camera camera = complete_camera(view, messages);
  EXPECT_EQ(camera.up, V3d(0, 1, 0));
  EXPECT_EQ(camera.angle_degrees, 45);
  EXPECT_EQ(camera.hither, 0);
  EXPECT_EQ(messages.items.size(), 2u);  // up, angle; a missing hither is normal
  EXPECT_EQ(complete_resolution(view, messages), (ViewParameters::Size{512, 512}));
  EXPECT_EQ(messages.items.size(), 3u);
}

TEST(Camera, ParallelUpIsReplacedByTheLeastParallelAxis) {
  DiagnosticList messages;
  ViewParameters view;
  view.from = V3d(0, 0, 5);
  view.at = V3d(0, 0, 0);
  view.up = V3d(0, 0, 2);
  view.angle = 45;
  const Camera camera = complete_camera(view, messages);
  EXPECT_EQ(messages.items.size(), 1u);
  const EyeAxes axes = eye_axes(camera);
  EXPECT_EQ(axes.up, V3d(0, 1, 0));
}

TEST(Camera, EyeSpaceHasXRightYUpAndDepthForward) {
  Camera camera;
  camera.from = V3d(0, 0, 5);
  camera.at = V3d(0, 0, 0);
  camera.up = V3d(0.3, 1, 0.7);
  const M44d m = world_to_eye(camera);
  const V3d ahead = V3d(0, 0, 2) * m;
  EXPECT_NEAR((ahead - V3d(0, 0, 3)).length(), 0, 1e-12);
  camera.up = V3d(0, 1, 0);
  EXPECT_NEAR((V3d(2, 3, 4) * world_to_eye(camera) - V3d(2, 3, 1)).length(), 0, 1e-12);
}

TEST(Camera, NearDistanceIsPositiveEvenWithHitherZero) {
  Camera camera;
  camera.from = V3d(0, 0, 5);
  camera.at = V3d(0, 0, 0);
  EXPECT_DOUBLE_EQ(camera.near_distance(), 5e-6);
  camera.hither = 2;
  EXPECT_DOUBLE_EQ(camera.near_distance(), 2);
}

}  // namespace
}  // namespace farop
