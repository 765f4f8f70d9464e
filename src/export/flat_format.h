// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that the writer and the reader of the screen-coordinate flat file share (farop.md section 4).
//
//   XRES YRES ZRES CRES [subpixel bits]   the fifth number only where it is not 0
//   number of polygons
//   1                                     separator
//   n ymax ymin                           first line of each polygon,
//   x y z R G B                           then a line for each of its n vertices,
//   1                                     and a separator, also behind the last polygon
//   127                                   end mark, whatever CRES
#pragma once

#include <cstddef>
#include <cstdint>

namespace farop {

constexpr int k_flat_separator = 1;
constexpr int k_flat_end_mark = 127;
/// The writer fills the number of polygons with blanks to this width, so that it can be put in at the end.
constexpr std::size_t k_flat_count_width = 10;
constexpr std::int64_t k_max_flat_polygons = 9'999'999'999;

}  // namespace farop
