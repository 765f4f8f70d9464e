// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/chunked_array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace farop {
namespace {

TEST(ChunkedArray, HoldsWhatAVectorHoldsAcrossChunks) {
  ChunkedArray<std::uint32_t> array;
  const std::size_t count = 700'001;  // more than two chunks of a megabyte
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t i = 0; i < count; ++i) array.push_back(i + static_cast<std::uint32_t>(round));
    array[300'000] = 7;
    EXPECT_EQ(array[299'999], 299'999u + static_cast<unsigned>(round));
    std::vector<std::uint32_t> expected(count);
    std::iota(expected.begin(), expected.end(), static_cast<unsigned>(round));
    expected[300'000] = 7;
    const std::vector<std::uint32_t> got = array.move_to_vector();
    EXPECT_EQ(got, expected);
    EXPECT_EQ(got.capacity(), count);
    EXPECT_TRUE(array.empty());
  }
}

TEST(ChunkedArray, GoesOnBehindATruncation) {
  ChunkedArray<std::uint32_t> array;
  for (std::uint32_t i = 0; i < 600'000; ++i) array.push_back(i);
  array.truncate(100);
  array.push_back(1);
  const std::vector<std::uint32_t> got = array.move_to_vector();
  ASSERT_EQ(got.size(), 101u);
  EXPECT_EQ(got[99], 99u);
  EXPECT_EQ(got[100], 1u);
  array.assign(300'000, 5);
  EXPECT_EQ(array.size(), 300'000u);
  EXPECT_EQ(array[299'999], 5u);
}

}  // namespace
}  // namespace farop
