// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/flat_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/limits.h"
#include "export/flat_format.h"

namespace farop {
namespace {

/// Vertices of a batch before it is handed on: 100 KB, which stays in the second-level cache.
constexpr std::size_t k_batch_vertices = 4096;

/// Twice the area of a polygon of 2^30 vertices on a grid of 2^23 x 2^23 takes 77 bits when it winds around
/// itself.
__extension__ using WideInteger = __int128;

/// Ends the reading after its one error has been reported; never leaves this file.
struct Rejected {};

/// A kind of line: what it is for, the names of its integers ("" where there is but one), and what to say
/// about values out of range.
struct LineKind {
  const char* purpose;
  const char* layout;
  int integers;
  const char* range_hint;
};
constexpr LineKind k_resolution_line{"the resolution", "XRES YRES ZRES CRES", 4,
                                     "a flat file starts with the four integers XRES YRES ZRES CRES"};
constexpr LineKind k_count_line{"the number of polygons", "", 1,
                                "the number of polygons stands alone on the second line"};
constexpr LineKind k_separator_line{"the separator 1", "", 1, ""};
constexpr LineKind k_polygon_line{
    "polygon", "number of vertices, ymax, ymin", 3,
    "at least 3 vertices; y in 0..YRES-1, times 2 for each sub-pixel bit (fifth number of the first line)"};
constexpr LineKind k_vertex_line{
    "vertex", "x y z R G B", 6,
    "the first line gives the ranges; those of x and y double with each sub-pixel bit (fifth number)"};
constexpr LineKind k_end_line{"the end mark 127", "", 1, ""};

/// An earlier line that says how many lines of a kind there are: what a wrong number of lines is measured by.
struct Announcement {
  std::uint64_t line = 0;  ///< 0: none
  std::int64_t count = 0;
  const char* what = "";
};

constexpr const char* k_integer_hint = "plain decimal integers only; text may follow a '#'";
constexpr const char* k_line_hint = "each line of a flat file holds exactly its integers";

/// Digits, or a minus sign and the digits of a number that is not 0: out of every range, but an integer.
bool is_integer(std::string_view text) {
  const bool negative =
      text.size() > 1 && text[0] == '-' && text.find_first_not_of("-0") != std::string_view::npos;
  if (negative) text.remove_prefix(1);
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The integers of a flat file line by line, one word ahead. Every failure is reported and ends in Rejected.
class LineReader {
 public:
  LineReader(WordReader& words, DiagnosticSink& diagnostics, bool plain)
      : words_(words), diagnostics_(diagnostics), plain_(plain) {}

  /// The short way to the next line where that is plain integers: their values and places. The line is read
  /// only by take(); otherwise begin_line() starts it.
  bool peek(std::span<std::int64_t> values, WordReader::IntegerLine& line) const {
    return !plain_ && !at_hand_ && words_.peek_integers(values, line);
  }
  void take(const WordReader::IntegerLine& line) {
    words_.take(line);
    last_.line = line.line;
  }

  /// Starts the next line, `number` of announced.count where there are several of its kind.
  void begin_line(const LineKind& kind, const Announcement& announced = {}, std::int64_t number = 0) {
    look();
    if (last_.line > 0) expect_line_ended();
    line_ = kind, announced_ = announced, number_ = number;
    integers_read_ = 0;
    if (at_end_) reject_end_of_file();
  }

  /// The next integer of the line, low <= value <= high.
  std::int64_t integer(const char* name, std::int64_t low, std::int64_t high) {
    look();
    if (integers_read_ > 0 && !more_on_line()) reject_short_line();
    const char* const text = word_.text.data();
    const char* const text_end = text + word_.text.size();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text, text_end, value);
    const bool plain = end == text_end && error == std::errc() && *text != '-';
    if (!plain || value < low || value > high) reject_value(name, low, high);
    ++integers_read_;
    // Without the text, which next() overwrites.
    last_.line = word_.line, last_.column = word_.column, last_.offset = word_.offset;
    at_hand_ = false;
    return value;
  }

  bool more_on_line() {
    look();
    return !at_end_ && word_.line == last_.line;
  }

  /// Where the integer stood that integer() returned last; its text is gone.
  const Word& last() const { return last_; }

  /// After the last line: nothing but comments may follow.
  void expect_end() {
    expect_line_ended();
    if (at_end_) return;
    reject(word_,
           fmt::format("found '{}' behind the end mark, expected the end of the file", printable(word_.text)),
           "only '#' comments may follow the end mark");
  }

  [[noreturn]] void reject(const Word& word, std::string message, std::string hint) {
    diagnostics_.report(words_.diagnostic(Severity::error, word, std::move(message), std::move(hint)));
    throw Rejected();
  }

  /// "the number of polygons in line 2 is 3", or nothing.
  std::string announcement() const {
    if (announced_.line == 0) return {};
    return fmt::format("the number of {} in line {} is {}", announced_.what, announced_.line,
                       announced_.count);
  }

  std::string expected_line() const {
    std::string text = line_.purpose;
    if (number_ > 0) text += fmt::format(" {} of {}", number_, announced_.count);
    if (*line_.layout != '\0') text += fmt::format(" ({})", line_.layout);
    return text;
  }

 private:
  /// Makes the next word the one at hand, if it is not yet.
  void look() {
    if (at_hand_) return;
    at_end_ = !words_.next(word_);
    at_hand_ = true;
  }

  void expect_line_ended() {
    if (!more_on_line()) return;
    reject(
        word_,
        fmt::format("found '{}', expected the line to end behind {}", printable(word_.text), expected_line()),
        k_line_hint);
  }

  [[noreturn]] void reject_end_of_file() {
    Diagnostic d;
    d.where = words_.here();
    d.message = fmt::format("the file ends, expected {}", expected_line());
    d.hint = announced_.line > 0 ? announcement() : line_.range_hint;
    diagnostics_.report(std::move(d));
    throw Rejected();
  }

  [[noreturn]] void reject_short_line() {
    reject(last_,
           fmt::format("the line ends after {} of {} integers, expected {}", integers_read_, line_.integers,
                       expected_line()),
           integers_read_ == 1 && announced_.line > 0 ? announcement() : k_line_hint);
  }

  [[noreturn]] void reject_value(const char* name, std::int64_t low, std::int64_t high) {
    const std::string range = low == high ? std::to_string(low) : fmt::format("an integer {}..{}", low, high);
    const bool integral = is_integer(word_.text);
    const char* quote = integral ? "" : "'";
    // A wrong separator or end mark mostly means one line too many or too few before it.
    const std::string hint = low == high ? announcement() : integral ? line_.range_hint : k_integer_hint;
    reject(word_,
           fmt::format("found {0}{1}{0}, expected {2}: {3}", quote, printable(word_.text), name, range),
           last_.line == 0 ? line_.range_hint : hint);
  }

  WordReader& words_;
  DiagnosticSink& diagnostics_;
  bool plain_;
  Word word_, last_;
  bool at_hand_ = false;  ///< word_ is the next word; else the reader stands behind the last one
  bool at_end_ = false;
  LineKind line_ = k_resolution_line;
  Announcement announced_;
  std::int64_t number_ = 0;
  int integers_read_ = 0;
};

class FlatParser {
 public:
  FlatParser(WordReader& words, DiagnosticSink& diagnostics, ScreenPolygonSink& sink,
             const FlatReadOptions& options)
      : lines_(words, diagnostics, options.plain),
        sink_(sink),
        options_(options),
        turn_(options.y_down && !options.keep_rows) {}

