// SPDX-License-Identifier: GPL-3.0-or-later
// Depth and colour of single polygons against exact rationals.
#include <gtest/gtest.h>

#include "raster/polygon_filler.h"
#include "raster/reference.h"
#include "raster/resolve.h"
#include "unit/raster/raster_test_support.h"

namespace farop::test {
namespace {

struct Sample {
  V3f value;
  std::int32_t depth;
};

/// A small frame of samples that one polygon after another is drawn into.
class Canvas {
 public:
  explicit Canvas(const ScreenFrame& frame) : frame_(frame) {
    buffer.window = {0, 0, frame.resolution.x, frame.resolution.y};
    buffer.stride = frame.resolution.x;
    buffer.empty_depth = static_cast<std::int32_t>(frame.resolution.z);
  }
  void draw(const Corners& corners) {
    buffer.depths.assign(buffer.count(), buffer.empty_depth);
    buffer.values.assign(buffer.count(), V3f(0));
    RasterCounts counts;
    const ShadingFrame dark;
    PolygonFiller filler(frame_, buffer, dark, counts);
    filler.fill({corners, {}, {}, {}, {}, {}});
  }

  Sample sample(std::size_t i) const { return {buffer.values[i], buffer.depths[i]}; }
  Sample sample(int x, int y) const { return sample(buffer.index(x, y)); }

  SampleBuffer buffer;

