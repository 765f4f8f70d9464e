# SPDX-License-Identifier: GPL-3.0-or-later
"""One pixel per corner: a start in Python."""


class Rasterizer:
    wants = ()  # any polygon, concave ones too; ("triangles",) gets triangles only

    def create(self, host):
        self.host = host

    def begin_frame(self, frame):
        self.frame = frame
        # YOUR PART 3, beginning: the depth buffer. Keep one depth for each pixel, and set all of them farther than
        # frame.z_far here, because every picture starts empty.

    def polygon(self, p):
        bits = self.frame.subpixel_bits
        # YOUR PART 1: scan conversion, in place of this loop. Enter the edges into a table by the row of their lower
        # end; then, row by row upwards, the edges that cross a row, sorted by column, bound its spans in pairs. A
        # sample on a left or bottom edge is inside and one on a right or top edge is not, so that neighbours share no
        # pixel and leave none out.
        for v in p.vertices:
            # YOUR PART 2: interpolation. Depth and colour change by the same step from row to row along an edge, and
            # from column to column along a span: in NumPy a span is one assignment. Round to whole numbers last.
            self.set_pixel(v["x"] >> bits, v["y"] >> bits, v["z"], (v["r"], v["g"], v["b"]))

    def set_pixel(self, column, row, depth, rgb):
        """Row 0 is the bottom row. Corners always lie on the frame, and so does all that lies between them."""
        # YOUR PART 3, end: the depth test. Leave the pixel alone unless `depth` is smaller than what is kept for it;
        # if it is, keep it: whatever order the polygons come in, the nearest one is seen.
        self.frame.pixels[row, column] = rgb

    def end_frame(self):
        pass

    def destroy(self):
        pass
