// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "parse_sipp/sipp_transform.h"

namespace farop::sipp {
namespace {

constexpr double k_pi = std::numbers::pi;

void expect_near(const V3d& a, const V3d& b) {
  EXPECT_NEAR((a - b).length(), 0, 1e-12) << a << " instead of " << b;
}

TEST(SippTransform, QuarterTurnsAreExactAndRightHanded) {
  M44d m;
  rotate_x(m, k_pi / 2);
  EXPECT_EQ(V3d(0, 1, 0) * m, V3d(0, 0, 1));
  m.makeIdentity();
  rotate_y(m, k_pi / 2);
  EXPECT_EQ(V3d(0, 0, 1) * m, V3d(1, 0, 0));
  m.makeIdentity();
  rotate_z(m, k_pi / 2);
  EXPECT_EQ(V3d(1, 0, 0) * m, V3d(0, 1, 0));
}

TEST(SippTransform, HappensAfterWhatIsThere) {
  M44d m;
  translate(m, V3d(1, 0, 0));
  rotate_z(m, k_pi / 2);
  EXPECT_EQ(V3d(0, 0, 0) * m, V3d(0, 1, 0));  // moved, then turned about the origin
  scale(m, V3d(2, 3, 4));
  EXPECT_EQ(V3d(0, 0, 0) * m, V3d(0, 3, 0));  // the translation is scaled too
  M44d by;
  by.setTranslation(V3d(0, 0, 5));
  transform(m, by);
  EXPECT_EQ(V3d(0, 0, 0) * m, V3d(0, 3, 5));
}

TEST(SippTransform, TurnsAboutALineWithTheRightHand) {
  for (const V3d& direction : {V3d(0, 0, 2), V3d(1, 2, 3), V3d(-1, 0.5, -4), V3d(0, 0, -1), V3d(3, 0, 0)}) {
    const V3d point(1, -2, 0.5), p(4, 4, -1);
    const double angle = 0.7;
    M44d m;
    rotate(m, point, direction, angle);
    // Rodrigues' formula.
    const V3d k = direction.normalized(), v = p - point;
    const V3d turned =
        v * std::cos(angle) + k.cross(v) * std::sin(angle) + k * (k.dot(v) * (1 - std::cos(angle)));
    expect_near(p * m, point + turned);
    expect_near((point + direction) * m, point + direction);
  }
}

TEST(SippTransform, MirrorsInAPlane) {
  M44d m;
  translate(m, V3d(1, 1, 1));
  mirror(m, V3d(0, 0, 3), V3d(0, 0, -10));
  expect_near(V3d(0, 0, 0) * m, V3d(1, 1, 5));
  mirror(m, V3d(0, 0, 0), V3d(0, 0, 0));
  expect_near(V3d(0, 0, 0) * m, V3d(1, 1, 5));
  EXPECT_LT(m.determinant(), 0);
}

}  // namespace
}  // namespace farop::sipp
