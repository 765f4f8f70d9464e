// SPDX-License-Identifier: GPL-3.0-or-later
// The tiled path draws the plain path's pictures bit for bit: every instruction set that this machine has,
// every mode, tiles of several sizes, one and more threads, with and without room for all triangles.
//
// FAROP_SOUPS=100000 draws as many random scenes, from FAROP_SOUPS_SEED; the default is enough for every kind
// a few times.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <limits>

#include "raster/tiled/portion.h"
#include "shading/material.h"
#include "shading/shader.h"
#include "support/sanitizers.h"
#include "unit/raster/raster_test_support.h"
#include "unit/raster/tiled_support.h"

namespace farop::test {
namespace {

/// Stripes along u, one colour of which lets light through.
class Stripes : public Shader {
 public:
  explicit Stripes(double opacity) : opacity_(opacity) {}
  Shaded shade(const ShadingPoint& point, const ShadingFrame&) const override {
    const bool odd = std::fmod(std::abs(point.texture.x), 1.0) > 0.5;
    const double o = odd ? opacity_ : 1;
    return {{odd ? 0.9 : 0.1, std::abs(point.normal.x), std::abs(point.position.x)}, {o, o, o}};
  }
  bool opaque() const override { return opacity_ == 1; }
  bool is_procedural() const override { return true; }
  Material approximate(std::vector<std::string>*) const override { return {}; }
  std::string describe() const override { return "stripes"; }

 private:
  double opacity_;
};

/// Concave, with up to 250 corners in a square: a gear with teeth around it, or a comb with teeth side by
/// side or above each other.
Corners toothed_polygon(Random& random, std::int64_t x, std::int64_t y, std::int64_t size) {
  const int teeth = random.integer(3, 60), form = random.integer(0, 2);
  Corners corners;
  if (form == 0) {
    for (int i = 0; i < 4 * teeth; ++i) {
      const double angle = 6.283185307179586 * i / (4 * teeth);
      const double radius = static_cast<double>(size) * (i % 4 < 2 ? 0.5 : 0.4);
      corners.push_back(
          vertex(x + std::llround(radius * std::cos(angle)), y + std::llround(radius * std::sin(angle))));
    }
    return corners;
  }
  for (int i = 0; i <= 2 * teeth; ++i) {
    const std::int64_t along = size * i / (2 * teeth), across = i % 2 == 0 ? size / 8 : size;
    corners.push_back(form == 1 ? vertex(x + along, y + across) : vertex(x + across, y + along));
  }
  corners.push_back(form == 1 ? vertex(x + size, y) : vertex(x, y + size));
  corners.push_back(vertex(x, y));
  return corners;
}

/// Polygons of all kinds in a frame, and how they are to be drawn.
struct Soup {
  ScreenFrame frame;
  InternalRasterizerOptions options;
  Drawing drawing;
};

class SoupMaker {
 public:
  explicit SoupMaker(std::uint64_t seed) : random_(seed) {
    shiny_.ks = 0.5, shiny_.shine = 9, shiny_.color = {0.9, 0.4, 0.2};
    glass_ = shiny_, glass_.transmittance = 0.6;
    invisible_ = shiny_, invisible_.transmittance = 1;
    striped_ = shiny_, gauze_ = shiny_;
  }

  Soup make() {
    Soup soup;
    InternalRasterizerOptions& o = soup.options;
    o.mode = one_of({DrawMode::flat, DrawMode::gouraud, DrawMode::gouraud, DrawMode::phong});
    o.samples = one_of({1, 1, 1, 2, 3, 5});
    o.background = {0.1, 0.5, 0.9};
    o.keep_depth = true;
    o.additive_transparency = one_of({0, 0, 1}) == 1;
    o.shading.lights = {{V3d(1, 2, -3), {1, 1, 1}}, {V3d(-4, 0, 1), {0.3, 0.9, 0.2}}};
    const int bits = random_.integer(0, 8);
    const std::int64_t depths =
        one_of({std::int64_t{2}, std::int64_t{65536}, std::int64_t{1} << 24, std::int64_t{1} << 30});
    const int colors = one_of({256, 256, 256, 2, 100, 65536});
    const int most = one_of({40, 40, 40, 40, 200});  // mostly small: more of them in the time
    const int w = random_.integer(1, most) * o.samples, h = random_.integer(1, most) * o.samples;
    soup.frame = make_frame(w, h, bits, depths, colors);
    soup.frame.half_pixel_border = random_.integer(0, 1) == 1;
    const bool transparent = random_.integer(0, 3) == 0;
    const int count = one_of({3, 10, 30, 100, 300});
    for (int i = 0; i < count; ++i) add_polygon(soup, transparent);
    return soup;
  }

