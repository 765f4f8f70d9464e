// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_nff/nff_parser.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>
#include <utility>

#include "core/limits.h"
#include "parse_nff/nff_hints.h"
#include "parse_nff/nff_numbers.h"
#include "parse_nff/nff_planarity.h"

namespace farop {
namespace nff {
namespace {

constexpr std::string_view k_background_needs = "3 numbers (r g b)";
constexpr std::string_view k_light_needs = "3 numbers (x y z) or 6 (x y z r g b)";
constexpr std::string_view k_fill_needs = "8 numbers (r g b Kd Ks shine T index-of-refraction)";
constexpr std::string_view k_cone_needs = "8 numbers (base x y z, base radius, apex x y z, apex radius)";
constexpr std::string_view k_sphere_needs = "4 numbers (x y z radius)";
constexpr std::string_view k_polygon_needs = "a vertex count, then the vertices";
constexpr std::string_view k_resolution_needs = "2 integers (width height)";
constexpr const char* k_extra_hint =
    "remove the extra numbers, or restore the keyword of the line that they belong to";

/// So many entities are read one by one at most before a run is tried again.
constexpr std::uint32_t k_longest_plain_pause = 63;

/// Text of a run where parts are handed over, which happens between runs.
constexpr std::size_t k_longest_run_of_part = std::size_t{1} << 18;

/// Numbers of a polygon that are read before its corners are stored.
constexpr std::size_t k_numbers_at_once = 96;

std::string count_text(std::uint64_t count) {
  return count == 0 ? "none" : fmt::format("{}", count);
}

bool outside_unit_range(double v) {
  return v < 0 || v > 1;
}

}  // namespace

Parser::Parser(WordReader& reader, DiagnosticSink& sink, const NffOptions& options, ReadAhead* ahead)
    : reader_(reader), sink_(sink), options_(options), ahead_(ahead) {
  reader_.set_second_comment_character('%');
  if (options_.progress) reader_.set_progress(options_.progress);
  object_->name = std::filesystem::path(reader_.name()).stem().string();
  summary_.file = reader_.name();
  summary_.format = "nff";
}

Scene Parser::parse() {
  advance();
  refuse_foreign_formats();
  const Keyword* entity = nullptr;  // mostly the one before
  while (!at_end_) {
    if (options_.on_part) watch_part();
    if (entity == nullptr || word_.text != entity->name) entity = find_keyword(word_.text);
    if (entity == nullptr) fail_unknown_word();
    Word keyword = word_;
    keyword.text = entity_ = entity->name;
    if (plain_run(keyword)) continue;
    const bool patch = entity->read == &Parser::patch;
    if ((patch || entity->read == &Parser::polygon) &&
        corners_at_once(keyword, patch ? k_patch_corners : k_polygon_corners)) {
      continue;
    }
    advance();
    (this->*entity->read)(keyword);
  }
  start_surface({});
  if (options_.on_part) hand_over_part();
  report_suppressed_warnings();
  summary_.bytes = reader_.bytes_read();
  summary_.surfaces = surfaces_;
  summary_.lights = scene_.lights.size();
  scene_.root.children.push_back(std::move(object_));
  scene_.inputs.push_back(std::move(summary_));
  return std::move(scene_);
}

// Takes the entities from the one at hand on that need no more than their numbers stored; false where there
// are none. The word behind them is at hand then.
bool Parser::plain_run(const Word& keyword) {
  const bool is_fill = keyword.text == "f";
  if (options_.plain || !(is_fill || keyword.text == "p" || keyword.text == "pp")) return false;
  if (!is_fill && !has_objects_ && !has_fill_) return false;  // that will be remarked upon
  if (ahead_ != nullptr && take_run_ahead()) return true;
  if (plain_pause_ > 0) {
    --plain_pause_;
    return false;
  }
  std::string_view text = reader_.text_from(word_);
  if (ahead_ != nullptr) text = text.substr(0, ahead_->next_run() - word_.offset);
  if (options_.on_part) text = text.substr(0, k_longest_run_of_part);
  const char* const end = text.data() + text.size();
  const PlainRun run = plain_runs_.read(text.data(), {end, end}, builder_, [this](const Material& material) {
    has_fill_ = true;
    start_surface(material);
  });
  if (run.behind == nullptr) {
    plain_pause_ = plain_pause_length_ = std::min(2 * plain_pause_length_ + 1, k_longest_plain_pause);
    return false;
  }
  plain_pause_length_ = 0;
  const auto place = [&](const char* at) {
    return WordReader::place_behind(word_, text.substr(0, static_cast<std::size_t>(at - text.data())));
  };
  end_run(run, run.last_keyword != nullptr ? place(run.last_keyword) : Word(), place(run.behind));
  return true;
}

bool Parser::take_run_ahead() {
  RunAhead* const run = ahead_->run_at(word_.offset);
  if (run == nullptr) return false;
  for (RunAhead::Part& part : run->parts) {
    if (part.fill) {
      has_fill_ = true;
      start_surface(*part.fill);
    }
    if (part.surface == nullptr) continue;
    const bool complete = &part != &run->parts.back();
    if (complete && builder_.empty()) {
      part.surface->material = builder_.material();
      keep_surface(std::move(part.surface));
    } else {
      builder_.append(*part.surface);
      part.surface.reset();
    }
  }
  const auto place = [&](const Word& relative) {
    return Word{{},
                word_.line + relative.line,
                relative.column + (relative.line == 0 ? word_.column : 0),
                word_.offset + relative.offset};
  };
  end_run(PlainRun(run->entities), place(run->last_keyword), place(run->behind));
  return true;
}

void Parser::end_run(const PlainRun& run, const Word& last_keyword, const Word& behind) {
  Word last = last_keyword;
  last.text = run.last_is_patch ? "pp" : "p";
  entity_ = run.ends_with_fill ? "f" : last.text;
  summary_.polygons += run.polygons, summary_.patches += run.patches;
  has_objects_ = has_objects_ || run.last_corners > 0;
  reader_.go_to(behind);
  advance();
  if (!run.ends_with_fill)
    end_corners(last, run.last_corners, run.last_is_patch ? k_patch_corners : k_polygon_corners);
}

std::span<const Parser::Keyword> Parser::format_keywords() {
  static constexpr Keyword k_keywords[] = {
      {"v", &Parser::view},
      {"b", &Parser::background},
      {"l", &Parser::light},
      {"f", &Parser::fill},
      {"c", &Parser::cone},
      {"s", &Parser::sphere},
      {"p", &Parser::polygon},
      {"pp", &Parser::patch},
      {"from", &Parser::stray_view_word},
      {"at", &Parser::stray_view_word},
      {"up", &Parser::stray_view_word},
      {"angle", &Parser::stray_view_word},
      {"hither", &Parser::stray_view_word},
      {"resolution", &Parser::stray_view_word},
      {"yon", &Parser::stray_view_word},  // Graphics Gems V
  };
  return k_keywords;
}

const Parser::Keyword* Parser::find_keyword(std::string_view text) {
  static const std::unordered_map<std::string_view, const Keyword*> k_table = [] {
    std::unordered_map<std::string_view, const Keyword*> table;
    for (const Keyword& keyword : format_keywords()) table.emplace(keyword.name, &keyword);
    for (const Keyword& keyword : dialect_keywords()) table.emplace(keyword.name, &keyword);
    return table;
  }();
  const auto found = k_table.find(text);
  return found == k_table.end() ? nullptr : found->second;
}

// ---------------------------------------------------------------------------------------------- words and
// numbers

bool Parser::take_number(double& value) {
  if (at_end_) return false;
  switch (parse_number(word_.text, value)) {
    case NumberSyntax::number:
      if (word_.text.size() >= WordReader::k_max_word) refuse_cut_word(in_entity());
      advance();
      return true;
    case NumberSyntax::too_large:
      fail(word_, fmt::format("'{}'{} is too large for a double-precision number", printable(word_.text),
                              in_entity()));
    case NumberSyntax::not_a_number:
      break;
  }
  return false;
}

std::size_t Parser::take_numbers(std::span<double> numbers, bool& word_at_hand) {
  std::size_t taken = 0;
  while (taken < numbers.size()) {
    if (!word_at_hand && !options_.plain) {
      while (taken < numbers.size() && reader_.next_decimal(numbers[taken])) ++taken;
      if (taken == numbers.size()) break;
    }
    if (!word_at_hand) advance();
    word_at_hand = true;
    if (options_.plain || at_end_ || word_.text.size() >= WordReader::k_max_word ||
        parse_number(word_.text, numbers[taken]) != NumberSyntax::number) {
      if (!take_number(numbers[taken])) break;  // or says what is wrong
    } else {
      word_at_hand = false;
    }
    ++taken;
  }
  return taken;
}

Parser::Run Parser::read_run(const Word& keyword) {
  Run run;
  run.last_line = keyword.line;
  for (;;) {
    const Word place = word_;
    double value = 0;
    if (!take_number(value)) return run;
    if (run.count < Run::k_stored) {
      run.values[run.count] = value;
      run.places[run.count] = place;
    }
    run.last_line = place.line;
    ++run.count;
  }
}

Parser::Run Parser::read_exactly(const Word& keyword, std::uint64_t count, std::string_view needs) {
  const Run run = read_run(keyword);
  if (run.count < count) fail_missing(keyword, needs, run.count);
  if (run.count > count) fail_extra(keyword, run.places[count], needs, run.count, k_extra_hint);
  return run;
}

Word Parser::read_integer(const Word& keyword, std::string_view needs, std::uint64_t found,
                          std::int64_t& value) {
  if (at_end_ || !parse_integer(word_.text, value)) {
    double number = 0;
    if (at_end_ || parse_number(word_.text, number) == NumberSyntax::not_a_number)
      fail_missing(keyword, needs, found);
    fail(word_, fmt::format("'{}'{} is not a plain integer", printable(word_.text), in_entity()),
         fmt::format("'{}' takes {}", keyword.text, needs));
  }
  if (word_.text.size() >= WordReader::k_max_word) refuse_cut_word(in_entity());
  const Word place = word_;
  advance();
  return place;
}

void Parser::skip_name(const Word& keyword, std::string_view needs) {
  if (at_end_) fail_missing(keyword, needs, 0);
  refuse_binary(in_entity());
  advance();
}

void Parser::skip_line(std::uint64_t line) {
  while (!at_end_ && word_.line == line) {
    refuse_binary(in_entity());
    advance();
  }
}

// -------------------------------------------------------------------------------------------------------
// messages

void Parser::fail(const Word& at, std::string message, std::string hint) const {
  sink_.report(reader_.diagnostic(Severity::error, at, std::move(message), std::move(hint)));
  throw ParsingFailed{};
}

void Parser::fail_missing(const Word& keyword, std::string_view needs, std::uint64_t found,
                          std::string hint) const {
  if (at_end_) {
    fail(keyword,
         fmt::format("end of file inside '{}', which takes {}, found {}", keyword.text, needs,
                     count_text(found)),
         std::move(hint));
  }
  if (find_keyword(word_.text) == nullptr) {
    refuse_impossible(in_entity());
    fail(word_, fmt::format("expected a number for '{}', found '{}'", keyword.text, printable(word_.text)),
         fmt::format("'{}' takes {}", keyword.text, needs));
  }
  fail(keyword, fmt::format("'{}' takes {}, found {}", keyword.text, needs, count_text(found)),
       std::move(hint));
}

void Parser::fail_extra(const Word& keyword, const Word& extra, std::string_view needs, std::uint64_t found,
                        std::string hint) const {
  fail(extra,
       fmt::format("found a number where a keyword is expected: '{}' takes {}, {} follow", keyword.text,
                   needs, found),
       std::move(hint));
}

void Parser::fail_unknown_word() const {
  double value = 0;
  if (parse_number(word_.text, value) != NumberSyntax::not_a_number) {
    fail(word_, fmt::format("found the number '{}' where a keyword is expected", printable(word_.text)),
         k_extra_hint);
  }
  refuse_impossible({});
  fail(word_, fmt::format("unknown keyword '{}'", printable(word_.text)),
       hint_for_unknown_keyword(word_.text,
                                [](std::string_view text) { return find_keyword(text) != nullptr; }));
}

std::string Parser::in_entity() const {
  return fmt::format(" in '{}'", entity_);
}

void Parser::refuse_binary(std::string_view where) const {
  if (word_.text.find('\0') != std::string_view::npos) {
    fail(word_, fmt::format("binary file: found a NUL byte{}, expected plain text", where));
  }
}

void Parser::refuse_cut_word(std::string_view where) const {
  if (word_.text.size() >= WordReader::k_max_word) {
    fail(word_, fmt::format("'{}'{} is longer than {} bytes", printable(word_.text), where,
                            WordReader::k_max_word - 1));
  }
}

void Parser::refuse_impossible(std::string_view where) const {
  refuse_binary(where);
  refuse_cut_word(where);
  if (word_.text.substr(0, 2) == "//")
    fail(word_, fmt::format("'//'{} starts no comment in NFF", where), "use '#'");
  if (resembles_number(word_.text)) {
    fail(word_, fmt::format("'{}'{} is not a number", printable(word_.text), where),
         "numbers are decimal with a point, such as -1.5 or 2e-3");
  }
}

void Parser::refuse_color_name(const Word& keyword) const {
  if (at_end_ || find_keyword(word_.text) != nullptr) return;
  refuse_impossible(in_entity());
  if (word_.line != keyword.line) return;
  fail(word_,
       fmt::format("colour names are not supported: '{}' in '{}'", printable(word_.text), keyword.text),
       "give red, green and blue as three numbers 0..1");
}

// Other formats that use the suffix; decided by the first word.
void Parser::refuse_foreign_formats() const {
  if (at_end_) return;
  refuse_binary({});
  const std::string_view first = word_.text;
  const auto is_letter = [&](std::size_t i, char lower) { return (first[i] | 0x20) == lower; };
  if (first.size() == 3 && is_letter(0, 'n') && is_letter(1, 'f') && is_letter(2, 'f')) {
    fail(word_, "Sense8 WorldToolkit NFF is not supported",
         "farop reads the Neutral File Format of E. Haines");
  }
  double value = 0;
  const bool is_number = parse_number(first, value) != NumberSyntax::not_a_number;
  if (is_number || first == "E(eV)" || first.front() == '{') {
    fail(word_,
         fmt::format("not a Haines NFF file: it begins with '{}', expected a keyword", printable(first, 20)),
         "farop reads the Neutral File Format of E. Haines");
  }
}

std::uint64_t Parser::warning_limit() const {
  return static_cast<std::uint64_t>(std::max(options_.warnings_per_kind, 0));
}

bool Parser::count_warning(std::string_view kind, const Word& at, std::uint64_t limit) {
  auto tally = tallies_.find(kind);
  if (tally == tallies_.end()) tally = tallies_.emplace(std::string(kind), Tally{}).first;
  if (tally->second.reported < limit) {
    ++tally->second.reported;
    return true;
  }
  ++tally->second.suppressed;
  tally->second.last = at;
  return false;
}

void Parser::warn(const Word& at, std::string message, std::string hint) {
  if (!count_warning(message, at, warning_limit())) return;
  sink_.report(reader_.diagnostic(Severity::warning, at, std::move(message), std::move(hint)));
}

void Parser::warn_once(const Word& at, std::string message) {
  if (!count_warning(message, at, std::min<std::uint64_t>(1, warning_limit()))) return;
  sink_.report(reader_.diagnostic(Severity::warning, at, std::move(message)));
}

void Parser::report_suppressed_warnings() {
  for (const auto& [kind, tally] : tallies_) {
    if (tally.suppressed == 0) continue;
    sink_.report(reader_.diagnostic(
        Severity::warning, tally.last,
        fmt::format("{} ... and {} more of this kind, the last one here", kind, tally.suppressed)));
  }
}

// --------------------------------------------------------------------------------------------------------
// entities

void Parser::view(const Word& keyword) {
  if (has_objects_) warn(keyword, "'v' after an object; it is used for the whole scene");
  if (has_view_) warn(keyword, "second 'v'; the last one counts");
  has_view_ = true;
  ViewParameters view;
  view.background = scene_.view.background;
  read_view_words(keyword, view);
  scene_.view = view;
}

void Parser::read_view_words(const Word& keyword, ViewParameters& view) {
  Word at_place, yon_place;
  for (const Keyword* entry = nullptr; !at_end_ && (entry = find_keyword(word_.text)) != nullptr;) {
    if (entry->read != &Parser::stray_view_word) break;
    Word part = word_;
    part.text = entity_ = entry->name;
    advance();
    if (part.text == "resolution") {
      ViewParameters::Size size;
      int* const sides[] = {&size.x, &size.y};
      for (const std::uint64_t i : {0u, 1u}) {
        std::int64_t value = 0;
        const Word place = read_integer(part, k_resolution_needs, i, value);
        if (value < 1 || value > k_max_resolution) {
          fail(place, fmt::format("'resolution' with a {} of {} pixels, expected 1..{}",
                                  i == 0 ? "width" : "height", value, k_max_resolution));
        }
        *sides[i] = static_cast<int>(value);
      }
      view.resolution = size;
    } else if (part.text == "angle") {
      const Run run = read_exactly(part, 1, "1 number (degrees)");
      if (!(run.values[0] > 0 && run.values[0] < 180)) {
        fail(run.places[0],
             fmt::format("'angle' is {} degrees, expected more than 0 and less than 180", run.values[0]));
      }
      view.angle = run.values[0];
    } else if (part.text == "hither") {
      const Run run = read_exactly(part, 1, "1 number (the distance of the near plane)");
      if (run.values[0] < 0) {
        fail(run.places[0], fmt::format("'hither' is {}, expected 0 or more", run.values[0]),
             "it is the distance of the near plane from the eye");
      }
      view.hither = run.values[0];
    } else if (part.text == "yon") {
      const Run run = read_exactly(part, 1, "1 number (the distance of the far plane)");
      warn(part, "'yon' is not in the NFF format; it is used as the far plane");
      view.yon = run.values[0];
      yon_place = run.places[0];
    } else {
      const V3d value = read_exactly(part, 3, "3 numbers (x y z)").vector(0);
      (part.text == "from" ? view.from : part.text == "at" ? view.at : view.up) = value;
      if (part.text == "at") at_place = part;
    }
  }
  if (!view.from || !view.at) {
    if (!at_end_ && find_keyword(word_.text) == nullptr) fail_unknown_word();  // 'frm 0 0 0', say
    fail(keyword,
         fmt::format("{}'v' has no {}", at_end_ ? "end of file: " : "",
                     !view.from && !view.at ? "'from' and no 'at'"
                     : !view.from           ? "'from'"
                                            : "'at'"),
         "a view needs both, the eye and the point in the centre of the picture: from x y z, at x y z");
  }
  if (*view.from == *view.at)
    fail(at_place, "degenerate view: 'from' and 'at' are the same point", "move one of them");
  if (view.yon && !(*view.yon > view.hither.value_or(0))) {
    fail(yon_place,
         fmt::format("'yon' is {}, expected more than 'hither' ({})", *view.yon, view.hither.value_or(0)));
  }
}

void Parser::stray_view_word(const Word& keyword) {
  fail(keyword, fmt::format("'{}' outside a 'v' block", keyword.text),
       "a 'v' block ends at the first other keyword: move the line up to the rest of the view");
}

void Parser::background(const Word& keyword) {
  const Run run = read_run(keyword);
  if (run.count == 0) refuse_color_name(keyword);
  if (run.count < 3) fail_missing(keyword, k_background_needs, run.count);
  if (run.count > 3) fail_extra(keyword, run.places[3], k_background_needs, run.count, k_extra_hint);
  scene_.view.background = run.color(0);
  for (std::size_t i = 0; i < 3; ++i) {
    if (outside_unit_range(run.values[i])) {
      warn(run.places[i], "colour of 'b' outside 0..1; it is clamped when it is drawn");
      break;
    }
  }
}

void Parser::light(const Word& keyword) {
  const Run run = read_run(keyword);
  if (run.count > 7) fail_extra(keyword, run.places[6], k_light_needs, run.count, k_extra_hint);
  Light light{run.vector(0), std::nullopt};
  if (run.count == 6) {
    light.color = run.color(3);
  } else if (run.count == 7) {  // ENFF
    light.color = run.color(4) * run.values[3];
    if (!std::isfinite(light.color->r) || !std::isfinite(light.color->g) || !std::isfinite(light.color->b)) {
      fail(run.places[3], "intensity times colour of 'l' is too large for a double-precision number");
    }
    warn(keyword, "'l' with 7 numbers is not in the NFF format; read as x y z intensity r g b");
  } else if (run.count != 3) {
    fail_missing(keyword, k_light_needs, run.count);
  }
  add_light(keyword, light);
}

void Parser::add_light(const Word& keyword, const Light& light) {
  if (has_objects_) warn(keyword, "light after an object; it is used for the whole scene");
  scene_.lights.push_back(light);
}

void Parser::fill(const Word& keyword) {
  read_fill(keyword);
}

void Parser::read_fill(const Word& keyword) {
  const Run run = read_run(keyword);
  if (run.count == 0) refuse_color_name(keyword);
  if (run.count < 3) fail_missing(keyword, k_fill_needs, run.count);
  if (run.count > 9) fail_extra(keyword, run.places[8], k_fill_needs, run.count, k_extra_hint);

  Material m;
  double* const fields[] = {&m.color.r, &m.color.g,       &m.color.b,    &m.kd, &m.ks,
                            &m.shine,   &m.transmittance, &m.refraction, &m.ka};
  for (std::size_t i = 0; i < run.count; ++i) *fields[i] = run.values[i];
  if (run.count == 9)
    warn(keyword, "'f' with 9 numbers is not in the NFF format; the last one is read as Ka");
  if (run.count < 8) {
    warn(keyword,
         fmt::format("'f' takes {}, found {}; defaults are used for the rest", k_fill_needs, run.count));
  }
  if (!at_end_ && word_.line == run.last_line &&
      find_keyword(word_.text) == nullptr) {  // a texture's file name
    refuse_impossible(in_entity());
    warn_once(word_, "text behind the numbers of 'f' is skipped to the end of the line");
    skip_line(run.last_line);
  }
  set_fill(m, run.places[5], run.places[6]);
}

void Parser::set_fill(Material material, const Word& shine_place, const Word& transmittance_place) {
  if (outside_unit_range(material.transmittance)) {
    warn(transmittance_place, "transmittance of 'f' outside 0..1; it is clamped");
  }
  if (material.shine < 0) {
    warn(shine_place, "negative shine of 'f'; 0 is used");
    material.shine = 0;
  }
  has_fill_ = true;
  start_surface(material);
}

void Parser::start_surface(const Material& material) {
  const bool keep = !builder_.empty();
  Surface finished = builder_.take(material);
  if (keep) keep_surface(std::make_shared<Surface>(std::move(finished)));
  if (surface_kept_) ++surfaces_;
  surface_kept_ = false;
}

void Parser::keep_surface(std::shared_ptr<Surface> surface) {
  surface_kept_ = true;
  if (options_.on_part) {
    part_bytes_ += surface->memory_bytes();
    part_curved_ += surface->curved.size();
  }
  object_->surfaces.push_back(std::move(surface));
}

void Parser::watch_part() {
  if (part_bytes_ + builder_.memory_bytes() < options_.part_bytes &&
      part_curved_ + builder_.curved_count() < options_.part_curved) {
    return;
  }
  if (!builder_.empty()) {
    const Material same = builder_.material();
    keep_surface(std::make_shared<Surface>(builder_.take(same)));
  }
  hand_over_part();
}

void Parser::hand_over_part() {
  if (!object_->surfaces.empty()) options_.on_part(scene_, std::exchange(object_->surfaces, {}));
  part_bytes_ = part_curved_ = 0;
}

void Parser::before_object(const Word& keyword) {
  if (!has_objects_ && !has_fill_) {
    warn(keyword, "object before the first 'f'; it is white and diffuse",
         "put an 'f' line before the objects");
  }
  has_objects_ = true;
}

void Parser::cone(const Word& keyword) {
  const Run run = read_exactly(keyword, 8, k_cone_needs);
  const double base_radius = run.values[3];
  const double apex_radius = run.values[7];
  if ((base_radius < 0 && apex_radius > 0) || (base_radius > 0 && apex_radius < 0)) {
    fail(run.places[7],
         fmt::format("radii of 'c' are {} and {}, expected the same sign", base_radius, apex_radius),
         "both negative: only the inside is visible; both positive: only the outside");
  }
  Cone cone;
  cone.base = run.vector(0);
  cone.base_radius = std::abs(base_radius);
  cone.apex = run.vector(4);
  cone.apex_radius = std::abs(apex_radius);
  cone.inside_visible = base_radius < 0 || apex_radius < 0;
  if (cone.base_radius == 0 && cone.apex_radius == 0) {
    warn(keyword, "cone without a radius is skipped");
  } else if (cone.base == cone.apex) {
    warn(keyword, "cone with its base at the apex is skipped", "cones have no end caps; use a polygon");
  } else {
    before_object(keyword);
    builder_.add(cone);
    ++summary_.cones;
  }
}

void Parser::sphere(const Word& keyword) {
  const Run run = read_run(keyword);
  if (run.count < 4) fail_missing(keyword, k_sphere_needs, run.count);
  if (run.count > 4) {
    fail_extra(
        keyword, run.places[4], k_sphere_needs, run.count,
        run.count <= 6
            ? "ellipsoids are not supported"
            : "spot and specular lights of other dialects are not supported; or remove the extra numbers");
  }
  const double radius = run.values[3];
  if (radius == 0) {
    warn(keyword, "sphere of radius 0 is skipped");
    return;
  }
  before_object(keyword);
  builder_.add(Sphere{run.vector(0), std::abs(radius), radius < 0});
  ++summary_.spheres;
}

void Parser::corners(const Word& keyword, CornerFormat format) {
  std::int64_t count = 0;
  const Word count_place = read_integer(keyword, k_polygon_needs, 0, count);
  if (count < 1)
    fail(count_place, fmt::format("'{}' announces {} vertices, expected 3 or more", keyword.text, count));
  if (count > k_max_polygon_vertices) {
    fail(count_place, fmt::format("'{}' announces {} vertices, at most {} are possible", keyword.text, count,
                                  k_max_polygon_vertices));
  }
  read_corners(keyword, format, count, true);
}

bool Parser::corners_at_once(const Word& keyword, CornerFormat format) {
  std::int64_t count = 0;
  if (options_.plain || !reader_.next_count(3, k_max_polygon_vertices, count)) return false;
  read_corners(keyword, format, count, false);
  return true;
}

void Parser::read_corners(const Word& keyword, CornerFormat format, std::int64_t count, bool word_at_hand) {
  const bool kept = count >= 3;
  if (kept) {
    before_object(keyword);
    builder_.begin_polygon(format.normal);
  } else {
    warn(keyword, "polygon of less than 3 vertices is skipped");
  }
  PlanarityCheck planarity;
  const std::uint64_t needed = static_cast<std::uint64_t>(count) * format.numbers;
  const std::size_t whole_corners = k_numbers_at_once - k_numbers_at_once % format.numbers;
  std::array<double, k_numbers_at_once> numbers;
  for (std::uint64_t done = 0; done < needed;) {
    const std::size_t wanted = std::min<std::uint64_t>(needed - done, whole_corners);
    const std::size_t found = take_numbers(std::span(numbers).first(wanted), word_at_hand);
    if (found < wanted) fail_short_polygon(keyword, count, format, done + found);
    done += found;
    if (!kept) continue;
    for (std::size_t k = 0; k < found; k += format.numbers) {
      const V3d position(numbers[k], numbers[k + 1], numbers[k + 2]);
      if (count > 3) planarity.add(position);
      if (format.normal) {
        builder_.add_corner(position, V3d(numbers[k + 3], numbers[k + 4], numbers[k + 5]));
      } else {
        builder_.add_corner(position);
      }
    }
  }
  if (!word_at_hand) advance();
  end_corners(keyword, count, format);
  if (!kept) return;
  builder_.end_polygon();
  count_polygon(format.normal);
  constexpr std::string_view k_not_planar = "polygon is not planar";
  const double deviation = count > 3 ? planarity.deviation() : 0;
  if (deviation > k_planarity_tolerance && count_warning(k_not_planar, keyword, warning_limit())) {
    sink_.report(reader_.diagnostic(
        Severity::warning, keyword,
        fmt::format("{}: a vertex is {:.2g} of its extent off the plane of the first three", k_not_planar,
                    deviation),
        "it is drawn as it is; split it into triangles to be sure of its shape"));
  }
}

// The cheap look at one character keeps the usual case, a keyword, from being parsed as a number.
void Parser::end_corners(const Word& keyword, std::int64_t count, CornerFormat format) {
  if (!at_end_ && word_.text.front() < 'A') fail_long_polygon(keyword, count, format);
}

void Parser::fail_short_polygon(const Word& keyword, std::int64_t count, CornerFormat format,
                                std::uint64_t found) const {
  const std::uint64_t vertices = static_cast<std::uint64_t>(count);
  const bool lacks_normals = format.normal && found == 3 * vertices;
  fail_missing(keyword, fmt::format("{} numbers for its {} vertices", vertices * format.numbers, vertices),
               found,
               lacks_normals ? "three numbers a vertex: is this 'p'?"
                             : "correct the vertex count, or add what is missing");
}

// The word at hand may be a number; how many follow tells what went wrong.
void Parser::fail_long_polygon(const Word& keyword, std::int64_t count, CornerFormat format) {
  const Word extra = word_;
  const std::uint64_t needed = static_cast<std::uint64_t>(count) * format.numbers;
  const std::string needs = fmt::format("{} numbers for its {} vertices", needed, count);
  double value = 0;
  if (parse_number(word_.text, value) == NumberSyntax::not_a_number) fail_unknown_word();
  // Made now, while the line is still in the reader's buffer.
  Diagnostic error = reader_.diagnostic(Severity::error, extra, {});
  std::uint64_t found = needed;
  while (take_number(value)) ++found;
  error.message = fmt::format("found a number where a keyword is expected: '{}' takes {}, {} follow",
                              keyword.text, needs, found);
  error.hint = !format.normal && found == 2 * needed ? "six numbers a vertex: is this 'pp'?"
               : found % format.numbers == 0
                   ? fmt::format("is the vertex count {}, or has another polygon lost its keyword?",
                                 found / format.numbers)
                   : k_extra_hint;
  sink_.report(std::move(error));
  throw ParsingFailed{};
}

}  // namespace nff

std::optional<Scene> parse_nff(WordReader& reader, DiagnosticSink& sink, const NffOptions& options) {
  try {
    const int available = tbb::info::default_concurrency();
    const int threads = options.threads > 0 ? options.threads : available;
    constexpr std::size_t k_short_file = std::size_t{1} << 22;
    const std::size_t least = options.threads > 0 ? options.piece_bytes : k_short_file;
    if (threads < 2 || options.plain || !nff::ReadAhead::worthwhile(reader, least))
      return nff::Parser(reader, sink, options).parse();
    // More threads than the machine has processors only when asked for.
    const tbb::global_control allow_more(tbb::global_control::max_allowed_parallelism,
                                         static_cast<std::size_t>(std::max(threads, available)));
    tbb::task_arena arena(threads);
    std::optional<Scene> scene;
    arena.execute([&] {
      nff::ReadAhead ahead(reader, threads, options.piece_bytes);
      scene = nff::Parser(reader, sink, options, &ahead).parse();
    });
    return scene;
  } catch (const nff::ParsingFailed&) {
    return std::nullopt;
  }
}

}  // namespace farop