 private:
  ScreenFrame frame_;
};

/// |value - exact| <= 1/2 + 1/1024: rounded to nearest, but for ties decided by rounding in double.
bool is_nearest(const reference::Rational& exact, std::int64_t value) {
  return reference::Rational{exact.numerator * 1024, exact.denominator}.is_within(value * 1024, 513);
}

struct Channel {
  const char* name;
  std::int64_t (*of_vertex)(const ScreenVertex&);
  std::int64_t (*of_sample)(const Sample&);
};
constexpr Channel k_channels[] = {
    {"depth", [](const ScreenVertex& v) { return std::int64_t{v.z}; },
     [](const Sample& s) { return std::int64_t{s.depth}; }},
    {"red", [](const ScreenVertex& v) { return std::int64_t{v.r}; },
     [](const Sample& s) { return std::int64_t{to_byte(s.value.x)}; }},
    {"green", [](const ScreenVertex& v) { return std::int64_t{v.g}; },
     [](const Sample& s) { return std::int64_t{to_byte(s.value.y)}; }},
    {"blue", [](const ScreenVertex& v) { return std::int64_t{v.b}; },
     [](const Sample& s) { return std::int64_t{to_byte(s.value.z)}; }},
};

/// Compares every covered sample with the affine functions through the corners; returns how many samples
/// there were.
int expect_affine(const Canvas& canvas, const Corners& corners, int bits) {
  int covered = 0;
  for (const Channel& channel : k_channels) {
    std::vector<std::int64_t> values;
    for (const ScreenVertex& v : corners) values.push_back(channel.of_vertex(v));
    const auto exact = reference::AffineFunction::through(corners, values);
    if (!exact) continue;  // all on one line
    for (int y = 0; y < canvas.buffer.height(); ++y) {
      for (int x = 0; x < canvas.buffer.width(); ++x) {
        const Sample sample = canvas.sample(x, y);
        if (sample.depth == canvas.buffer.empty_depth) continue;
        ++covered;
        const std::int64_t value = channel.of_sample(sample);
        EXPECT_TRUE(is_nearest(exact->at(bits, x, y), value))
            << channel.name << ' ' << value << " at " << x << ' ' << y;
      }
    }
  }
  return covered;
}

void give_random_attributes(Corners& corners, Random& random, std::int64_t depths) {
  for (ScreenVertex& v : corners) {
    v.z = static_cast<std::int32_t>(random.between(0, depths - 1));
    v.r = static_cast<std::uint16_t>(random.integer(0, 255));
    v.g = static_cast<std::uint16_t>(random.integer(0, 255));
    v.b = static_cast<std::uint16_t>(random.integer(0, 255));
  }
}

TEST(Interpolation, RoundsDepthAndColourOfTrianglesToTheNearestOfTheExactValue) {
  Random random(11);
  int covered = 0;
  for (const std::int64_t depths : {std::int64_t{65536}, std::int64_t{1} << 24, std::int64_t{1} << 30}) {
    for (const int bits : {0, 1, 4, 8}) {
      Canvas canvas(make_frame(24, 24, bits, depths));
      for (int i = 0; i < 1000; ++i) {
        const std::int64_t last = 23 << bits;
        Corners corners = random_polygon(random, Shape::triangle, 0, last, 0, last);
        if (i % 4 == 0) {  // a needle: the third corner close to the line through the others
          corners[2] = vertex((corners[0].x + corners[1].x) / 2 + random.integer(-1, 1),
                              (corners[0].y + corners[1].y) / 2 + random.integer(-1, 1));
        }
        give_random_attributes(corners, random, depths);
        canvas.draw(corners);
        covered += expect_affine(canvas, corners, bits);
        ASSERT_FALSE(HasFailure()) << "triangle " << i << ", " << bits << " bits, " << depths << " depths";
      }
    }
  }
  EXPECT_GT(covered, 1000000);
}

TEST(Interpolation, StaysExactWhenEdgesAreAsLongAsCoordinatesAllow) {
  Random random(12);
  constexpr std::int64_t k_far = std::int64_t{1} << 26, k_depths = std::int64_t{1} << 30;
  Canvas canvas(make_frame(300, 20, 8, k_depths));
  int covered = 0;
  for (int i = 0; i < 400; ++i) {
    Corners corners = random_polygon(random, Shape::triangle, -k_far, k_far, -k_far, k_far);
    if (i % 2 == 0) {  // a needle through the frame, a hundredth of a pixel to a few pixels wide
      corners[0] = vertex(random.integer(0, 299 * 256), random.integer(0, 19 * 256));
      corners[2] = vertex(2 * corners[0].x - corners[1].x + random.integer(-600, 600),
                          2 * corners[0].y - corners[1].y + random.integer(-600, 600));
      corners[0].y += random.integer(-600, 600);
    }
    give_random_attributes(corners, random, k_depths);
    canvas.draw(corners);
    covered += expect_affine(canvas, corners, 8);
    ASSERT_FALSE(HasFailure()) << "triangle " << i;
  }
  EXPECT_GT(covered, 100000);
}

TEST(Interpolation, FollowsThePlaneOfLatticePlanarPolygonsOfEveryShape) {
  Random random(13);
  int covered = 0;
  for (const int bits : {0, 3}) {
    Canvas canvas(make_frame(32, 32, bits, std::int64_t{1} << 24));
    for (int i = 0; i < 2000; ++i) {
      const int last = 31 << bits;
      Corners corners = random_polygon(random, k_shapes[i % 5], 0, last, 0, last);
      const int a = random.integer(-20000, 20000), b = random.integer(-10000, 10000);
      const bool rising = random.integer(0, 1) == 1;
      for (ScreenVertex& v : corners) {
        v.z = 8000000 + a * v.x + b * v.y;
        v.r = static_cast<std::uint16_t>(rising ? v.x : last - v.x);
        v.g = static_cast<std::uint16_t>(bits == 0 ? v.x + v.y : v.y);  // stays below 256
        v.b = 77;
      }
      canvas.draw(corners);
      covered += expect_affine(canvas, corners, bits);
      ASSERT_FALSE(HasFailure()) << "polygon " << i << ", " << bits << " bits";
    }
  }
  EXPECT_GT(covered, 1000000);
}

TEST(Interpolation, NeverLeavesTheRangeOfTheCorners) {
  Random random(14);
  constexpr std::int64_t k_depths = std::int64_t{1} << 30;
  Canvas canvas(make_frame(24, 24, 4, k_depths));
  for (int i = 0; i < 3000; ++i) {
    Corners corners = random_polygon(random, k_shapes[i % 5], -100, 24 * 16 + 100, -100, 24 * 16 + 100);
    give_random_attributes(corners, random, k_depths);
    canvas.draw(corners);
    for (const Channel& channel : k_channels) {
      std::vector<std::int64_t> values;
      for (const ScreenVertex& v : corners) values.push_back(channel.of_vertex(v));
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      for (std::size_t k = 0; k < canvas.buffer.count(); ++k) {
        const Sample sample = canvas.sample(k);
        if (sample.depth == canvas.buffer.empty_depth) continue;
        ASSERT_GE(channel.of_sample(sample), *low) << channel.name;
        ASSERT_LE(channel.of_sample(sample), *high) << channel.name;
      }
    }
  }
}

TEST(Interpolation, KeepsConstantsAndGivesExactIntegersWhereThePlaneHasThem) {
  Random random(15);
  Canvas canvas(make_frame(60, 60));
  for (int i = 0; i < 300; ++i) {
    Corners corners = random_polygon(random, Shape::triangle, 0, 59, 0, 59);
    for (ScreenVertex& v : corners) {
      v = vertex(v.x, v.y, 12345, v.x, v.y, 199);
    }
    canvas.draw(corners);
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 60; ++x) {
        const Sample s = canvas.sample(x, y);
        if (s.depth == canvas.buffer.empty_depth) continue;
        ASSERT_EQ(s.depth, 12345);
        ASSERT_EQ(to_byte(s.value.x), x);
        ASSERT_EQ(to_byte(s.value.y), y);
        ASSERT_EQ(s.value.z, 199.0f);
      }
    }
  }
}

