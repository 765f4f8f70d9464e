// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers: M. Newell, "The Utilization of Procedure Models in Digital Image Synthesis", PhD thesis,
// University of Utah, 1975; times 0.25, lowered by 0.0375, so that the body stands on z = 0. Body and lid are
// revolved curves instead of his patches.
#include <array>
#include <vector>

#include "parse_sipp/shape_builder_internal.h"

namespace farop::sipp {
namespace {

/// A point of the xz plane.
struct Profile {
  double x, z;
};

/// Curves share their end points: 3 n + 1 points for n of them.
std::shared_ptr<Object> revolved(std::span<const Profile> profile, int resolution, const ShapeLook& look) {
  std::vector<V3d> points;
  for (const Profile& p : profile) points.emplace_back(p.x, 0, p.z);
  std::vector<int> curves;
  for (int first = 0; first + 3 < static_cast<int>(profile.size()); first += 3) {
    for (int i = 0; i < 4; ++i) curves.push_back(first + i);
  }
  return bezier_rotcurves(points, curves, resolution, look);
}

/// Two cubic tubes in a row, symmetric in y: seven stations along the tube, at each a point on either side of
/// it in the plane y = 0, and how far the tube reaches out of that plane.
struct Tube {
  std::array<Profile, 7> first, second;
  std::array<double, 7> half_width;
};

/// One point of a tube's cross section: on which side, and the sign of its y.
struct SectionPoint {
  bool second;
  int side;
};

/// One patch: four points of the section, each as a row of four stations.
struct TubePatch {
  std::array<SectionPoint, 4> rows;
  std::array<int, 4> stations;
};

std::shared_ptr<Object> tube_of_patches(const Tube& tube, std::span<const TubePatch> patches, int resolution,
                                        const ShapeLook& look) {
  std::vector<V3d> points;
  std::vector<int> indices;
  for (const TubePatch& patch : patches) {
    for (const SectionPoint& row : patch.rows) {
      for (const int station : patch.stations) {
        const auto at = static_cast<std::size_t>(station);
        const Profile& p = row.second ? tube.second[at] : tube.first[at];
        indices.push_back(static_cast<int>(points.size()));
        points.emplace_back(p.x, row.side * tube.half_width[at], p.z);
      }
    }
  }
  return bezier_patches(points, indices, resolution, look);
}

constexpr std::array<int, 4> k_near = {0, 1, 2, 3}, k_far = {3, 4, 5, 6}, k_far_reversed = {6, 5, 4, 3};

}  // namespace

std::shared_ptr<Object> teapot_body(int resolution, const ShapeLook& look) {
  constexpr std::array<Profile, 10> profile = {{{0.375, 0},
                                                {0.375, 0.01875},
                                                {0.5, 0.075},
                                                {0.5, 0.1875},
                                                {0.5, 0.3},
                                                {0.4375, 0.43125},
                                                {0.375, 0.5625},
                                                {0.359375, 0.5953125},
                                                {0.334375, 0.5953125},
                                                {0.35, 0.5625}}};
  return revolved(profile, resolution, look);
}

std::shared_ptr<Object> teapot_lid(int resolution, const ShapeLook& look) {
  constexpr std::array<Profile, 7> profile = {
      {{0.35, 0.5625}, {0.325, 0.6}, {0.1, 0.6}, {0.05, 0.6375}, {0, 0.675}, {0.2, 0.75}, {0, 0.75}}};
  return revolved(profile, resolution, look);
}

std::shared_ptr<Object> teapot_spout(int resolution, const ShapeLook& look) {
  // First: the upper side; second: the lower one.
  constexpr Tube spout = {{{{0.425, 0.31875},
                            {0.65, 0.31875},
                            {0.575, 0.4875},
                            {0.675, 0.5625},
                            {0.7, 0.58125},
                            {0.725, 0.58125},
                            {0.7, 0.5625}}},
                          {{{0.425, 0.1125},
                            {0.775, 0.16875},
                            {0.6, 0.46875},
                            {0.825, 0.5625},
                            {0.88125, 0.5859375},
                            {0.8625, 0.590625},
                            {0.8, 0.5625}}},
                          {0.165, 0.165, 0.0625, 0.0625, 0.0625, 0.0375, 0.0375}};
  constexpr std::array<SectionPoint, 4> right = {{{true, 0}, {true, -1}, {false, -1}, {false, 0}}};
  constexpr std::array<SectionPoint, 4> left = {{{false, 0}, {false, 1}, {true, 1}, {true, 0}}};
  constexpr std::array<TubePatch, 4> patches = {
      {{right, k_near}, {left, k_near}, {right, k_far}, {left, k_far}}};
  return tube_of_patches(spout, patches, resolution, look);
}

std::shared_ptr<Object> teapot_handle(int resolution, const ShapeLook& look) {
  // First: the outer side; second: the inner one.
  constexpr Tube handle = {{{{-0.375, 0.525},
                             {-0.625, 0.525},
                             {-0.75, 0.525},
                             {-0.75, 0.4125},
                             {-0.75, 0.3},
                             {-0.6625, 0.196875},
                             {-0.475, 0.1125}}},
                           {{{-0.4, 0.46875},
                             {-0.575, 0.46875},
                             {-0.675, 0.46875},
                             {-0.675, 0.4125},
                             {-0.675, 0.35625},
                             {-0.625, 0.24375},
                             {-0.5, 0.1875}}},
                           {0.075, 0.075, 0.075, 0.075, 0.075, 0.075, 0.075}};
  constexpr std::array<SectionPoint, 4> right = {{{false, 0}, {false, -1}, {true, -1}, {true, 0}}};
  constexpr std::array<SectionPoint, 4> left = {{{true, 0}, {true, 1}, {false, 1}, {false, 0}}};
  // The same as left, from the other end of the section: with its stations reversed it faces the same way.
  constexpr std::array<SectionPoint, 4> left_reversed = {{{false, 0}, {false, 1}, {true, 1}, {true, 0}}};
  constexpr std::array<TubePatch, 4> patches = {
      {{right, k_near}, {left, k_near}, {right, k_far}, {left_reversed, k_far_reversed}}};
  return tube_of_patches(handle, patches, resolution, look);
}

std::shared_ptr<Object> teapot(int resolution, const ShapeLook& look) {
  if (resolution < 1) return nullptr;
  // Refused as a whole, before its parts are made.
  ShapeBuilder whole("teapot", 28.0 * resolution * resolution, look);
  std::shared_ptr<Object> object = whole.take();
  object->children = {teapot_body(resolution, look), teapot_lid(resolution, look),
                      teapot_spout(resolution, look), teapot_handle(resolution, look)};
  return object;
}

}  // namespace farop::sipp
