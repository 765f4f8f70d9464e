// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_nff/nff_read_ahead.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "parse_nff/nff_short_number.h"

namespace farop::nff {
namespace {

/// Earlier text that goes with a piece of a file, for the source lines of messages.
constexpr std::size_t k_context = 1024;
/// A line of which more lies behind the end of a piece is cut between words.
constexpr std::size_t k_longest_rest = std::size_t{1} << 16;
static_assert(k_longest_rest > 2 * WordReader::k_max_word);

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

/// Where to end a piece of `text`, which goes on behind it: behind the last line end; of a very long line
/// behind a word; of a very long word anywhere. 0: nowhere yet.
std::size_t place_to_cut(std::string_view text) {
  const std::size_t behind_line = text.rfind('\n') + 1;  // 0 where there is none
  if (behind_line > 0 && text.size() - behind_line <= k_longest_rest) return behind_line;
  if (text.size() <= k_longest_rest) return 0;
  const auto last = text.rbegin() + k_longest_rest;
  const auto space = std::find_if(text.rbegin(), last, is_space);
  return space == last ? text.size() : static_cast<std::size_t>(text.rend() - space);
}

/// What a thread needs to search pieces.
struct Searcher {
  PlainRunReader reader;
  SurfaceBuilder builder;

  /// The run at `at`; false where there is none.
  bool search(const char* at, const PlainText& text, RunAhead& run) {
    run.parts.emplace_back();
    const auto end_part = [&](const Material& next) {
      const bool keep = !builder.empty();
      Surface surface = builder.take(next);
      if (keep) run.parts.back().surface = std::make_shared<Surface>(std::move(surface));
    };
    run.entities = reader.read(at, text, builder, [&](const Material& material) {
      end_part(material);
      run.parts.push_back({material, nullptr});
    });
    if (run.entities.behind == nullptr) return false;
    end_part({});
    const auto place = [&](const char* behind) {
      return WordReader::place_behind(Word(), {at, static_cast<std::size_t>(behind - at)});
    };
    run.behind = place(run.entities.behind);
    if (run.entities.last_keyword != nullptr) run.last_keyword = place(run.entities.last_keyword);
    return true;
  }
};

}  // namespace

struct ReadAhead::Searchers {
  tbb::enumerable_thread_specific<Searcher> each;
};

struct ReadAhead::Piece {
  std::unique_ptr<char[]> room;  ///< of its text, where that is of a file
  Block block;
  PlainText text;
  std::uint64_t offset = 0;  ///< of the block's begin in the text
  bool starts_line = true;
  std::vector<RunAhead> runs;
  std::size_t next_run = 0;
  tbb::task_group task;

