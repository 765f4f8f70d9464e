// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_nff/nff_numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace farop::nff {
namespace {

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool is_sign(char c) {
  return c == '+' || c == '-';
}
constexpr char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string_view without_sign(std::string_view text) {
  if (!text.empty() && is_sign(text.front())) text.remove_prefix(1);
  return text;
}

// Decimal order of magnitude of a well-formed unsigned number: 123.4 has 3, 0.1 has 0, 0.001 has -2.
// std::from_chars does not tell overflow from underflow, this does.
std::int64_t magnitude(std::string_view text) {
  std::int64_t order = 0;
  bool after_point = false;
  bool significant = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.') {
      after_point = true;
    } else if (!is_digit(c)) {
      std::int64_t exponent = 0;
      parse_integer(text.substr(i + 1), exponent);
      const auto limit =
          std::numeric_limits<std::int64_t>::max() / 2;  // the digits of a word add little to it
      return order + std::clamp(exponent, -limit, limit);
    } else {
      significant = significant || c != '0';
      if (significant && !after_point) ++order;
      if (!significant && after_point) --order;
    }
  }
  return order;
}

}  // namespace

NumberSyntax parse_number(std::string_view text, double& value) {
  const std::string_view digits = without_sign(text);
  // std::from_chars would take words such as "inf", and takes no '+'.
  if (digits.empty() || !(is_digit(digits.front()) || digits.front() == '.'))
    return NumberSyntax::not_a_number;
  const std::string_view number = text.front() == '+' ? digits : text;
  const char* last = number.data() + number.size();
  double read = 0;
  const auto [end, error] = std::from_chars(number.data(), last, read);
  if (end != last || error == std::errc::invalid_argument) return NumberSyntax::not_a_number;
  if (error == std::errc::result_out_of_range || std::isinf(read)) {
    if (magnitude(digits) > 0) return NumberSyntax::too_large;
    read = text.front() == '-' ? -0.0 : 0.0;
  }
  value = read;
  return NumberSyntax::number;
}

bool parse_integer(std::string_view text, std::int64_t& value) {
  const std::string_view digits = without_sign(text);
  if (digits.empty() || !std::all_of(digits.begin(), digits.end(), is_digit)) return false;
  const bool negative = text.front() == '-';
  const std::string_view number = negative ? text : digits;
  if (std::from_chars(number.data(), number.data() + number.size(), value).ec ==
      std::errc::result_out_of_range) {
    value = negative ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
  }
  return true;
}

bool resembles_number(std::string_view text) {
  const bool has_sign = !text.empty() && is_sign(text.front());
  const std::string_view rest = without_sign(text);
  constexpr std::array<std::string_view, 3> k_names = {"nan", "inf", "infinity"};
  const auto same_letters = [&](std::string_view name) {
    return std::equal(rest.begin(), rest.end(), name.begin(), name.end(),
                      [](char a, char b) { return to_lower(a) == b; });
  };
  if (std::any_of(k_names.begin(), k_names.end(), same_letters)) return true;
  constexpr std::string_view k_digits_and_marks = "0123456789abcdefABCDEFxXpP+-.,_'";
  if (text.find_first_not_of(k_digits_and_marks) != std::string_view::npos) return false;
  return text.find_first_of("0123456789") != std::string_view::npos &&
         (has_sign || text.front() == '.' || is_digit(text.front()));
}

}  // namespace farop::nff
