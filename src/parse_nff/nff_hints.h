// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace farop::nff {

using KeywordTest = std::function<bool(std::string_view)>;

/// The remedy for a word that stands where a keyword belongs and is none: the keyword that was probably meant
/// (other case, glued to its number, punctuation behind it, an English name, a slip of the pen), or else
/// which ones there are.
std::string hint_for_unknown_keyword(std::string_view word, const KeywordTest& is_keyword);

}  // namespace farop::nff
