// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/tcl_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "core/diagnostics.h"
#include "parse_sipp/script_error_internal.h"

namespace farop::sipp {

std::string_view text_of(Tcl_Obj* word) {
  int length = 0;
  const char* text = Tcl_GetStringFromObj(word, &length);
  return {text, static_cast<std::size_t>(length)};
}

std::string quoted(Tcl_Obj* word) {
  return fmt::format("'{}'", printable(text_of(word)));
}

void unexpected(Tcl_Obj* word, std::string_view what, std::string_view expected) {
  throw ScriptError(fmt::format("{} found for {}, expected {}", quoted(word), what, expected),
                    std::string(text_of(word)));
}

double number(Tcl_Obj* word, std::string_view what) {
  double value = 0;
  if (Tcl_GetDoubleFromObj(nullptr, word, &value) != TCL_OK || !std::isfinite(value)) {
    unexpected(word, what, "a finite number");
  }
  return value;
}

std::int64_t integer(Tcl_Obj* word, std::string_view what, std::int64_t lowest, std::int64_t highest) {
  Tcl_WideInt value = 0;
  double real = 0;
  bool ok = Tcl_GetWideIntFromObj(nullptr, word, &value) == TCL_OK;
  if (!ok && Tcl_GetDoubleFromObj(nullptr, word, &real) == TCL_OK && std::abs(real) < 1e15 &&
      real == std::floor(real)) {
    value = static_cast<Tcl_WideInt>(real);
    ok = true;
  }
  if (!ok || value < lowest || value > highest) {
    unexpected(word, what, fmt::format("a whole number {}..{}", lowest, highest));
  }
  return value;
}

bool boolean(Tcl_Obj* word, std::string_view what) {
  for (const std::string_view yes : {"1", "true", "t", "yes", "on"}) {
    if (is_word(word, yes)) return true;
  }
  for (const std::string_view no : {"0", "false", "f", "no", "off"}) {
    if (is_word(word, no)) return false;
  }
  unexpected(word, what, "0, 1, true or false");
}

double angle_in_radians(Tcl_Obj* word, std::string_view what, bool degrees_without_prefix) {
  std::string_view text = text_of(word);
  const char prefix =
      text.empty() ? '\0' : static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  bool degrees = degrees_without_prefix;
  double value = 0;
  const char* expected = "a finite number, or one behind R (radians) or D (degrees)";
  if (prefix == 'R' || prefix == 'D') {
    degrees = prefix == 'D';
    const TclValue rest(text.substr(1));
    if (Tcl_GetDoubleFromObj(nullptr, rest.get(), &value) != TCL_OK) unexpected(word, what, expected);
  } else if (Tcl_GetDoubleFromObj(nullptr, word, &value) != TCL_OK) {
    unexpected(word, what, expected);
  }
  if (!std::isfinite(value)) unexpected(word, what, expected);
  return degrees ? value * (std::numbers::pi / 180) : value;
}

std::vector<Tcl_Obj*> list(Tcl_Obj* word, std::string_view what) {
  int count = 0;
  Tcl_Obj** elements = nullptr;
  if (Tcl_ListObjGetElements(nullptr, word, &count, &elements) != TCL_OK) {
    unexpected(word, what, "a list");
  }
  return {elements, elements + count};
}

std::vector<Tcl_Obj*> list_of(Tcl_Obj* word, std::string_view what, std::size_t count,
                              std::string_view expected) {
  std::vector<Tcl_Obj*> elements = list(word, what);
  if (elements.size() != count) unexpected(word, what, expected);
  return elements;
}

V3d vector(Tcl_Obj* word, std::string_view what) {
  const std::vector<Tcl_Obj*> e = list_of(word, what, 3, "{x y z}");
  return {number(e[0], what), number(e[1], what), number(e[2], what)};
}

V2d vector2(Tcl_Obj* word, std::string_view what) {
  const std::vector<Tcl_Obj*> e = list(word, what);
  if (e.size() != 2 && e.size() != 3) unexpected(word, what, "{x y}");
  return {number(e[0], what), number(e[1], what)};
}

Rgb color(Tcl_Obj* word, std::string_view what) {
  const std::vector<Tcl_Obj*> e = list_of(word, what, 3, "{red green blue}");
  std::array<double, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = number(e[i], what);
    if (c[i] < 0) unexpected(word, what, "{red green blue}, each >= 0");
  }
  return {c[0], c[1], c[2]};
}

Rgb opacity(Tcl_Obj* word) {
  const std::vector<Tcl_Obj*> e = list(word, "opacity");
  if (e.size() != 1 && e.size() != 3) unexpected(word, "opacity", "{red green blue} or one number, 0..1");
  std::array<double, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = number(e[e.size() == 1 ? 0 : i], "opacity");
    if (c[i] < 0 || c[i] > 1) unexpected(word, "opacity", "{red green blue} or one number, 0..1");
  }
  return {c[0], c[1], c[2]};
}

M44d matrix(Tcl_Obj* word) {
  const char* expected = "a matrix {{a b c 0} {d e f 0} {g h i 0} {tx ty tz 1}}";
  M44d m;
  const std::vector<Tcl_Obj*> rows = list(word, "matrix");
  if (rows.empty()) return m;
  if (rows.size() != 4) unexpected(word, "matrix", expected);
  for (int r = 0; r < 4; ++r) {
    const std::vector<Tcl_Obj*> row =
        list_of(rows[static_cast<std::size_t>(r)], "row of the matrix", 4, expected);
    for (int c = 0; c < 4; ++c) m[r][c] = number(row[static_cast<std::size_t>(c)], "matrix");
    if (m[r][3] != (r == 3 ? 1 : 0)) unexpected(word, "matrix", "a last column of 0 0 0 1");
  }
  return m;
}

bool is_empty(Tcl_Obj* word) {
  return text_of(word).empty();
}

bool is_word(Tcl_Obj* word, std::string_view keyword) {
  const std::string_view text = text_of(word);
  return text.size() == keyword.size() &&
         std::equal(text.begin(), text.end(), keyword.begin(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

Tcl_Obj* new_text(std::string_view text) {
  return Tcl_NewStringObj(text.data(), static_cast<int>(text.size()));
}

Tcl_Obj* new_color(const Rgb& color) {
  Tcl_Obj* elements[] = {Tcl_NewDoubleObj(color.r), Tcl_NewDoubleObj(color.g), Tcl_NewDoubleObj(color.b)};
  return Tcl_NewListObj(3, elements);
}

Tcl_Obj* new_matrix(const M44d& matrix) {
  Tcl_Obj* rows[4];
  for (int r = 0; r < 4; ++r) {
    Tcl_Obj* row[4];
    for (int c = 0; c < 4; ++c) row[c] = Tcl_NewDoubleObj(matrix[r][c]);
    rows[r] = Tcl_NewListObj(4, row);
  }
  return Tcl_NewListObj(4, rows);
}

}  // namespace farop::sipp
