// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a script: what Tcl's words mean to SIPP's commands.
//
// Every function throws ScriptError where a word is not what it has to be; `what` names the argument.
#pragma once

#include <tcl.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/color.h"
#include "core/math.h"

namespace farop::sipp {

/// Owns a reference to a value of Tcl.
class TclValue {
 public:
  TclValue() = default;
  explicit TclValue(Tcl_Obj* object) : object_(object) {
    if (object_ != nullptr) Tcl_IncrRefCount(object_);
  }
  explicit TclValue(std::string_view text)
      : TclValue(Tcl_NewStringObj(text.data(), static_cast<int>(text.size()))) {}
  TclValue(const TclValue& other) : TclValue(other.object_) {}
  TclValue& operator=(TclValue other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~TclValue() {
    if (object_ != nullptr) Tcl_DecrRefCount(object_);
  }

  Tcl_Obj* get() const { return object_; }

 private:
  Tcl_Obj* object_ = nullptr;
};

std::string_view text_of(Tcl_Obj* word);
/// The word in quotes, cut and without control characters, for messages.
std::string quoted(Tcl_Obj* word);
[[noreturn]] void unexpected(Tcl_Obj* word, std::string_view what, std::string_view expected);

/// Finite.
double number(Tcl_Obj* word, std::string_view what);
/// lowest .. highest; "4.0" is taken for 4.
std::int64_t integer(Tcl_Obj* word, std::string_view what, std::int64_t lowest, std::int64_t highest);
bool boolean(Tcl_Obj* word, std::string_view what);
/// A number with a prefix letter R (radians) or D (degrees), either case. Returns radians.
double angle_in_radians(Tcl_Obj* word, std::string_view what, bool degrees_without_prefix);

/// The elements of a list.
std::vector<Tcl_Obj*> list(Tcl_Obj* word, std::string_view what);
std::vector<Tcl_Obj*> list_of(Tcl_Obj* word, std::string_view what, std::size_t count,
                              std::string_view expected);
V3d vector(Tcl_Obj* word, std::string_view what);
V2d vector2(Tcl_Obj* word, std::string_view what);
/// Components >= 0, not limited to 1.
Rgb color(Tcl_Obj* word, std::string_view what);
/// {r g b}, or one number for all.
Rgb opacity(Tcl_Obj* word);
/// 4 rows of 4 with last column 0 0 0 1; the empty list is the identity.
M44d matrix(Tcl_Obj* word);
bool is_empty(Tcl_Obj* word);
/// Equal without regard to case.
bool is_word(Tcl_Obj* word, std::string_view keyword);

Tcl_Obj* new_text(std::string_view text);
Tcl_Obj* new_color(const Rgb& color);
Tcl_Obj* new_matrix(const M44d& matrix);

}  // namespace farop::sipp