  void read() {
    const ScreenFrame frame = read_resolution();
    lines_.begin_line(k_count_line);
    const std::int64_t count = lines_.integer("the number of polygons", 0, k_max_flat_polygons);
    const Announcement polygons{lines_.last().line, count, "polygons"};
    read_separator(polygons);
    sink_.begin_frame(frame);
    for (std::int64_t i = 1; i <= count; ++i) {
      read_polygon(polygons, i);
      if (batch_.vertices.size() >= k_batch_vertices) hand_over();
    }
    lines_.begin_line(k_end_line, polygons);
    lines_.integer("the end mark", k_flat_end_mark, k_flat_end_mark);
    lines_.expect_end();
    hand_over();
    sink_.end_frame();
  }

 private:
  ScreenFrame read_resolution() {
    ScreenFrame frame;
    Resolution& r = frame.resolution;
    lines_.begin_line(k_resolution_line);
    r.x = static_cast<int>(lines_.integer("XRES", 1, k_max_resolution));
    r.y = static_cast<int>(lines_.integer("YRES", 1, k_max_resolution));
    r.z = lines_.integer("ZRES", k_min_depth_resolution, k_max_depth_resolution);
    r.color = static_cast<int>(lines_.integer("CRES", k_min_color_resolution, k_max_color_resolution));
    if (lines_.more_on_line()) {
      frame.subpixel_bits =
          static_cast<int>(lines_.integer("the number of sub-pixel bits", 1, k_max_subpixel_bits));
    }
    frame.y_down = options_.y_down && !turn_;
    frame.max_vertices = options_.max_vertices;
    x_max_ = std::int64_t{r.x - 1} << frame.subpixel_bits;
    y_max_ = std::int64_t{r.y - 1} << frame.subpixel_bits;
    z_max_ = r.z - 1;
    color_max_ = r.color - 1;
    return frame;
  }