  void search(Searcher& searcher) {
    const char* at = block.data + block.begin;
    const auto next_line = [&] {
      const void* const line_end = std::memchr(at, '\n', static_cast<std::size_t>(text.end - at));
      return line_end == nullptr ? text.end : static_cast<const char*>(line_end) + 1;
    };
    if (!starts_line) at = next_line();
    for (; at < text.end; at = next_line()) {
      while (at < text.end && (*at == ' ' || *at == '\t')) ++at;
      if (at == text.end || (*at != 'p' && *at != 'f')) continue;
      RunAhead run;
      run.begin = offset + static_cast<std::uint64_t>(at - (block.data + block.begin));
      if (!searcher.search(at, text, run)) continue;
      at = run.entities.behind;
      runs.push_back(std::move(run));
    }
  }
};

ReadAhead::ReadAhead(WordReader& reader, int threads, std::size_t piece)
    : reader_(reader),
      memory_(reader.text_in_memory()),
      piece_bytes_(std::max<std::size_t>(piece, 1)),
      pieces_at_once_(static_cast<std::size_t>(threads) + 2),
      searchers_(std::make_unique<Searchers>()),
      next_offset_(reader.bytes_read()) {
  reader_.set_feed(this);
}

ReadAhead::~ReadAhead() {
  reader_.set_feed(nullptr);
  for (const auto& piece : waiting_) piece->task.cancel();
  for (const auto& piece : waiting_) {
    try {
      piece->task.wait();
    } catch (...) {  // nobody needs what it was for
    }
  }
}

bool ReadAhead::worthwhile(const WordReader& reader, std::size_t piece) {
  const std::optional<std::string_view> memory = reader.text_in_memory();
  const std::uint64_t bytes = memory ? memory->size() : reader.is_regular_file() ? reader.bytes_total() : 0;
  return bytes / 2 > piece;
}

bool ReadAhead::next(Block& block) {
  if (current_ != nullptr && current_->room != nullptr) free_.push_back(std::move(current_->room));
  current_.reset();
  start_pieces();
  if (waiting_.empty()) return false;
  current_ = std::move(waiting_.front());
  waiting_.pop_front();
  start_pieces();
  current_->task.wait();  // helps with others meanwhile
  block = current_->block;
  return true;
}

void ReadAhead::start_pieces() {
  while (!at_end_ && waiting_.size() < pieces_at_once_) {
    std::unique_ptr<Piece> piece = memory_ ? cut_from_memory() : read_from_file();
    if (piece->block.begin == piece->block.end) return;
    Piece* const p = piece.get();
    waiting_.push_back(std::move(piece));
    p->task.run([this, p] { p->search(searchers_->each.local()); });
  }
}

std::unique_ptr<ReadAhead::Piece> ReadAhead::cut_from_memory() {
  auto piece = std::make_unique<Piece>();
  const std::string_view rest = memory_->substr(taken_);
  std::size_t cut = 0;
  for (std::size_t looked_at = piece_bytes_; cut == 0; looked_at += piece_bytes_) {
    at_end_ = looked_at >= rest.size();
    cut = at_end_ ? rest.size() : place_to_cut(rest.substr(0, looked_at));
    if (at_end_) break;
  }
  piece->block = {memory_->data(), taken_, taken_ + cut, memory_->size()};
  piece->text.readable = memory_->data() + memory_->size();
  taken_ += cut;
  finish_piece(*piece, cut);
  return piece;
}

std::unique_ptr<ReadAhead::Piece> ReadAhead::read_from_file() {
  auto piece = std::make_unique<Piece>();
  // Behind the text room for what may be looked at without a check, zeros: no character of a number.
  constexpr std::size_t k_padding = 2 * k_short_number_bytes;
  if (free_.empty()) {
    free_.push_back(
        std::make_unique_for_overwrite<char[]>(k_context + k_longest_rest + piece_bytes_ + k_padding));
  }
  piece->room = std::move(free_.back());
  free_.pop_back();
  char* const data = piece->room.get();
  std::copy(tail_.begin(), tail_.end(), data);
  const std::size_t begin = tail_context_;
  std::size_t size = tail_.size();
  std::size_t cut = 0;
  while (cut == 0 && !at_end_) {
    for (std::size_t wanted = piece_bytes_; wanted > 0 && !at_end_;) {
      const std::size_t got = reader_.read_bytes(data + size, wanted);
      at_end_ = got == 0;
      size += got, wanted -= got;
    }
    cut = at_end_ ? size - begin : place_to_cut({data + begin, size - begin});
  }
  std::memset(data + size, 0, k_padding);
  piece->block = {data, begin, begin + cut, size};
  piece->text.readable = data + size + k_padding;
  tail_context_ = std::min(k_context, begin + cut);
  tail_.assign(data + begin + cut - tail_context_, data + size);
  finish_piece(*piece, cut);
  return piece;
}

void ReadAhead::finish_piece(Piece& piece, std::size_t bytes) {
  piece.text.end = piece.block.data + piece.block.end;
  piece.offset = next_offset_;
  piece.starts_line = starts_line_;
  next_offset_ += bytes;
  starts_line_ = bytes > 0 && piece.text.end[-1] == '\n';
}

RunAhead* ReadAhead::run_at(std::uint64_t offset) {
  if (current_ == nullptr) return nullptr;
  std::vector<RunAhead>& runs = current_->runs;
  while (current_->next_run < runs.size() && runs[current_->next_run].begin < offset) ++current_->next_run;
  if (next_run() != offset) return nullptr;
  return &runs[current_->next_run++];
}

std::uint64_t ReadAhead::next_run() const {
  return current_ == nullptr || current_->next_run == current_->runs.size()
             ? std::numeric_limits<std::uint64_t>::max()
             : current_->runs[current_->next_run].begin;
}

}  // namespace farop::nff
