// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace farop {

/// Hands a WordReader its text in blocks, so that somebody may look at it before.
class TextFeed {
 public:
  /// Bytes begin .. end of `data` are the text behind what was handed over before. Before `begin` stands
  /// earlier text, up to `readable` later text: for the source lines of messages.
  struct Block {
    const char* data = nullptr;
    std::size_t begin = 0, end = 0, readable = 0;
  };

  virtual ~TextFeed() = default;
  /// The next block, never an empty one; the one before is gone then. False at the end of the text. No block
  /// but the last ends within a word of less than WordReader::k_max_word bytes.
  virtual bool next(Block& block) = 0;
};

}  // namespace farop