  void read_separator(const Announcement& announced) {
    std::array<std::int64_t, 1> value;
    if (lines_.peek(value, peeked_) && value[0] == k_flat_separator) return lines_.take(peeked_);
    lines_.begin_line(k_separator_line, announced);
    lines_.integer("the separator", k_flat_separator, k_flat_separator);
  }

  /// The first line of a polygon, with the places of what may turn out to be wrong.
  struct PolygonHead {
    std::int64_t vertices = 0, y_highest = 0, y_lowest = 0;
    Word y_highest_place, y_lowest_place;
    std::uint64_t line = 0;
  };

  PolygonHead read_head(const Announcement& polygons, std::int64_t number) {
    std::array<std::int64_t, 3> values;
    if (lines_.peek(values, peeked_)) {
      const auto [n, y_highest, y_lowest] = values;
      if (n >= 3 && n <= k_max_polygon_vertices && y_highest <= y_max_ && y_lowest <= y_max_) {
        lines_.take(peeked_);
        return {n, y_highest, y_lowest, peeked_.place(1), peeked_.place(2), peeked_.line};
      }
    }
    lines_.begin_line(k_polygon_line, polygons, number);
    const std::int64_t n = lines_.integer("the number of vertices", 3, k_max_polygon_vertices);
    if (n == k_flat_end_mark && !lines_.more_on_line()) {
      lines_.reject(lines_.last(), fmt::format("found the end mark, expected {}", lines_.expected_line()),
                    lines_.announcement());
    }
    PolygonHead head;
    head.vertices = n;
    head.line = lines_.last().line;
    head.y_highest = lines_.integer("ymax", 0, y_max_);
    head.y_highest_place = lines_.last();
    head.y_lowest = lines_.integer("ymin", 0, y_max_);
    head.y_lowest_place = lines_.last();
    return head;
  }

  void read_polygon(const Announcement& polygons, std::int64_t number) {
    const PolygonHead head = read_head(polygons, number);
    const std::int64_t n = head.vertices;
    const Announcement vertices{head.line, n, "vertices"};
    const std::size_t first = batch_.vertices.size();
    for (std::int64_t i = 1; i <= n; ++i) batch_.vertices.push_back(read_vertex(vertices, i));
    read_separator(vertices);
    const std::span<const ScreenVertex> corners = std::span(batch_.vertices).subspan(first);
    expect_extent(corners, head);
    // Clockwise on the screen; numbers that count down turn the sign.
    const WideInteger area = twice_signed_area(corners);
    const bool back_facing = options_.y_down && !turn_ ? area > 0 : area < 0;
    batch_.polygons.push_back(
        {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(n), nullptr, back_facing, 0, 0});
  }

