// SPDX-License-Identifier: GPL-3.0-or-later
// Which rows an edge crosses and which columns lie between two crossings: the places where a fill rule is
// decided.
#pragma once

#include "span.h"

struct Rows {
  int first, end;
};

/// Left and bottom belong, right and top do not: y_low <= row < y_high.
inline Rows rows_of(int y_low, int y_high) {
  switch (k_mutant) {
    case 1:  // 1, 3: the top belongs and the bottom does not, as where y points downwards
    case 3:
      return {y_low + 1, y_high + 1};
    case 18:  // 18: y_max - 1 "so that the corner is not counted twice", and then `<` as well
      return {y_low, y_high - 1};
    case 19:  // 19: the table is searched for edges that begin on the row before
      return {y_low + 1, y_high};
    case 20:  // 20: the edge is taken out after its last row has been drawn
      return {y_low, y_high + 1};
    default:
      return {y_low, y_high};
  }
}

struct Columns {
  int first, end;
};

/// ceil(left) <= column < ceil(right).
inline Columns columns_between(const Crossing& left, const Crossing& right) {
  const auto floor = [](const Crossing& c) { return static_cast<int>(floor_div(c.x, c.dy)); };
  const auto ceil = [](const Crossing& c) { return static_cast<int>(ceil_div(c.x, c.dy)); };
  const auto round = [](const Crossing& c) { return static_cast<int>(floor_div(2 * c.x + c.dy, 2 * c.dy)); };
  switch (k_mutant) {
    case 2:  // 2, 3: begins right of the left crossing and goes on to the right one
    case 3:
      return {floor(left) + 1, floor(right) + 1};
    case 9:  // 9 closed-span: x <= x_right
      return {ceil(left), floor(right) + 1};
    case 10:  // 10 touch: every pixel that the span touches
      return {floor(left), floor(right) + 1};
    case 11:  // 11 round: the nearest pixels, both drawn
      return {round(left), round(right) + 1};
    case 15:  // 15 trunc: (int) of both crossings
      return {floor(left), floor(right)};
    case 16:  // 16 round-1: (int)(x + 0.5) of both
      return {round(left), round(right)};
    default:
      return {ceil(left), ceil(right)};
  }
}
