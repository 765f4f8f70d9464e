// SPDX-License-Identifier: GPL-3.0-or-later
// The short way through a decimal number: where it ends is found by comparing 16 bytes at once, and its
// digits are converted eight at a time, so that neither its length nor its sign is a branch for the processor
// to guess.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace farop::nff {

/// read_short_number() looks at so many bytes.
constexpr std::ptrdiff_t k_short_number_bytes = 32;

namespace short_number {

inline std::uint64_t load_bytes(const char* at) {
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, at, sizeof bytes);
  if constexpr (std::endian::native == std::endian::big) bytes = __builtin_bswap64(bytes);
  return bytes;
}

/// Bit i says something about byte i of 16.
struct ByteMasks {
  std::uint32_t no_digit, point, minus;
};

inline ByteMasks byte_masks(const char* at) {
#ifdef __SSE2__
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
  const auto mask = [](__m128i equal) { return static_cast<std::uint32_t>(_mm_movemask_epi8(equal)); };
  const __m128i above_zero = _mm_sub_epi8(bytes, _mm_set1_epi8('0'));
  const __m128i is_digit = _mm_cmpeq_epi8(_mm_min_epu8(above_zero, _mm_set1_epi8(9)), above_zero);
  return {mask(is_digit) ^ 0xFFFFu, mask(_mm_cmpeq_epi8(bytes, _mm_set1_epi8('.'))),
          mask(_mm_cmpeq_epi8(bytes, _mm_set1_epi8('-')))};
#else
  ByteMasks masks{0, 0, 0};
  for (unsigned i = 0; i < 16; ++i) {
    masks.no_digit |= std::uint32_t{static_cast<unsigned char>(at[i] - '0') > 9} << i;
    masks.point |= std::uint32_t{at[i] == '.'} << i;
    masks.minus |= std::uint32_t{at[i] == '-'} << i;
  }
  return masks;
#endif
}

/// The value of the last `count` of the eight digits in `bytes`, 1 to 8, the first digit in the lowest byte.
/// (D. Lemire, "Number parsing at a gigabyte per second", Software: Practice and Experience 51(8), 2021.)
inline std::uint64_t digits_value(std::uint64_t bytes, unsigned count) {
  std::uint64_t digits = (bytes ^ 0x3030303030303030u) << 8 * (8 - count);  // zeros in front
  digits = digits * 10 + (digits >> 8);
  return (((digits & 0x000000FF000000FFu) * 0x000F424000000064u) +
          (((digits >> 16) & 0x000000FF000000FFu) * 0x0000271000000001u)) >>
         32;
}

// Powers of ten that are doubles without rounding: a quotient of two exact numbers is rounded once (W. D.
// Clinger, "How to Read Floating Point Numbers Accurately", PLDI 1990).
constexpr std::array<double, 9> k_power_of_ten = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};

/// All bits of the lowest i bytes.
constexpr std::array<std::uint64_t, 9> k_lowest_bytes = {0,
                                                         0xFF,
                                                         0xFFFF,
                                                         0xFFFFFF,
                                                         0xFFFFFFFF,
                                                         0xFFFFFFFFFF,
                                                         0xFFFFFFFFFFFF,
                                                         0xFFFFFFFFFFFFFF,
                                                         0xFFFFFFFFFFFFFFFF};

}  // namespace short_number

/// The number at `at`, if it is [-] up to eight digits with or without a point before, among or behind them:
/// rounded to nearest. Returns what stands behind it, whatever that is, or nullptr in every other case.
/// k_short_number_bytes must be readable.
inline const char* read_short_number(const char* at, double& value) {
  using namespace short_number;
  const ByteMasks masks = byte_masks(at);
  // What the place of the next number depends on comes first, and is short.
  const std::uint32_t minus = masks.minus & 1;
  const std::uint32_t others = (masks.no_digit ^ minus) | 0x10000u;
  const std::uint32_t point = others & (0 - others) & masks.point;  // the first of them, if it is a point
  const auto end = static_cast<unsigned>(std::countr_zero((others ^ point) | 0x10000u));
  const auto digits = end - minus - static_cast<unsigned>(point != 0);
  if (digits - 1 > 7) return nullptr;
  // The digits without the point between them.
  const unsigned whole = static_cast<unsigned>(std::countr_zero(others)) - minus;
  const std::uint64_t before_point = k_lowest_bytes[whole];
  const std::uint64_t bytes =
      (load_bytes(at + minus) & before_point) | (load_bytes(at + minus + 1) & ~before_point);
  const double size = static_cast<double>(static_cast<std::int64_t>(digits_value(bytes, digits))) /
                      k_power_of_ten[digits - whole];
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(size) | std::uint64_t{minus} << 63);
  return at + end;
}

}  // namespace farop::nff
