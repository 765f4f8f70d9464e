// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/nff_losses.h"

#include <algorithm>

namespace farop {

void NffLosses::add(const std::string& phrase) {
  if (std::find(phrases_.begin(), phrases_.end(), phrase) == phrases_.end()) phrases_.push_back(phrase);
}

void NffLosses::add(const std::vector<std::string>& phrases) {
  for (const std::string& phrase : phrases) add(phrase);
}

std::string NffLosses::text() const {
  std::string text;
  for (const std::string& phrase : phrases_) text += (text.empty() ? "" : "; ") + phrase;
  return text;
}

}  // namespace farop
