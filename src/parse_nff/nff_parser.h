// SPDX-License-Identifier: GPL-3.0-or-later
// The parser's state, shared by the entities of the format (nff_parser.cpp) and its dialects
// (nff_dialects.cpp).
//
// Line ends mean nothing in NFF: an entity is a keyword and the run of numbers behind it, which ends at the
// first word that is no number. So there is one word of look-ahead, `word_`, and every entity function leaves
// the first word behind its entity there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/word_reader.h"
#include "parse_nff/nff_plain_run.h"
#include "parse_nff/nff_read_ahead.h"
#include "parse_nff/parse_nff.h"
#include "scene/scene.h"
#include "scene/surface_builder.h"

namespace farop::nff {

/// Thrown by Parser::fail() after the error was reported; never leaves parse_nff().
struct ParsingFailed {};

class Parser {
 public:
  /// ahead   what reads ahead for this parser (it feeds the reader), or nullptr
  Parser(WordReader& reader, DiagnosticSink& sink, const NffOptions& options, ReadAhead* ahead = nullptr);

  Scene parse();

 private:
  /// The numbers behind a keyword. Counted to the end, but only the first k_stored are kept, with their
  /// places: those of the longest entity (`ttp`, 24) and one that is too many.
  struct Run {
    static constexpr std::size_t k_stored = 25;

    std::uint64_t count = 0;
    std::uint64_t last_line = 0;  ///< line of the last number, or of the keyword
    std::array<double, k_stored> values;
    std::array<Word, k_stored> places;  ///< `text` is gone

    V3d vector(std::size_t i) const { return {values[i], values[i + 1], values[i + 2]}; }
    Rgb color(std::size_t i) const { return {values[i], values[i + 1], values[i + 2]}; }
  };

  /// What a corner is made of: x y z, with `normal` nx ny nz, then numbers that nobody needs (u v).
  struct CornerFormat {
    bool normal = false;
    std::size_t numbers = 3;
  };
  static constexpr CornerFormat k_polygon_corners{false, 3};
  static constexpr CornerFormat k_patch_corners{true, 6};

  /// Entity functions get their keyword with its place; its text lives as long as the program.
  using EntityFunction = void (Parser::*)(const Word& keyword);
  struct Keyword {
    std::string_view name;
    EntityFunction read;
  };
  static std::span<const Keyword> format_keywords();
  static const std::vector<Keyword>& dialect_keywords();
  static const Keyword* find_keyword(std::string_view text);

  bool plain_run(const Word& keyword);
  bool take_run_ahead();
  void end_run(const PlainRun& run, const Word& last_keyword, const Word& behind);

  // Words and numbers.
  void advance() { at_end_ = !reader_.next(word_); }
  bool take_number(double& value);
  /// Takes numbers until `numbers` is full or something else comes; how many. Faster than take_number() one
  /// by one, with the same outcome. `word_at_hand`: whether word_ is the next word; else the reader is before
  /// it.
  std::size_t take_numbers(std::span<double> numbers, bool& word_at_hand);
  Run read_run(const Word& keyword);
  /// A run of exactly `count` numbers; `needs` says so in words for the message.
  Run read_exactly(const Word& keyword, std::uint64_t count, std::string_view needs);
  /// One plain integer, the number `found` of what the keyword needs. Returns its place.
  Word read_integer(const Word& keyword, std::string_view needs, std::uint64_t found, std::int64_t& value);
  void skip_name(const Word& keyword, std::string_view needs);
  void skip_line(std::uint64_t line);

  // Errors: report one and throw. The offending word, or the keyword where a word is missing, is the place.
  [[noreturn]] void fail(const Word& at, std::string message, std::string hint = {}) const;
  [[noreturn]] void fail_missing(const Word& keyword, std::string_view needs, std::uint64_t found,
                                 std::string hint = {}) const;
  [[noreturn]] void fail_extra(const Word& keyword, const Word& extra, std::string_view needs,
                               std::uint64_t found, std::string hint) const;
  [[noreturn]] void fail_unknown_word() const;
  /// Fails where the word at hand is one that no dialect can mean anything by: binary data, misspelt numbers,
  /// foreign comments. `where` is empty or the message's " in '...'".
  void refuse_impossible(std::string_view where) const;
  void refuse_binary(std::string_view where) const;
  void refuse_cut_word(std::string_view where) const;
  void refuse_color_name(const Word& keyword) const;
  std::string in_entity() const;
  void refuse_foreign_formats() const;