 private:
  template <class T>
  T one_of(std::initializer_list<T> choices) {
    return choices.begin()[random_.bits() % choices.size()];
  }

  void add_polygon(Soup& soup, bool transparent) {
    const Resolution& r = soup.frame.resolution;
    const int bits = soup.frame.subpixel_bits;
    // Anywhere, some beyond the frame; tiny, small and large.
    const std::int64_t size = std::int64_t{one_of({1, 3, 9, 20, 80, 400, 4000})} << bits;
    const std::int64_t x = random_.between(-(5 << bits), std::int64_t{r.x} << bits);
    const std::int64_t y = random_.between(-(5 << bits), std::int64_t{r.y} << bits);
    const Shape shape = k_shapes[random_.bits() % 5];
    Corners corners = random_polygon(random_, random_.integer(0, 2) == 0 ? shape : Shape::triangle, x,
                                     x + size, y, y + size);
    if (random_.integer(0, 9) == 0) corners = toothed_polygon(random_, x, y, size);
    if (random_.integer(0, 4) == 0) thin(corners);
    if (random_.integer(0, 40) == 0) corners[0].x += 1 << 24;  // too large for planes
    const std::int64_t depth = random_.between(0, r.z - 1),
                       range = random_.integer(0, 1) == 0 ? r.z : 1 + r.z / 100;
    for (ScreenVertex& v : corners) {
      v.z = static_cast<std::int32_t>(
          std::clamp<std::int64_t>(depth + random_.between(-range, range), 0, r.z - 1));
      v.r = component(r), v.g = component(r), v.b = component(r);
    }
    add(soup, corners, transparent);
  }

  void add(Soup& soup, const Corners& corners, bool transparent) {
    const int kind = random_.integer(0, transparent ? 6 : 3);
    const Material* const materials[] = {nullptr, &shiny_, &shiny_, &striped_, &glass_, &gauze_, &invisible_};
    soup.drawing.add(corners, materials[kind]);
    if (kind == 3) soup.drawing.batch.polygons.back().shader = &stripes_;
    if (kind == 5) soup.drawing.batch.polygons.back().shader = &thin_stripes_;
    ScreenPolygonBatch& batch = soup.drawing.batch;
    const float distance = random_.integer(0, 3) == 0 ? 0.5F : 5.0F;  // some corners behind the eye, or none
    for (std::size_t i = 0; i < corners.size(); ++i) {
      batch.normals.push_back(vector());
      batch.eye_positions.push_back(vector() + V3f(0, 0, distance));
      batch.textures.push_back(vector() * 4);
      batch.opacities.push_back((vector() + V3f(1, 1, 1)) * 0.5F);
    }
  }

  /// Moves corners towards a line.
  void thin(Corners& corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      corners[i].x = (corners[0].x + corners[1].x) / 2 + random_.integer(-2, 2);
      corners[i].y = (corners[0].y + corners[1].y) / 2 + random_.integer(-2, 2);
    }
  }

  std::uint16_t component(const Resolution& r) {
    return static_cast<std::uint16_t>(random_.integer(0, r.color - 1));
  }
  V3f vector() {
    const auto number = [&] { return static_cast<float>(random_.integer(-1000, 1000)) / 1000; };
    const float x = number(), y = number();
    return {x, y, number()};
  }

