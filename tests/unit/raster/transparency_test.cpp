// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <map>

#include "raster/fragment_store.h"
#include "raster/reference.h"
#include "shading/material.h"
#include "unit/raster/raster_test_support.h"

namespace farop::test {
namespace {

Material glass(double transmittance) {
  Material m;
  m.transmittance = transmittance;
  return m;
}

/// A triangle of constant depth; colours vary.
struct Pane {
  Corners corners;
  const Material* material = nullptr;
};

/// The definition, pixel by pixel: sort what covers it, go from near to far until something opaque.
double exact_red(const std::vector<Pane>& panes, double background, int bits, int x, int y) {
  std::multimap<int, const Pane*> layers;  // equal keys keep the order of insertion
  for (const Pane& pane : panes) {
    if (reference::covers(pane.corners, bits, x, y)) layers.emplace(pane.corners[0].z, &pane);
  }
  // An opaque pane comes before transparent ones of its depth, whatever the order of drawing.
  const auto is_opaque = [](const Pane& pane) { return pane.material == nullptr || pane.material->opaque(); };
  double result = 0, rest = 1;
  const auto color_of = [&](const Pane& pane) {
    const std::vector<std::int64_t> values = {pane.corners[0].r, pane.corners[1].r, pane.corners[2].r};
    const reference::Rational r = reference::AffineFunction::through(pane.corners, values)->at(bits, x, y);
    return static_cast<double>(r.numerator) / static_cast<double>(r.denominator);
  };
  for (auto layer = layers.begin(); layer != layers.end();) {
    const auto end = layers.upper_bound(layer->first);
    for (auto same = layer; same != end; ++same) {
      if (is_opaque(*same->second)) return result + rest * color_of(*same->second);
    }
    for (; layer != end; ++layer) {
      const double opacity = 1 - layer->second->material->transmittance;
      result += rest * opacity * color_of(*layer->second);
      rest *= 1 - opacity;
    }
  }
  return result + rest * background;
}

Framebuffer picture_of(const std::vector<Pane>& panes, const ScreenFrame& frame, Rgb background) {
  Drawing drawing;
  for (const Pane& pane : panes) drawing.add(pane.corners, pane.material);
  InternalRasterizerOptions options;
  options.background = background;
  return draw(frame, drawing, options);
}

std::vector<Pane> random_panes(Random& random, const std::vector<Material>& materials, int count,
                               bool distinct) {
  std::vector<Pane> panes;
  for (int i = 0; i < count; ++i) {
    Pane pane;
    pane.corners = random_polygon(random, Shape::triangle, 0, 60, 0, 60);
    const int z = distinct ? 10 * i : random.integer(0, 5);
    for (ScreenVertex& v : pane.corners) v = vertex(v.x, v.y, z, random.integer(0, 255), 0, 0);
    pane.material = random.integer(0, 5) == 0 ? nullptr : &materials[random.bits() % materials.size()];
    panes.push_back(pane);
  }
  return panes;
}

const std::vector<Material> k_materials = {glass(0),   glass(0.25), glass(0.5),
                                           glass(0.6), glass(0.9),  glass(1)};

TEST(Transparency, EqualsSortingEveryPixelByDepth) {
  Random random(21);
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const ScreenFrame frame = make_frame(16, 16, 2);
    const std::vector<Pane> panes = random_panes(random, k_materials, random.integer(1, 14), i % 2 == 0);
    const Framebuffer picture = picture_of(panes, frame, {0.2, 0, 0});
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const double exact = exact_red(panes, 51, 2, x, y);
        // Rounded once, to nearest; float holds a colour to 2^-16.
        ASSERT_NEAR(red(picture, x, y), exact, 0.5 + 1e-4) << "scene " << i << " at " << x << ' ' << y;
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 300 * 256);
}

TEST(Transparency, DoesNotDependOnTheDrawingOrderOfDifferentDepths) {
  Random random(22);
  for (int i = 0; i < 100; ++i) {
    std::vector<Pane> panes = random_panes(random, k_materials, 12, true);
    const Framebuffer expected = picture_of(panes, make_frame(16, 16, 2), {0, 0.3, 1});
    for (int order = 0; order < 6; ++order) {
      for (std::size_t k = panes.size() - 1; k > 0; --k) std::swap(panes[k], panes[random.bits() % (k + 1)]);
      const Framebuffer shuffled = picture_of(panes, make_frame(16, 16, 2), {0, 0.3, 1});
      ASSERT_EQ(shuffled.rgb, expected.rgb);
      ASSERT_EQ(shuffled.depth, expected.depth);
    }
  }
}

TEST(Transparency, PutsTheFirstDrawnOfEqualDepthsInFront) {
  const Material half = glass(0.5);
  const Pane bright{rectangle(0, 0, 8, 8, 5, 200, 0, 0), &half},
      dark{rectangle(0, 0, 8, 8, 5, 40, 0, 0), &half};
  EXPECT_EQ(red(picture_of({bright, dark}, make_frame(9, 9), {}), 3, 3), 110);  // 100 + 10
  EXPECT_EQ(red(picture_of({dark, bright}, make_frame(9, 9), {}), 3, 3), 70);   // 20 + 50
}

TEST(Transparency, HidesFragmentsAtOrBehindTheNearestOpaqueOne) {
  const Material half = glass(0.5);
  const Pane opaque{rectangle(0, 0, 8, 8, 5, 80, 0, 0), nullptr};
  for (const int z : {5, 6}) {
    const Pane pane{rectangle(0, 0, 8, 8, z, 200, 0, 0), &half};
    EXPECT_EQ(red(picture_of({opaque, pane}, make_frame(9, 9), {}), 3, 3), 80);
    EXPECT_EQ(red(picture_of({pane, opaque}, make_frame(9, 9), {}), 3, 3), 80);
  }
  const Pane front{rectangle(0, 0, 8, 8, 4, 200, 0, 0), &half};
  EXPECT_EQ(red(picture_of({opaque, front}, make_frame(9, 9), {}), 3, 3), 140);
  EXPECT_EQ(red(picture_of({front, opaque}, make_frame(9, 9), {}), 3, 3), 140);
}

Framebuffer additive_picture(const std::vector<Pane>& panes, const Rgb& background) {
  Drawing drawing;
  for (const Pane& pane : panes) drawing.add(pane.corners, pane.material);
  InternalRasterizerOptions options;
  options.background = background;
  options.additive_transparency = true;
  return draw(make_frame(9, 9), drawing, options);
}

TEST(AdditiveTransparency, TwoHalvesHideTheRest) {
  const Material half = glass(0.5);
  const Pane near_pane{rectangle(0, 0, 8, 8, 1, 200, 0, 0), &half},
      far_pane{rectangle(0, 0, 8, 8, 2, 100, 0, 0), &half},
      last{rectangle(0, 0, 8, 8, 3, 255, 0, 0), nullptr};
  for (const std::vector<Pane>& panes :
       {std::vector<Pane>{near_pane, far_pane, last}, {last, far_pane, near_pane}}) {
    EXPECT_EQ(red(additive_picture(panes, {1, 1, 1}), 3, 3), 150);
  }
  EXPECT_EQ(red(additive_picture({near_pane, far_pane}, {1, 1, 1}), 3, 3), 150)
      << "nor is the background seen";
  EXPECT_EQ(red(picture_of({near_pane, far_pane}, make_frame(9, 9), {1, 1, 1}), 3, 3), 189)
      << "as it usually is";
}

TEST(AdditiveTransparency, TheLastLayerGetsWhatIsLeft) {
  const Material thin = glass(0.75), thick = glass(0.125);
  const Pane first{rectangle(0, 0, 8, 8, 1, 200, 0, 0), &thin},
      second{rectangle(0, 0, 8, 8, 2, 80, 0, 0), &thick};
  EXPECT_EQ(red(additive_picture({first, second}, {1, 0, 0}), 3, 3), 50 + 60);
  EXPECT_EQ(red(additive_picture({first}, {1, 0, 0}), 3, 3), 50 + 191);
}

TEST(AdditiveTransparency, CountsEveryChannelByItself) {
  FragmentStore store;
  store.add(0, 1, 10, V3f(100, 100, 100), V3f(0.5f, 0.25f, 1));
  store.add(0, 1, 20, V3f(200, 200, 200), V3f(0.75f, 0.875f, 1));
  const Rgb c = store.composite(0, 30, {40, 40, 40}, Transparency::additive);
  EXPECT_DOUBLE_EQ(c.r, 50 + 0.5 * 200);
  EXPECT_DOUBLE_EQ(c.g, 25 + 0.75 * 200);
  EXPECT_DOUBLE_EQ(c.b, 100);
  const Rgb over = store.composite(0, 30, {40, 40, 40}, Transparency::over);
  EXPECT_DOUBLE_EQ(over.r, 50 + 0.5 * 0.75 * 200 + 0.125 * 40);
}

TEST(VertexOpacity, IsInterpolatedLikeColour) {
  // Opaque at the left edge, nothing at the right; per channel.
  const Material glassy = glass(0.3);
  Drawing drawing;
  drawing.add(rectangle(0, 0, 100, 10, 5, 200, 200, 200), &glassy);
  drawing.batch.opacities = {V3f(1, 0.5f, 0), V3f(0, 0.5f, 1), V3f(0, 0.5f, 1), V3f(1, 0.5f, 0)};
  InternalRasterizerOptions options;
  options.background = {0, 0, 0};
  const Framebuffer picture = draw(make_frame(101, 11), drawing, options);
  for (int x = 0; x < 100; ++x) {
    const std::size_t at = 3 * picture.pixel(x, 4);
    EXPECT_NEAR(picture.rgb[at], 200 * (1 - x / 100.0), 0.51) << x;
    EXPECT_EQ(picture.rgb[at + 1], 100);
    EXPECT_NEAR(picture.rgb[at + 2], 200 * (x / 100.0), 0.51) << x;
  }
}

TEST(VertexOpacity, WithoutAnyTheMaterialsCounts) {
  const Material glassy = glass(0.75);
  Drawing drawing;
  drawing.add(rectangle(0, 0, 8, 8, 5, 200, 0, 0), &glassy);
  EXPECT_EQ(red(draw(make_frame(9, 9), drawing), 3, 3), 50);
}

TEST(Transparency, RoundsOnceAtTheEnd) {
  // 40 panes of opacity 0.1 over black: rounding at each would lose most of 100 (1 - 0.9^40) = 98.5.
  const Material thin = glass(0.9);
  std::vector<Pane> panes;
  panes.reserve(40);
  for (int i = 0; i < 40; ++i) panes.push_back({rectangle(0, 0, 8, 8, i, 100, 0, 0), &thin});
  EXPECT_EQ(red(picture_of(panes, make_frame(9, 9), {}), 3, 3), 99);
}

TEST(Transparency, DoesNotRoundTheOpaqueColourBehindAPane) {
  // Behind the black pane red runs from 0 to 10 over 80 columns; half of it is 0.5 at 1.0, 1.5 at 3.0 and so
  // on. Rounding it first would put the steps elsewhere (1 at 0.5 instead of 1.0).
  const Material half = glass(0.5);
  const Pane ramp{{vertex(0, 0, 9, 0), vertex(80, 0, 9, 10), vertex(80, 8, 9, 10), vertex(0, 8, 9, 0)},
                  nullptr};
  const Pane pane{rectangle(0, 0, 80, 8, 1, 0, 0, 0), &half};
  const Framebuffer picture = picture_of({ramp, pane}, make_frame(81, 9), {});
  EXPECT_EQ(red(picture, 7, 3), 0);   // 0.875 / 2
  EXPECT_EQ(red(picture, 9, 3), 1);   // 1.125 / 2
  EXPECT_EQ(red(picture, 23, 3), 1);  // 2.875 / 2
  EXPECT_EQ(red(picture, 25, 3), 2);  // 3.125 / 2
}

TEST(Transparency, LeavesTheDepthOfTransparentSurfacesOutOfTheDepthBuffer) {
  const Material half = glass(0.5);
  const Framebuffer picture =
      picture_of({{rectangle(0, 0, 4, 8, 7, 0, 0, 0), nullptr}, {rectangle(0, 0, 8, 8, 5, 0, 0, 0), &half}},
                 make_frame(9, 9), {});
  EXPECT_EQ(picture.depth[picture.pixel(2, 2)], 7);
  EXPECT_EQ(picture.depth[picture.pixel(6, 2)], 65536);
}

TEST(Transparency, KeepsNoFragmentOfAnInvisibleOrHiddenSurface) {
  const Material invisible = glass(1), half = glass(0.5);
  Drawing drawing;
  drawing.add(rectangle(0, 0, 8, 8, 5, 9, 9, 9));
  drawing.add(rectangle(0, 0, 8, 8, 1, 200, 0, 0), &invisible);
  drawing.add(rectangle(0, 0, 8, 8, 6, 200, 0, 0), &half);
  drawing.add(rectangle(0, 0, 2, 2, 4, 200, 0, 0), &half);
  InternalRasterizerOptions options;
  options.tuning.path = RasterPath::plain;  // which counts
  InternalRasterizer rasterizer(options);
  rasterizer.begin_frame(make_frame(9, 9));
  rasterizer.polygons(drawing.batch);
  rasterizer.end_frame();
  EXPECT_EQ(rasterizer.counts().polygons, 4u);
  EXPECT_EQ(rasterizer.counts().fragments, 64u + 64 + 4);
  EXPECT_EQ(rasterizer.counts().visible_fragments, 64u + 4);
  EXPECT_EQ(rasterizer.counts().transparent_fragments, 4u);
}

}  // namespace
}  // namespace farop::test
