// SPDX-License-Identifier: GPL-3.0-or-later
// The tables that the tests run over; CMakeLists.txt fills them.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace farop::test {

struct TestedRasterizer {
  std::string name;     ///< of its build target
  std::string library;  ///< path
};

inline void PrintTo(const TestedRasterizer& rasterizer, std::ostream* out) {
  *out << rasterizer.name;
}

/// Those that take any polygon.
inline std::vector<TestedRasterizer> polygon_rasterizers() {
  return {FAROP_POLYGON_RASTERIZERS};
}

/// Those that ask for triangles.
inline std::vector<TestedRasterizer> triangle_rasterizers() {
  return {FAROP_TRIANGLE_RASTERIZERS};
}

inline std::vector<TestedRasterizer> all_rasterizers() {
  std::vector<TestedRasterizer> all = polygon_rasterizers();
  for (TestedRasterizer& one : triangle_rasterizers()) all.push_back(one);
  return all;
}

/// For INSTANTIATE_TEST_SUITE_P.
template <class Info>
std::string rasterizer_name(const Info& info) {
  return info.param.name;
}

}  // namespace farop::test
