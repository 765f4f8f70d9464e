// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_nff/nff_plain_run.h"

#include <algorithm>
#include <string_view>

#include "parse_nff/nff_numbers.h"
#include "parse_nff/nff_planarity.h"
#include "parse_nff/nff_short_number.h"

namespace farop::nff {
namespace {

/// A longer word is not looked at here.
constexpr std::ptrdiff_t k_longest_number = 64;
constexpr std::ptrdiff_t k_longest_count = 9;
constexpr std::size_t k_fill_numbers = 8;

// CR only in front of LF, so that LFs alone count the lines.
constexpr bool is_plain_space(char c) {
  return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

constexpr bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The word behind the white space at `at`; nullptr where that is not certain.
const char* next_word(const char* at, const char* readable) {
  for (;; ++at) {
    if (readable - at < 2) return nullptr;
    if (static_cast<unsigned char>(*at) > ' ') return at;
    if (!is_plain_space(*at) || (*at == '\r' && at[1] != '\n')) return nullptr;
  }
}

/// A number of any form; what stands behind it, or nullptr.
[[gnu::noinline]] const char* read_any_number(const char* at, const char* readable, double& value) {
  const char* const limit = at + std::min(k_longest_number, readable - at);
  const char* const behind = std::find_if(at, limit, is_plain_space);
  if (behind == limit) return nullptr;
  const std::string_view word(at, static_cast<std::size_t>(behind - at));
  return parse_number(word, value) == NumberSyntax::number ? behind : nullptr;
}

}  // namespace

PlainRun PlainRunReader::read(const char* at, const PlainText& text, SurfaceBuilder& builder,
                              const FillFunction& on_fill) {
  PlainRun run;
  while (at != nullptr && text.readable - at > k_short_number_bytes) {
    const char* behind = nullptr;
    if (*at == 'p') {
      behind = read_polygon(at, text, builder);
      if (behind == nullptr) break;
      ++(patches_ ? run.patches : run.polygons);
      run.ends_with_fill = false;
      run.last_keyword = at;
      run.last_corners = corner_counts_.back();
      run.last_is_patch = patches_;
    } else if (*at == 'f') {
      hand_over(builder);
      behind = read_fill(at, text);
      if (behind == nullptr) break;
      on_fill(material());
      run.begins_with_fill = run.begins_with_fill || run.behind == nullptr;
      run.ends_with_fill = true;
    } else {
      break;
    }
    run.behind = behind;
    at = next_word(behind, text.readable);
  }
  hand_over(builder);
  return run;
}

void PlainRunReader::hand_over(SurfaceBuilder& builder) {
  if (!corner_counts_.empty()) builder.add_polygons({numbers_.data(), used_}, corner_counts_, patches_);
  corner_counts_.clear();
  used_ = 0;
}

// Reads `wanted` numbers, the first of which is at `at`, to the end of numbers_. Returns what stands behind
// the last, or nullptr.
const char* PlainRunReader::read_numbers(const char* at, const PlainText& text, std::size_t wanted) {
  if (at == nullptr) return nullptr;
  double* number = numbers_.data() + used_;
  for (const double* const end = number + wanted;;) {
    if (text.readable - at < k_short_number_bytes) return nullptr;
    const char* behind = read_short_number(at, *number);
    if (behind == nullptr || (*behind != ' ' && *behind != '\n')) {
      behind = read_any_number(at, text.readable, *number);
      if (behind == nullptr || text.readable - behind < 2) return nullptr;
    }
    if (++number == end) return behind <= text.end ? behind : nullptr;
    at = behind + 1;  // mostly
    const bool sure = *behind != '\r' && static_cast<unsigned char>(*at) > ' ';
    if (!sure && (at = next_word(behind, text.readable)) == nullptr) return nullptr;
  }
}

const char* PlainRunReader::read_polygon(const char* at, const PlainText& text, SurfaceBuilder& builder) {
  const bool patch = at[1] == 'p';
  const std::size_t stride = patch ? 6 : 3;
  const char* digit = patch ? at + 2 : at + 1;
  if (!is_plain_space(*digit)) return nullptr;
  digit = next_word(digit, text.readable);
  if (digit == nullptr || text.readable - digit < k_short_number_bytes) return nullptr;
  std::size_t corners = 0;
  for (const char* const limit = digit + k_longest_count; *digit >= '0' && *digit <= '9'; ++digit) {
    if (digit == limit) return nullptr;
    corners = 10 * corners + static_cast<std::size_t>(*digit - '0');
  }
  if (!is_plain_space(*digit) || corners < 3 || corners * stride > k_most_numbers) return nullptr;
  if (patch != patches_ || used_ + corners * stride > k_most_numbers) hand_over(builder);
  patches_ = patch;
  const char* const behind = read_numbers(next_word(digit, text.readable), text, corners * stride);
  if (behind == nullptr || !last_is_flat(corners, stride)) return nullptr;
  used_ += corners * stride;
  corner_counts_.push_back(static_cast<std::uint32_t>(corners));
  return behind;
}

// Of the numbers read last: whether they are a polygon in a plane.
bool PlainRunReader::last_is_flat(std::size_t corners, std::size_t stride) const {
  if (corners == 3) return true;
  const double* n = numbers_.data() + used_;
  PlanarityCheck planarity;
  for (std::size_t i = 0; i < corners; ++i, n += stride) planarity.add(V3d(n[0], n[1], n[2]));
  return !(planarity.deviation() > k_planarity_tolerance);
}

const char* PlainRunReader::read_fill(const char* at, const PlainText& text) {
  if (!is_plain_space(at[1])) return nullptr;
  const char* const behind = read_numbers(next_word(at + 1, text.readable), text, k_fill_numbers);
  if (behind == nullptr) return nullptr;
  const double shine = numbers_[5], transmittance = numbers_[6];
  if (shine < 0 || transmittance < 0 || transmittance > 1) return nullptr;
  // A keyword on another line follows: neither a ninth number nor the name of a texture.
  const char* const next = next_word(behind, text.readable);
  if (next == nullptr || !is_letter(*next) || std::find(behind, next, '\n') == next) return nullptr;
  return behind;
}

Material PlainRunReader::material() const {
  Material m;
  m.color = {numbers_[0], numbers_[1], numbers_[2]};
  m.kd = numbers_[3], m.ks = numbers_[4], m.shine = numbers_[5];
  m.transmittance = numbers_[6], m.refraction = numbers_[7];
  return m;
}

}  // namespace farop::nff
