// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolate/frame_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include "core/error.h"
#include "isolate/protocol.h"

namespace farop::isolate {
namespace {

constexpr std::uint64_t k_block = std::uint64_t{1} << 20;
/// Frames up to this size are kept as they were sent: the same again is for free then.
constexpr std::uint64_t k_max_kept = std::uint64_t{32} << 20;

/// Word number `index` of a stream: the finisher of splitmix64 (Steele, Lea, Flood 2014). Unguessable in
/// passing, and any part of the stream can be had alone.
std::uint64_t random_word(std::uint64_t seed, std::uint64_t index) {
  std::uint64_t z = seed + (index + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

std::int64_t floor_divided(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

const char* rows(std::int64_t count) {
  return count == 1 ? "row" : "rows";
}

}  // namespace

std::string write_verdict(std::int64_t offset, const farop_frame& frame) {
  if (offset < 0) return "oob.write-before";
  if (offset >= frame.row_bytes * frame.height) return "oob.write-after";
  return offset % frame.row_bytes < 3 * std::int64_t{frame.width} ? "" : "oob.write-stride";
}

std::string place_of(std::int64_t offset, const farop_frame& frame) {
  const std::int64_t y = floor_divided(offset, frame.row_bytes);
  const std::int64_t x = (offset - y * frame.row_bytes) / 3;
  std::string pixel = fmt::format("row {}, column {}", y, x);
  if (offset < 0) {
    return fmt::format("{} ({} {} before the first)", pixel, -y, rows(-y));
  }
  if (y >= frame.height) {
    return fmt::format("{} ({} {} behind the last)", pixel, y - frame.height + 1, rows(y - frame.height + 1));
  }
  if (x >= frame.width) {
    return fmt::format("row {}, {} bytes behind its last pixel", y,
                       offset - y * frame.row_bytes - 3 * std::int64_t{frame.width});
  }
  return pixel;
}

void FrameMemory::make(std::uint64_t at, std::span<std::byte> bytes) const {
  const std::uint64_t end = at + bytes.size();
  for (std::uint64_t word = at / 8; word * 8 < end; ++word) {
    const std::uint64_t value = random_word(seed_, word);
    const std::uint64_t from = std::max(at, word * 8), to = std::min(end, word * 8 + 8);
    std::memcpy(bytes.data() + (from - at), reinterpret_cast<const char*>(&value) + (from - word * 8),
                to - from);
  }
}

bool FrameMemory::prepare(farop_frame& frame) {
  frame.row_bytes = (3 * std::int64_t{frame.width} + 15) / 16 * 16 + 16;
  frame.pixels = nullptr;
  bytes_ = static_cast<std::uint64_t>(frame.row_bytes * (frame.height - 1) + 3 * std::int64_t{frame.width});
  const std::uint64_t all = whole_pages(bytes_ + k_apron_bytes);
  offset_ = touches_ == Touches::end ? all - bytes_ : 0;
  const bool is_new = !memory_ || memory_.bytes() != all;
  const std::pair size(frame.width, frame.height);
  const bool is_alike = std::exchange(size_, size) == size;
  if (std::exchange(is_intact_, false) && is_alike && !is_new) return false;
  try {
    if (is_new) {
      memory_ = SharedMemory();  // the old one first: never two of them
      sent_ = {}, got_ = {};
      memory_ = SharedMemory("farop-frame", all);
      got_.resize(all);
      if (all <= k_max_kept) {
        sent_.resize(all);
        make(0, sent_);
      }
    }
    if (!sent_.empty()) {
      memory_.write(0, sent_);
    } else {
      std::vector<std::byte> block(k_block);
      for (std::uint64_t at = 0; at < all; at += k_block) {
        const std::span<std::byte> part = std::span(block).first(std::min(k_block, all - at));
        make(at, part);
        memory_.write(at, part);
      }
    }
  } catch (const std::bad_alloc&) {
    throw Error(ExitStatus::surroundings,
                fmt::format("not enough memory for a frame of {} x {} pixels", frame.width, frame.height),
                "use a smaller --resolution or fewer --samples");
  }
  return is_new;
}

std::vector<PluginFinding> FrameMemory::fetch(farop_frame& frame) {
  if (!memory_.read(0, got_)) {
    throw Error(ExitStatus::surroundings, "cannot read back what the rasterizer has drawn");
  }
  frame.pixels = reinterpret_cast<std::uint8_t*>(got_.data() + offset_);
  std::vector<PluginFinding> findings;
  std::vector<std::byte> scratch;
  const auto look = [&](std::uint64_t begin, std::uint64_t end, const char* verdict, const char* hint) {
    if (end <= begin) return false;
    if (sent_.empty()) {
      scratch.resize(end - begin);
      make(begin, scratch);
    }
    const std::byte* const sent = sent_.empty() ? scratch.data() : &sent_[begin];
    if (std::memcmp(sent, &got_[begin], end - begin) == 0) return false;
    std::uint64_t first = begin, count = 0;
    for (std::uint64_t i = begin; i < end; ++i) {
      if (sent[i - begin] == got_[i]) continue;
      if (count++ == 0) first = i;
    }
    PluginFinding finding;
    finding.verdict = verdict;
    const std::int64_t at = static_cast<std::int64_t>(first) - static_cast<std::int64_t>(offset_);
    finding.message =
        fmt::format("it wrote outside the frame: {} bytes, the first at {}", count, place_of(at, frame));
    finding.hint = hint;
    findings.push_back(std::move(finding));
    return true;
  };
  look(0, offset_, "oob.write-before", "check coordinates against 0 before you write");
  for (int y = 0; y < frame.height; ++y) {
    const std::uint64_t row = offset_ + static_cast<std::uint64_t>(y * frame.row_bytes);
    const std::uint64_t gap = row + 3 * static_cast<std::uint64_t>(frame.width);
    const std::uint64_t end =
        std::min<std::uint64_t>(row + static_cast<std::uint64_t>(frame.row_bytes), memory_.bytes());
    if (look(gap, end, "oob.write-stride",
             "a row has 3 * width bytes of pixels; the next one begins row_bytes after it")) {
      break;
    }
  }
  look(offset_ + static_cast<std::uint64_t>(frame.row_bytes * frame.height), memory_.bytes(),
       "oob.write-after", "check coordinates against width and height before you write");
  is_intact_ = findings.empty();
  return findings;
}

}  // namespace farop::isolate
