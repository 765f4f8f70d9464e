# SPDX-License-Identifier: GPL-3.0-or-later
"""A z-buffer for triangles with Gouraud colour, the whole bounding box of a triangle at once."""
import numpy as np


class Rasterizer:
    wants = ("triangles",)

    def create(self, host):
        self.host = host

    def begin_frame(self, frame):
        self.frame = frame
        self.depth = np.full(frame.pixels.shape[:2], 2**31 - 1, np.int64)  # beyond the far plane

    def polygon(self, p):
        corners, bits = p.vertices, self.frame.subpixel_bits
        x, y = corners["x"].astype(np.int64), corners["y"].astype(np.int64)
        area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])
        if area == 0:
            return
        if area < 0:  # clockwise: counter-clockwise from here on
            corners, x, y, area = corners[::-1], x[::-1], y[::-1], -area
        rows, columns = (slice(v.min() >> bits, (v.max() >> bits) + 1) for v in (y, x))
        sample_y, sample_x = (v << bits for v in np.mgrid[rows, columns])

        inside, weights = True, []
        for i, j in ((1, 2), (2, 0), (0, 1)):  # positive: the sample lies left of the edge from i to j
            weight = (x[j] - x[i]) * (sample_y - y[i]) - (y[j] - y[i]) * (sample_x - x[i])
            lost = y[i] < y[j] or (y[i] == y[j] and x[i] > x[j])  # right and top edges are the neighbour's
            inside = inside & (weight >= int(lost))
            weights.append(weight / area)

        def mix(field):
            return np.floor(sum(w * float(v) for w, v in zip(weights, corners[field])) + 0.5)

        z, depth = mix("z"), self.depth[rows, columns]
        shown = inside & (z < depth)  # of equal depths the first drawn stays
        depth[shown] = z[shown]
        for channel, field in enumerate("rgb"):
            self.frame.pixels[rows, columns, channel][shown] = mix(field)[shown]

    def end_frame(self):
        pass

    def destroy(self):
        pass