/// Corners on a half circle or so, seen from the lowest one in order: convex, or a fan at least.
Corners random_fan(Random& random, int last) {
  Corners corners = {vertex(random.integer(last / 3, 2 * last / 3), 0)};
  const int n = random.integer(3, 8);
  for (int k = 0; k < n; ++k) corners.push_back(vertex(random.integer(0, last), random.integer(1, last)));
  const auto is_before = [&](const ScreenVertex& p, const ScreenVertex& q) {
    return doubled_area(corners[0], p, q) > 0;
  };
  std::sort(corners.begin() + 1, corners.end(), is_before);
  return corners;
}

TEST(Interpolation, TakesAPolygonThatItsLowestCornerSeesAsTheFanFromThere) {
  Random random(17);
  const int bits = 3, last = 31 << bits;
  Canvas canvas(make_frame(32, 32, bits, std::int64_t{1} << 24)), part = canvas;
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    Corners corners = random_fan(random, last);
    give_random_attributes(corners, random, std::int64_t{1} << 24);
    ASSERT_EQ(fan_center(corners), 0u);
    canvas.draw(corners);
    for (std::uint32_t k = 1; k + 1 < corners.size(); ++k) {
      part.draw({corners[0], corners[k], corners[k + 1]});
      for (std::size_t s = 0; s < part.buffer.count(); ++s) {
        if (part.sample(s).depth == part.buffer.empty_depth) continue;
        ++compared;
        ASSERT_EQ(canvas.sample(s).depth, part.sample(s).depth) << "fan " << i;
        ASSERT_EQ(canvas.sample(s).value, part.sample(s).value) << "fan " << i;
      }
    }
  }
  EXPECT_GT(compared, 100000);
}

TEST(Interpolation, FindsNoFanWhereTrianglesWouldOverlap) {
  // A part that the lowest corner cannot see, a second corner at its place, too few corners.
  EXPECT_FALSE(fan_center(Corners{vertex(0, 0), vertex(9, 3), vertex(3, 9), vertex(9, 9)}));
  EXPECT_FALSE(fan_center(Corners{vertex(0, 0), vertex(9, 3), vertex(0, 0), vertex(3, 9)}));
  EXPECT_TRUE(fan_center(Corners{vertex(9, 3), vertex(0, 0), vertex(3, 9), vertex(9, 9)}));
  EXPECT_FALSE(fan_center(Corners{vertex(0, 0), vertex(9, 3)}));
}

TEST(Interpolation, DoesNotDependOnTheStartingCornerOrTheDirection) {
  Random random(16);
  for (int i = 0; i < 500; ++i) {
    const ScreenFrame frame = make_frame(32, 32, 2, std::int64_t{1} << 24);
    Corners corners = random_polygon(random, k_shapes[i % 5], 0, 127, 0, 127);
    give_random_attributes(corners, random, std::int64_t{1} << 24);
    if (i % 2 ==
        0) {  // tied crossings with different attributes, as a polygon may have that rounding folded over
      corners.push_back(corners[0]);
      corners.back().z /= 2;
    }
    const auto picture = [&] {
      Drawing drawing;
      drawing.add(corners);
      return farop::test::draw(frame, drawing);
    };
    const Framebuffer expected = picture();
    for (std::size_t turn = 1; turn < corners.size(); ++turn) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      const Framebuffer turned = picture();
      ASSERT_EQ(turned.rgb, expected.rgb) << "polygon " << i;
      ASSERT_EQ(turned.depth, expected.depth) << "polygon " << i;
    }
    std::reverse(corners.begin(), corners.end());
    ASSERT_EQ(picture().rgb, expected.rgb) << "polygon " << i;
  }
}

}  // namespace
}  // namespace farop::test
