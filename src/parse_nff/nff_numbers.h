// SPDX-License-Identifier: GPL-3.0-or-later
// Number syntax of NFF: optional sign, decimal digits with an optional point on either side, optional
// exponent of any number of digits. Independent of the locale.
#pragma once

#include <cstdint>
#include <string_view>

namespace farop::nff {

enum class NumberSyntax { number, not_a_number, too_large };

/// Nearest double of a whole word. nan, inf, hexadecimal digits and a decimal comma are no numbers; what is
/// too large for a double is an error of its own; what is too small becomes 0 with the sign kept. `value` is
/// set for `number` only.
NumberSyntax parse_number(std::string_view text, double& value);

/// A plain integer: optional sign and digits, nothing else. Values beyond 64 bits become the nearest that
/// fits.
bool parse_integer(std::string_view text, std::int64_t& value);

/// Whether a word that is no number was probably meant as one: `1,5`, `0x1F`, `1e`, `nan`, `-inf`, `--5`.
bool resembles_number(std::string_view text);

}  // namespace farop::nff
