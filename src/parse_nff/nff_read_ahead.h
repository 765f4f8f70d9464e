// SPDX-License-Identifier: GPL-3.0-or-later
// Several threads on one file: it is split at line starts, and while the parser goes through one piece, the
// next ones are searched for runs (nff_plain_run.h). Nothing depends on a guess: the parser goes through the
// words in order as always, and takes a run where it stands exactly at its first word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "core/text_feed.h"
#include "core/word_reader.h"
#include "parse_nff/nff_plain_run.h"

namespace farop::nff {

/// A run with all that it leaves in the scene. Places are relative to its first word, which is the first of
/// its line: lines, columns and offsets count from 0; columns from 1 where that is another line.
struct RunAhead {
  /// What follows a fill, or the start of the run: a surface, or a part of one.
  struct Part {
    std::optional<Material> fill;
    std::shared_ptr<Surface> surface;  ///< nullptr: none
  };

  std::uint64_t begin = 0;  ///< of its first word in the text
  Word behind;
  Word last_keyword;
  PlainRun entities;  ///< its pointers are not to be used
  std::vector<Part> parts;
};

/// The pieces of a text and what was found in them. Memory: as many pieces as there are threads and three
/// more, each with its text, 66 KiB around it, and the polygons in it (one to two times the text in usual
/// files, seven times at most): 5 MB on two threads, 20 at most. To be made and used inside a TBB arena,
/// whose threads help.
class ReadAhead : public TextFeed {
 public:
  static constexpr std::size_t k_usual_piece = std::size_t{1} << 18;

  /// reader   at the start of a text in memory or a regular file; its feed until this goes
  /// threads  >= 2, how many pieces are worked on at once
  /// piece    bytes of text that are looked at as a unit
  ReadAhead(WordReader& reader, int threads, std::size_t piece = k_usual_piece);
  ~ReadAhead() override;
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// Whether there is something to gain: a text that is there as a whole and longer than two pieces.
  static bool worthwhile(const WordReader& reader, std::size_t piece);

  bool next(Block& block) override;
  /// The run that begins at this byte of the text, or nullptr. Only of the block handed over last, and
  /// forward only.
  RunAhead* run_at(std::uint64_t offset);
  /// Where the next run begins behind the one asked for last; the largest number where there is none.
  std::uint64_t next_run() const;

 private:
  struct Piece;
  struct Searchers;

  void start_pieces();
  std::unique_ptr<Piece> cut_from_memory();
  std::unique_ptr<Piece> read_from_file();
  void finish_piece(Piece& piece, std::size_t bytes);

  WordReader& reader_;
  std::optional<std::string_view> memory_;  ///< the text, where it is in memory
  std::size_t taken_ = 0;                   ///< bytes of memory_ in pieces
  std::size_t piece_bytes_;
  std::size_t pieces_at_once_;
  std::unique_ptr<Searchers> searchers_;
  std::deque<std::unique_ptr<Piece>> waiting_;  ///< in order; searched, or being searched
  std::unique_ptr<Piece> current_;
  std::vector<std::unique_ptr<char[]>> free_;  ///< room of pieces that are done
  std::vector<char> tail_;  ///< of the last piece of a file: some context, and what was read behind its end
  std::size_t tail_context_ = 0;
  std::uint64_t next_offset_;  ///< of the next piece in the text
  bool starts_line_ = true;
  bool at_end_ = false;
};

}  // namespace farop::nff
