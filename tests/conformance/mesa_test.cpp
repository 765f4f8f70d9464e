// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle against a rasterizer that nobody here has written: Mesa's software OpenGL, off screen.
//
// Both have 8 sub-pixel bits, so corners given in 256ths of a pixel reach Mesa's edge functions unrounded.
// Mesa's rule is top-left where y points downwards, which is how OpenGL's window coordinates are numbered for
// it: drawn and read upside down it is the oracle's `lt`, as it stands `lb`. Frames alternate.
#include <GL/osmesa.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "conformance/coverage.h"
#include "conformance/random.h"
#include "conformance/shapes.h"
#include "conformance/wide.h"
#include "unit/conformance/long_tests.h"

namespace farop::conformance {
namespace {

constexpr int k_bits = 8, k_pixel = 1 << k_bits;
// Powers of two: coordinates stay exact on their way through `float`.
constexpr int k_frame = 1024;  ///< of what is drawn
constexpr int k_wide = 4096;   ///< of a view volume with the frame in its middle
constexpr int k_margin = (k_wide - k_frame) / 2;

/// A frame of Mesa's in which every pixel counts how often it was drawn.
class MesaFrame {
 public:
  MesaFrame()
      : context_(OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr)), pixels_(4 * k_frame * k_frame) {
    if (context_ == nullptr ||
        OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, k_frame, k_frame) != GL_TRUE)
      return;
    ready_ = true;
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_DITHER);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glColor4ub(1, 1, 1, 1);
  }
  ~MesaFrame() {
    if (context_ != nullptr) OSMesaDestroyContext(context_);
  }
  MesaFrame(const MesaFrame&) = delete;
  MesaFrame& operator=(const MesaFrame&) = delete;

  bool ready() const { return ready_; }
  static std::string name() {
    const auto text = [](GLenum what) {
      return std::string(reinterpret_cast<const char*>(glGetString(what)));
    };
    return text(GL_RENDERER) + ", " + text(GL_VERSION);
  }
  /// Corners in 256ths of a pixel, (0, 0) the lower left corner of the frame; samples at pixel centres.
  /// Flipped: row 0 is Mesa's last one. Wide: what lies up to k_margin pixels outside is not clipped.
  void draw(const std::vector<TestPolygon>& triangles, bool flipped, bool wide = false) {
    flipped_ = flipped;
    const int size = wide ? k_wide : k_frame, margin = wide ? k_margin : 0;
    glViewport(-margin, -margin, size, size);
    // To -1..1; exact.
    const auto unit = [&](int fine) {
      return static_cast<float>(fine + margin * k_pixel) / static_cast<float>(size * k_pixel / 2) - 1.0F;
    };
    glClear(GL_COLOR_BUFFER_BIT);
    glBegin(GL_TRIANGLES);
    for (const TestPolygon& triangle : triangles) {
      for (const ScreenVertex& v : triangle) glVertex2f(unit(v.x), flipped ? -unit(v.y) : unit(v.y));
    }
    glEnd();
    glFinish();
  }
  int count(int x, int y) const {
    if (flipped_) y = k_frame - 1 - y;
    return pixels_[4 * (static_cast<std::size_t>(y) * k_frame + static_cast<std::size_t>(x))];
  }

 private:
  OSMesaContext context_;
  std::vector<std::uint8_t> pixels_;
  bool ready_ = false, flipped_ = false;
};

/// In 256ths: uniform; thin; corners on samples, so that edges pass through others; an edge along an axis.
TestPolygon random_triangle(Random& random, std::uint64_t kind, int size) {
  const int most = size * k_pixel;
  const auto any = [&] { return Point{random.between(0, most), random.between(0, most)}; };
  const auto inside = [most](int v) { return std::clamp(v, 0, most); };
  Points p = {any(), any(), any()};
  if (kind % 4 == 1)
    p[2] = {inside(p[1].x + random.between(-400, 400)), inside(p[1].y + random.between(-400, 400))};
  if (kind % 4 == 2) {
    for (Point& corner : p) {
      corner = {random.between(0, size - 1) * k_pixel + k_pixel / 2,
                random.between(0, size - 1) * k_pixel + k_pixel / 2};
    }
  }
  if (kind % 4 == 3) (random.below(2) == 0 ? p[1].x = p[0].x : p[1].y = p[0].y);
  return polygon_of(p);
}

/// The oracle's masks over a window of pixels.
Bitmap oracle_masks(TestPolygon triangle, const Window& window) {
  // The oracle's samples are at whole multiples of a pixel.
  triangle = moved(std::move(triangle), -k_pixel / 2, -k_pixel / 2);
  return coverage_masks(triangle, window, k_bits);
}

std::string text_of(const TestPolygon& triangle) {
  std::string text = "corners in 256ths:";
  for (const ScreenVertex& v : triangle) text += fmt::format(" ({}, {})", v.x, v.y);
  return text;
}

struct Tally {
  std::uint64_t triangles = 0, samples = 0, covered = 0, undecided = 0, wrong = 0;
  std::string first;  ///< of the disagreements
};

void report(const char* what, const Tally& t) {
  fmt::print("{}: {} triangles, {} samples ({} covered, {} where rules differ), {} disagreements\n", what,
             t.triangles, t.samples, t.covered, t.undecided, t.wrong);
}

