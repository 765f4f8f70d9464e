// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers that are the same on every machine and in every language.
//
// Source: Steele, Lea & Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014 (SplitMix64);
// Fowler, Noll & Vo, FNV-1a.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace farop::conformance {

constexpr std::uint64_t k_fnv_offset = 0xCBF29CE484222325u;

/// FNV-1a, 64 bits; `hash` goes on from an earlier part.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = k_fnv_offset) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
  return hash;
}

/// SplitMix64.
class Random {
 public:
  explicit constexpr Random(std::uint64_t state) : state_(state) {}
  /// The stream of one case.
  constexpr Random(std::string_view name, std::uint64_t index, std::uint64_t seed)
      : Random(fnv1a(name) ^ index ^ (seed * 0x9E3779B97F4A7C15u)) {}

  constexpr std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// Evenly distributed 0..count-1, by rejection; count > 0.
  constexpr std::uint64_t below(std::uint64_t count) {
    const std::uint64_t surplus = (0 - count) % count;  // 2^64 mod count
    std::uint64_t bits = next();
    while (bits < surplus) bits = next();
    return bits % count;
  }
  /// Evenly distributed low..high, both included.
  constexpr int between(int low, int high) {
    return static_cast<int>(
        low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(std::int64_t{high} - low) + 1)));
  }
  /// Fisher-Yates.
  template <class T>
  constexpr void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace farop::conformance
