# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/rasterizers/zbuffer.py and dots.py against the definitions, in exact fractions. The argument is their folder."""
import random
import sys
import types
import unittest
from fractions import Fraction

try:
    import numpy as np
except ImportError:
    print("zbuffer_py_test: NumPy is not installed")
    sys.exit(77)  # ctest: skipped

sys.path.insert(0, sys.argv.pop(1) if len(sys.argv) > 1 else "docs/rasterizers")
import dots
from zbuffer import Rasterizer

VERTEX = np.dtype([("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("r", "u1"), ("g", "u1"), ("b", "u1"), ("reserved", "u1")])


def triangle(*corners):
    vertices = np.array([(*c, 0) for c in corners], VERTEX)
    vertices.flags.writeable = False
    return types.SimpleNamespace(vertices=vertices)


def draw(rasterizer, width, height, triangles, bits=0, background=0):
    pixels = np.full((height, width + 3, 3), background, np.uint8)[:, :width]  # rows are not contiguous
    rasterizer.begin_frame(types.SimpleNamespace(pixels=pixels, width=width, height=height, subpixel_bits=bits))
    for one in triangles:
        rasterizer.polygon(one)
    rasterizer.end_frame()
    return pixels


def covers(corners, x, y):
    """Odd-even count of the edges at or left of the sample; left and bottom edges belong."""
    inside = False
    for i in range(3):
        low, high = sorted((corners[i], corners[i - 1]), key=lambda c: c[1])
        if low[1] <= y < high[1]:
            inside ^= low[0] + Fraction(y - low[1]) * (high[0] - low[0]) / (high[1] - low[1]) <= x
    return inside


def exact(corners, x, y, member):
    (x0, y0), (x1, y1), (x2, y2) = (c[:2] for c in corners)
    area = Fraction((x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0))
    w1, w2 = ((x - x0) * (y2 - y0) - (y - y0) * (x2 - x0)) / area, ((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / area
    return corners[0][member] * (1 - w1 - w2) + corners[1][member] * w1 + corners[2][member] * w2


class ZBuffer(unittest.TestCase):
    def setUp(self):
        self.random = random.Random(1)
        self.rasterizer = Rasterizer()
        self.rasterizer.create(None)

    def tearDown(self):
        self.rasterizer.destroy()

    def corner(self, width, height):
        integer = self.random.randrange
        return (integer(width), integer(height), integer(65536), integer(1, 256), integer(256), integer(256))

    def test_takes_triangles(self):
        self.assertEqual(Rasterizer.wants, ("triangles",))

    def test_covers_and_colours_every_sample(self):
        for i in range(300):
            bits = i % 3 * 2
            width, height = self.random.randint(1, 14), self.random.randint(1, 14)
            corners = [self.corner(((width - 1) << bits) + 1, ((height - 1) << bits) + 1) for _ in range(3)]
            pixels = draw(self.rasterizer, width, height, [triangle(*corners)], bits)
            for y in range(height):
                for x in range(width):
                    at = (x << bits, y << bits)
                    self.assertEqual(pixels[y, x, 0] != 0, covers(corners, *at), (corners, x, y))
                    for channel in range(3):
                        if pixels[y, x, 0] != 0:
                            self.assertLess(abs(int(pixels[y, x, channel]) - exact(corners, *at, 3 + channel)), 1)

    def test_shows_the_nearest_and_of_equals_the_first(self):
        def square(z, shade):
            a, b, c, d = ((x, y, z, shade, 0, 0) for x, y in ((0, 0), (9, 0), (9, 9), (0, 9)))
            return [triangle(a, b, c), triangle(a, c, d)]

        for shades, expected in ((((200, 1), (100, 2), (300, 3)), 2), (((65535, 4), (65535, 5)), 4)):
            scene = [t for z, shade in shades for t in square(z, shade)]
            pixels = draw(self.rasterizer, 10, 10, scene)
            self.assertTrue((pixels[:9, :9, 0] == expected).all())
            self.assertTrue((pixels[9] == 0).all() and (pixels[:, 9] == 0).all())

    def test_interpolates_depth(self):
        """Two planes that cross at x = 31.5, in both orders."""
        planes = [
            [triangle(*((x, y, depth(x), shade, 0, 0) for x, y in half)) for half in (((8, 8), (56, 8), (56, 56)), ((8, 8), (56, 56), (8, 56)))]
            for depth, shade in ((lambda x: 36 + 8 * x, 50), (lambda x: 540 - 8 * x, 90))
        ]
        for scene in (planes[0] + planes[1], planes[1] + planes[0]):
            pixels = draw(self.rasterizer, 64, 64, scene)
            self.assertTrue((pixels[8:56, 8:32, 0] == 50).all() and (pixels[8:56, 32:56, 0] == 90).all())


class Dots(unittest.TestCase):
    def test_draws_one_pixel_a_corner(self):
        for bits in 0, 3:
            rasterizer = dots.Rasterizer()
            rasterizer.create(None)
            corners = [(0, 0, 0, 1, 2, 3), (20 << bits, 8 << bits, 9, 255, 128, 127), (5 << bits, 4 << bits, 7, 200, 0, 1)]
            pixels = draw(rasterizer, 21, 9, [triangle(*corners)], bits, background=77)
            expected = np.full((9, 21, 3), 77)
            for x, y, _, *rgb in corners:
                expected[y >> bits, x >> bits] = rgb
            self.assertTrue((pixels == expected).all())
            rasterizer.destroy()


if __name__ == "__main__":
    unittest.main()