/// Compares a window of the frame. A pixel that is drawn twice disagrees too. `wrong_at` sees each that does.
template <class WrongAt>
void compare_window(const MesaFrame& mesa, const TestPolygon& triangle, const Window& window, bool flipped,
                    Tally& tally, const WrongAt& wrong_at) {
  const std::uint8_t rule = rule_bit(flipped ? ConsistentRule::lt : ConsistentRule::lb);
  const Bitmap masks = oracle_masks(triangle, window);
  ++tally.triangles, tally.samples += masks.at.size();
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const std::uint8_t mask = masks.at[window.index(x, y)];
      const int want = (mask & rule) != 0 ? 1 : 0;
      tally.covered += static_cast<std::uint64_t>(want);
      if (mask != 0 && mask != 0xFF) ++tally.undecided;
      if (mesa.count(x, y) == want) continue;
      ++tally.wrong;
      if (tally.first.empty())
        tally.first = fmt::format("pixel {} {}: drawn {} times, expected {}; {}", x, y, mesa.count(x, y),
                                  want, text_of(triangle));
      wrong_at(x, y);
    }
  }
}

/// One frame of tiles with a triangle in each.
void compare_tiles(MesaFrame& mesa, std::uint64_t number, int tile, Tally& tally) {
  Random random("mesa/tiles", number, 1);
  const int tiles = k_frame / tile;
  std::vector<TestPolygon> triangles;
  for (int i = 0; i < tiles * tiles; ++i) {
    triangles.push_back(moved(random_triangle(random, static_cast<std::uint64_t>(i) + number, tile),
                              i % tiles * tile * k_pixel, i / tiles * tile * k_pixel));
  }
  const bool flipped = number % 2 == 1;
  mesa.draw(triangles, flipped);
  for (int i = 0; i < tiles * tiles; ++i) {
    const Window window{i % tiles * tile, i / tiles * tile, (i % tiles + 1) * tile, (i / tiles + 1) * tile};
    compare_window(mesa, triangles[static_cast<std::size_t>(i)], window, flipped, tally, [](int, int) {});
  }
}

bool leaves_frame(const ScreenVertex& v) {
  return std::min(v.x, v.y) < 0 || std::max(v.x, v.y) > k_frame * k_pixel;
}

/// Whether the sample is so near an edge that is clipped that rounding the edge's new ends can move it
/// across: both coordinates of an end by half a 256th, so the edge by at most the square root of 1/2.
bool explained_by_clipping(const TestPolygon& triangle, int x, int y) {
  const std::int64_t sx = std::int64_t{x} * k_pixel + k_pixel / 2,
                     sy = std::int64_t{y} * k_pixel + k_pixel / 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex &a = triangle[i], &b = triangle[(i + 1) % 3];
    if (!leaves_frame(a) && !leaves_frame(b)) continue;
    const std::int64_t dx = std::int64_t{b.x} - a.x, dy = std::int64_t{b.y} - a.y;
    const Wide turn = Wide{dx} * (sy - a.y) - Wide{dy} * (sx - a.x);
    if (2 * turn * turn <= Wide{dx} * dx + Wide{dy} * dy) return true;
  }
  return false;
}

TEST(Mesa, DrawsTrianglesInTheWindowAsTheOracleSays) {
  MesaFrame mesa;
  ASSERT_TRUE(mesa.ready());
  fmt::print("{}\n", MesaFrame::name());
  // 10^5 by default, 10^6 with FAROP_LONG_TESTS=1.
  const std::uint64_t wanted = test::repetitions(100'000, 1'000'000);
  Tally tally;
  for (std::uint64_t frame = 0; tally.triangles < wanted; ++frame) {
    // Small ones by the thousand; some over several of Mesa's blocks of 64 x 64; a few as large as the frame.
    compare_tiles(mesa, frame, frame % 16 == 5 ? k_frame : frame % 4 == 2 ? 256 : 32, tally);
  }
  report("in the window", tally);
  EXPECT_GT(tally.undecided, tally.triangles);
  EXPECT_EQ(tally.wrong, 0U) << tally.first;
}

TEST(Mesa, MovesEdgesByLessThanA256thWhereItClips) {
  MesaFrame mesa;
  ASSERT_TRUE(mesa.ready());
  // 60 by default, 2000 with FAROP_LONG_TESTS=1.
  const std::uint64_t wanted = test::repetitions(60, 2000);
  Tally whole, clipped;
  std::uint64_t unexplained = 0;
  std::string first_unexplained;
  const Window window{0, 0, k_frame, k_frame};
  for (std::uint64_t i = 0; i < wanted; ++i) {
    Random random("mesa/clipped", i, 1);
    const TestPolygon triangle =
        moved(random_triangle(random, i, k_wide), -k_margin * k_pixel, -k_margin * k_pixel);
    const bool flipped = i % 2 == 1;
    mesa.draw({triangle}, flipped, true);
    compare_window(mesa, triangle, window, flipped, whole, [](int, int) {});
    mesa.draw({triangle}, flipped);
    compare_window(mesa, triangle, window, flipped, clipped, [&](int x, int y) {
      if (explained_by_clipping(triangle, x, y)) return;
      if (unexplained++ == 0) first_unexplained = fmt::format("pixel {} {}; {}", x, y, text_of(triangle));
    });
  }
  report("beyond the window, view volume wide enough", whole);
  report("beyond the window, clipped", clipped);
  // The same triangles, so what differs is due to clipping alone ...
  EXPECT_EQ(whole.wrong, 0U) << whole.first;
  // ... and no more than rounding.
  EXPECT_EQ(unexplained, 0U) << first_unexplained;
  EXPECT_GT(clipped.wrong, 0U) << "then this is no test of clipping";
}

}  // namespace
}  // namespace farop::conformance