  Random random_;
  Material shiny_, glass_, invisible_, striped_, gauze_;
  Stripes stripes_{1}, thin_stripes_{0.3};
};

Framebuffer picture_of(const Soup& soup, const RasterTuning& tuning) {
  InternalRasterizerOptions options = soup.options;
  options.tuning = tuning;
  InternalRasterizer rasterizer(options);
  rasterizer.begin_frame(soup.frame);
  rasterizer.polygons(soup.drawing.batch);
  rasterizer.end_frame();
  return rasterizer.take();
}

TEST(Tiled, DrawsRandomSoupsAsThePlainPathDoes) {
  const auto number = [](const char* variable, int usual) {
    const char* const wanted = std::getenv(variable);
    return wanted != nullptr ? std::atoi(wanted) : usual;
  };
  const int soups = number("FAROP_SOUPS", rounds(150));
  const std::vector<std::int64_t> all = targets();
  EXPECT_GE(all.size(), 2u);
  SoupMaker maker(static_cast<std::uint64_t>(number("FAROP_SOUPS_SEED", 71)));
  for (int i = 0; i < soups; ++i) {
    const Soup soup = maker.make();
    RasterTuning tuning;
    tuning.path = RasterPath::plain;
    const Framebuffer expected = picture_of(soup, tuning);
    tuning.path = RasterPath::tiled;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const OnlyTarget only(all[k]);
      constexpr int sides[] = {64, 8, 16, 61, 40};
      const auto turn = static_cast<std::size_t>(i) + k;
      tuning.tile_size = sides[turn % 5];
      tuning.threads = 1 + static_cast<int>(turn / 5 % 3);
      tuning.waiting_bytes = turn % 4 == 3 ? 20000 : RasterTuning{}.waiting_bytes;
      const Framebuffer got = picture_of(soup, tuning);
      ASSERT_EQ(difference(got, expected), "")
          << "soup " << i << ", target " << hwy::TargetName(all[k]) << ", tiles of " << tuning.tile_size
          << ", " << tuning.threads << " threads, " << tuning.waiting_bytes << " bytes, mode "
          << static_cast<int>(soup.options.mode) << ", samples " << soup.options.samples;
    }
  }
}

/// Bytes that a polygon takes until it is drawn.
std::size_t waiting_bytes_of(const Corners& corners, int width) {
  Drawing drawing;
  drawing.add(corners);
  const ScreenFrame frame = make_frame(width, 12);
  const tiled::TileGrid grid(frame, 64);
  tiled::Portion portion;
  portion.start(grid, DrawMode::gouraud, 256, 0);
  constexpr std::size_t k_no_limit = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(portion.add(drawing.batch, 0, {}, 1, {k_no_limit, k_no_limit}).polygon, 1u);
  return portion.bytes();
}

TEST(Tiled, TakesMemoryForCornersAndTilesNotForTheirProduct) {
  const auto bar = [](int corners) {  // a fan of long thin triangles
    Corners ring;
    for (int x = 0; x < corners / 2; ++x) ring.push_back(vertex(x, 0));
    for (int x = corners / 2 - 1; x >= 0; --x) ring.push_back(vertex(x, 9));
    return ring;
  };
  const auto comb = [](int corners) {  // no fan
    Corners ring;
    for (int x = 0; x < corners - 2; ++x) ring.push_back(vertex(x, x % 2 == 0 ? 2 : 9));
    ring.push_back(vertex(corners, 0)), ring.push_back(vertex(-1, 0));
    return ring;
  };
  for (const auto& polygon : {std::function<Corners(int)>(bar), std::function<Corners(int)>(comb)}) {
    const std::size_t few = waiting_bytes_of(polygon(2000), 16000),
                      many = waiting_bytes_of(polygon(16000), 16000);
    EXPECT_LT(few, 2000 * 1500u);
    EXPECT_LT(many, 9 * few);
  }
}

TEST(Tiled, SortsLargeBatchesInParallelInOrder) {
  Random random(72);
  Material glass;
  glass.transmittance = 0.6;
  Soup soup;
  soup.frame = make_frame(300, 200, 4, 2);  // two depths: order decides
  soup.options.keep_depth = true;
  for (int i = 0; i < 60000; ++i) {
    const int x = random.integer(-80, 4800), y = random.integer(-80, 3200);
    Corners corners = i % 8 == 0 ? toothed_polygon(random, x, y, 160)
                                 : random_polygon(random, Shape::triangle, x, x + 160, y, y + 160);
    for (ScreenVertex& v : corners)
      v.z = random.integer(0, 1), v.r = static_cast<std::uint16_t>(random.integer(0, 255));
    soup.drawing.add(corners, i % 50 == 0 ? &glass : nullptr);
  }
  RasterTuning tuning;
  tuning.path = RasterPath::plain;
  const Framebuffer expected = picture_of(soup, tuning);
  tuning.path = RasterPath::tiled;
  for (const int threads : {1, 2, 5}) {
    for (const std::size_t bytes : {std::size_t{1} << 27, std::size_t{1} << 20}) {
      tuning.threads = threads, tuning.waiting_bytes = bytes;
      ASSERT_EQ(difference(picture_of(soup, tuning), expected), "")
          << threads << " threads, " << bytes << " bytes";
    }
  }
}

}  // namespace
}  // namespace farop::test