  ScreenVertex read_vertex(const Announcement& vertices, std::int64_t number) {
    std::array<std::int64_t, 6> values;
    if (lines_.peek(values, peeked_)) {
      const auto [x, y, z, r, g, b] = values;
      const std::int64_t color_top = color_max_ + 1;
      if (x <= x_max_ && y <= y_max_ && z <= z_max_ && r <= color_top && g <= color_top && b <= color_top) {
        lines_.take(peeked_);
        const auto color = [&](std::int64_t c) {
          return static_cast<std::uint16_t>(std::min(c, color_max_));
        };
        return {static_cast<std::int32_t>(x),
                static_cast<std::int32_t>(turned(y)),
                static_cast<std::int32_t>(z),
                color(r),
                color(g),
                color(b)};
      }
    }
    lines_.begin_line(k_vertex_line, vertices, number);
    ScreenVertex v;
    v.x = static_cast<std::int32_t>(lines_.integer("x", 0, x_max_));
    v.y = static_cast<std::int32_t>(turned(lines_.integer("y", 0, y_max_)));
    v.z = static_cast<std::int32_t>(lines_.integer("z", 0, z_max_));
    v.r = read_color("R");
    v.g = read_color("G");
    v.b = read_color("B");
    return v;
  }

  std::uint16_t read_color(const char* name) {
    return static_cast<std::uint16_t>(std::min(lines_.integer(name, 0, color_max_ + 1), color_max_));
  }

  /// Between the file's y and the one handed on, either way.
  std::int64_t turned(std::int64_t y) const { return turn_ ? y_max_ - y : y; }

  void expect_extent(std::span<const ScreenVertex> corners, const PolygonHead& head) {
    const auto by_y = [this](const ScreenVertex& a, const ScreenVertex& b) {
      return turned(a.y) < turned(b.y);
    };
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), by_y);
    expect_bound("ymax", "largest", head.y_highest, turned(high->y), corners.size(), head.y_highest_place);
    expect_bound("ymin", "smallest", head.y_lowest, turned(low->y), corners.size(), head.y_lowest_place);
  }

  void expect_bound(const char* name, const char* which, std::int64_t found, std::int64_t expected,
                    std::size_t n, const Word& word) {
    if (found == expected) return;
    lines_.reject(
        word,
        fmt::format("found {} {}, expected {}: the {} y of the {} vertices", name, found, expected, which, n),
        "ymax stands before ymin; both come from the polygon's own vertices");
  }

  /// Positive where the corners run counter-clockwise, y up. Exact.
  static WideInteger twice_signed_area(std::span<const ScreenVertex> corners) {
    WideInteger sum = 0;
    const ScreenVertex& o = corners[0];
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const ScreenVertex &a = corners[i - 1], &b = corners[i];
      sum += std::int64_t{a.x - o.x} * (b.y - o.y) - std::int64_t{b.x - o.x} * (a.y - o.y);
    }
    return sum;
  }

  void hand_over() {
    if (!batch_.polygons.empty()) sink_.polygons(batch_);
    batch_.clear();
  }

  LineReader lines_;
  ScreenPolygonSink& sink_;
  const FlatReadOptions& options_;
  WordReader::IntegerLine peeked_;
  bool turn_;  ///< rows are turned y up
  std::int64_t x_max_ = 0, y_max_ = 0, z_max_ = 0, color_max_ = 0;
  ScreenPolygonBatch batch_;
};

}  // namespace

bool read_flat(WordReader& reader, DiagnosticSink& diagnostics, ScreenPolygonSink& polygons,
               const FlatReadOptions& options) {
  if (options.progress) reader.set_progress(options.progress);
  try {
    FlatParser(reader, diagnostics, polygons, options).read();
    return true;
  } catch (const Rejected&) {
    return false;
  }
}

}  // namespace farop