  // Warnings, at most a few per kind.
  void warn(const Word& at, std::string message, std::string hint = {});
  void warn_once(const Word& at, std::string message);
  /// Counts a warning of this kind; whether it may be reported.
  bool count_warning(std::string_view kind, const Word& at, std::uint64_t limit);
  std::uint64_t warning_limit() const;
  void report_suppressed_warnings();

  // Entities of the format.
  void view(const Word& keyword);
  void stray_view_word(const Word& keyword);
  void background(const Word& keyword);
  void light(const Word& keyword);
  void fill(const Word& keyword);
  void cone(const Word& keyword);
  void sphere(const Word& keyword);
  void polygon(const Word& keyword) { corners(keyword, k_polygon_corners); }
  void patch(const Word& keyword) { corners(keyword, k_patch_corners); }
  /// The word at hand is the vertex count.
  void corners(const Word& keyword, CornerFormat format);
  /// The reader is behind the keyword. False where the count is not one of a polygon: then nothing was read.
  bool corners_at_once(const Word& keyword, CornerFormat format);
  void read_corners(const Word& keyword, CornerFormat format, std::int64_t count, bool word_at_hand);
  /// Fails where a number stands behind the last corner.
  void end_corners(const Word& keyword, std::int64_t count, CornerFormat format);
  [[noreturn]] void fail_short_polygon(const Word& keyword, std::int64_t count, CornerFormat format,
                                       std::uint64_t found) const;
  [[noreturn]] void fail_long_polygon(const Word& keyword, std::int64_t count, CornerFormat format);

  // Dialects.
  void bart_fill(const Word& keyword);
  void alias_fill(const Word& keyword);
  void color_fill(const Word& keyword);
  void named_light(const Word& keyword);
  void textured_patch(const Word& keyword);
  void textured_triangle(const Word& keyword);
  void animated_triangle(const Word& keyword);
  void skip_three_numbers(const Word& keyword);
  void skip_one_number(const Word& keyword);
  void skip_key_frames(const Word& keyword);
  void skip_rest_of_line(const Word& keyword);
  void skip_hierarchy_word(const Word& keyword);
  void unsupported(const Word& keyword);

  // What entities leave in the scene.
  void read_fill(const Word& keyword);
  void read_view_words(const Word& keyword, ViewParameters& view);
  void set_fill(Material material, const Word& shine_place, const Word& transmittance_place);
  void add_light(const Word& keyword, const Light& light);
  void start_surface(const Material& material);
  void keep_surface(std::shared_ptr<Surface> surface);
  /// Hands over what there is once it is enough for a part.
  void watch_part();
  void hand_over_part();
  void before_object(const Word& keyword);
  void add_triangle(const Word& keyword, const double* numbers, CornerFormat format);
  void count_polygon(bool with_normals) { ++(with_normals ? summary_.patches : summary_.polygons); }

  struct Tally {
    std::uint64_t reported = 0;
    std::uint64_t suppressed = 0;
    Word last;
  };

  WordReader& reader_;
  DiagnosticSink& sink_;
  const NffOptions& options_;
  Word word_;
  bool at_end_ = false;
  std::string_view entity_;  ///< keyword of the entity, or of the part of a view, that is being read
  std::map<std::string, Tally, std::less<>> tallies_;

  Scene scene_;
  std::shared_ptr<Object> object_ = std::make_shared<Object>();
  InputSummary summary_;
  SurfaceBuilder builder_;
  ReadAhead* ahead_;
  PlainRunReader plain_runs_;
  std::uint32_t plain_pause_ = 0;  ///< entities to read before a run is tried again
  std::uint32_t plain_pause_length_ = 0;
  std::uint64_t surfaces_ = 0;  ///< that are complete
  bool surface_kept_ = false;   ///< a part of the surface being built is in the object, or was handed over
  std::size_t part_bytes_ = 0;  ///< of the surfaces in the object, with on_part
  std::size_t part_curved_ = 0;
  bool has_view_ = false;
  bool has_fill_ = false;
  bool has_objects_ = false;
};

}  // namespace farop::nff
