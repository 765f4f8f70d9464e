// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <unordered_map>
#include <utility>

#include "conformance/evidence.h"
#include "conformance/problem.h"
#include "conformance/shapes.h"
#include "conformance/shrink.h"
#include "conformance/transform.h"

namespace farop::conformance {
namespace {

constexpr int k_tile = 8, k_tiles = 32, k_sheet = k_tile * k_tiles, k_tile_origin = 2;
constexpr std::uint64_t k_max_probes = 4000;

/// What is drawn in one go: a case, or the tiles of a sheet.
struct Unit {
  std::vector<std::size_t> cases;
  bool sheet = false;
};

/// What a unit brought to light.
struct Outcome {
  std::vector<Problem> problems;
  std::vector<Evidence> evidence;
  DepthStatistics depths;
  ColorStatistics colors;
  std::vector<CaseResult> rows;
  double worst_color = 0;
};

bool same_picture(const Framebuffer& a, const Framebuffer& b) {
  return a.width == b.width && a.height == b.height && a.rgb == b.rgb;
}

class Checker {
 public:
  Checker(const std::vector<Case>& corpus, const SubjectMaker& maker, const CheckOptions& options)
      : corpus_(corpus), maker_(maker), options_(options), rows_(corpus.size()) {}

  CheckResult run() {
    for (std::size_t i = 0; i < corpus_.size(); ++i) {
      rows_[i].id = corpus_[i].id(), rows_[i].purpose = corpus_[i].purpose;
      rows_[i].status = CaseStatus::skipped, rows_[i].reason = "not reached";
    }
    const bool go_on = run_smoke();
    if (go_on) {
      run_family("cov");
      go_on_ = name_coverage_cause();
      for (const char* family : {"tile", "depth", "colour", "meta", "abi", "scene", "x"}) {
        if (go_on_) run_family(family);
      }
      if (go_on_ && options_.repeat) run_family("det");
    }
    name_values();
    finish();
    return std::move(result_);
  }

 private:
  // ---- drawing ------------------------------------------------------------------------------------------

  Delivered draw(Subject& subject, const Drawing& given) {
    ++renders_;
    Delivered d = subject.draw(given);
    if (d.picture && (d.picture->width != given.frame.x || d.picture->height != given.frame.y)) {
      d.failure =
          SubjectFailure{"abi.size",
                         fmt::format("the picture has {} x {} pixels", d.picture->width, d.picture->height),
                         fmt::format("{} x {} were asked for", given.frame.x, given.frame.y),
                         {},
                         {},
                         false};
      d.picture.reset();
    }
    if (d.picture) *d.picture = transform_.undo(*d.picture, maker_.background());
    return d;
  }

  static Problem problem_of(const Case& c, const SubjectFailure& f, const Drawing& drawing) {
    Problem p;
    p.case_id = c.id(), p.verdict = f.verdict, p.message = f.message, p.hint = f.hint;
    p.severity = f.warning ? Severity::warning : Severity::error;
    p.trace = f.trace, p.polygon = f.polygon, p.drawing = drawing;
    return p;
  }

  /// The picture, or nothing after noting the failure. Remarks become problems too.
  std::optional<Framebuffer> picture_of(const Case& c, Subject& subject, const Drawing& given, Outcome& out) {
    Delivered d = draw(subject, given);
    for (const SubjectFailure& r : d.remarks) out.problems.push_back(problem_of(c, r, given));
    if (d.failure) {
      out.problems.push_back(problem_of(c, *d.failure, given));
      return std::nullopt;
    }
    return std::move(d.picture);
  }

  JudgeOptions judge_options(const Case& c) const {
    return {maker_.background(), skip_boundary_, c.free_interpolation, options_.precision};
  }

  // ---- families -----------------------------------------------------------------------------------------

  std::vector<Unit> units_of(const std::string& family) const {
    std::vector<Unit> units;
    for (std::size_t i = 0; i < corpus_.size(); ++i) {
      if (corpus_[i].family != family) continue;
      const bool joins = corpus_[i].tile && !units.empty() && units.back().sheet &&
                         units.back().cases.size() < std::size_t{k_tiles} * k_tiles;
      if (!joins) units.push_back({{}, corpus_[i].tile});
      units.back().cases.push_back(i);
    }
    return units;
  }

  void run_family(const std::string& family) {
    const std::vector<Unit> units = units_of(family);
    std::vector<Outcome> outcomes(units.size());
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex mutex;
    const auto work = [&] {
      try {
        std::unique_ptr<Subject> subject;
        for (std::size_t i = next++; i < units.size() && !stop_; i = next++) {
          if (!subject) subject = maker_.make(0);
          const auto begun = std::chrono::steady_clock::now();
          outcomes[i] = run_unit(units[i], *subject);
          const double ms =
              std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
          for (CaseResult& row : outcomes[i].rows)
            row.milliseconds = ms / static_cast<double>(units[i].cases.size());
          const std::lock_guard lock(mutex);
          done_ += units[i].cases.size();
          if (options_.progress) options_.progress(done_, corpus_.size());
          if (options_.interrupted && options_.interrupted()) stop_ = true;
          for (const Problem& p : outcomes[i].problems) {
            if (is_failure(p) && ++crashes_[p.verdict] > 8) stop_ = true;  // it will not get better
          }
        }
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop_ = true;
      }
    };
    const int workers = maker_.parallel() ? std::max(1, options_.workers) : 1;
    std::vector<std::thread> threads;
    for (int t = 1; t < workers; ++t) threads.emplace_back(work);
    work();
    for (std::thread& t : threads) t.join();
    if (failure) std::rethrow_exception(failure);
    for (std::size_t i = 0; i < units.size(); ++i) {
      for (std::size_t k = 0; k < outcomes[i].rows.size(); ++k)
        rows_[units[i].cases[k]] = std::move(outcomes[i].rows[k]);
      take(std::move(outcomes[i]));
    }
  }

  static bool is_failure(const Problem& p) {
    return p.severity == Severity::error && p.got.rgb.empty() && p.wrong.empty() && p.count == 0;
  }

  void take(Outcome outcome) {
    depths_.add(outcome.depths), colors_.add(outcome.colors);
    result_.summary.precision.worst_color =
        std::max(result_.summary.precision.worst_color, outcome.worst_color);
    for (Problem& p : outcome.problems) problems_.push_back(std::move(p));
    for (Evidence& e : outcome.evidence) evidence_.push_back(std::move(e));
  }

  CaseResult row_of(std::size_t i) const {
    CaseResult row;
    row.id = corpus_[i].id(), row.purpose = corpus_[i].purpose;
    return row;
  }

  Outcome run_unit(const Unit& unit, Subject& subject) {
    Outcome out;
    if (unit.sheet) {
      run_sheet(unit, subject, out);
      return out;
    }
    const Case& c = corpus_[unit.cases.front()];
    CaseResult row = row_of(unit.cases.front());
    if (c.name == "cres" && maker_.eight_bit_colors()) {
      row.status = CaseStatus::skipped, row.reason = "colours have 8 bits here";
    } else {
      switch (c.kind) {
        case CaseKind::coverage:
          run_coverage(c, subject, out, row);
          break;
        case CaseKind::picture:
        case CaseKind::state:
          run_pictures(c, subject, out, row);
          break;
        case CaseKind::tiling:
          run_tiling(c, subject, out, row);
          break;
        case CaseKind::probe:
          run_probe(c, subject, out, row);
          break;
        case CaseKind::ties:
          run_ties(c, subject, out, row);
          break;
        case CaseKind::relation:
          run_relation(c, subject, out, row);
          break;
        case CaseKind::repeat:
          run_repeat(c, out, row);
          break;
        case CaseKind::survive:
          for (const Drawing& d : c.drawings) picture_of(c, subject, maker_.as_given(d), out);
          break;
      }
    }
    out.rows.push_back(std::move(row));
    return out;
  }

  // ---- coverage -----------------------------------------------------------------------------------------

  /// The polygon as the rasterizer got it: in one piece, or in triangles.
  std::vector<TestPolygon> pieces_of(const Resolution& frame, const TestPolygon& polygon) const {
    return maker_.as_given({frame, {polygon}}).polygons;
  }

  /// Sorts the pixels of a picture by the polygons whose colours they have. Colours one less than they should
  /// be are taken as meant.
  void collect(const Drawing& drawing, const Framebuffer& picture, std::vector<Evidence>& evidence,
               std::vector<WrongSample>& strays, std::uint64_t& truncated) const {
    std::unordered_map<int, std::vector<std::size_t>> by_color;
    const auto key = [](int r, int g) { return (r / 8) * 32 + g / 8; };
    for (std::size_t k = 0; k < drawing.polygons.size(); ++k) {
      const ScreenVertex& v = drawing.polygons[k].front();
      by_color[key(v.r, v.g)].push_back(k);
    }
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const Color got = pixel_at(picture, x, y);
        if (got == maker_.background()) continue;
        const auto found = by_color.find(key(got[0], got[1]));
        bool known = false;
        if (found != by_color.end()) {
          for (const std::size_t k : found->second) {
            const ScreenVertex& v = drawing.polygons[k].front();
            if (std::abs(v.r - got[0]) > 1 || std::abs(v.g - got[1]) > 1 || std::abs(v.b - got[2]) > 1)
              continue;
            known = true;
            if (v.r != got[0] || v.g != got[1] || v.b != got[2]) ++truncated;
            Bitmap& bits = evidence[k].got;
            if (bits.window.contains(x, y)) {
              bits.set(x, y, 1);
            } else {
              ++evidence[k].far_away;
            }
            break;
          }
        }
        if (!known) strays.push_back({x, y, Wrong::extra, -1, -2, got});
      }
    }
  }

  void note_truncation(const Case& c, const Drawing& given, std::uint64_t truncated,
                       const Framebuffer& picture, Outcome& out) const {
    if (truncated == 0) return;
    Problem p;
    p.case_id = c.id(), p.verdict = "colour.truncation", p.drawing = given, p.got = picture,
    p.count = truncated;
    p.severity = options_.precision == Precision_ask::normal ? Severity::warning : Severity::error;
    p.message = "a constant colour comes out one less",
    p.hint = "round, or interpolate integers: weights that add up to 0.99999 lose one";
    out.problems.push_back(std::move(p));
  }

  void add_strays(const Case& c, const Drawing& given, std::vector<WrongSample> strays,
                  const Framebuffer& picture, Outcome& out) const {
    if (strays.empty()) return;
    // Colours of nobody where a polygon is: a matter of colour, not of coverage.
    const Expectation expected(given, ConsistentRule::lb);
    Problem p;
    std::uint64_t outside = 0;
    for (WrongSample& s : strays) {
      const auto covering = expected.covering(s.x, s.y);
      if (covering.empty()) {
        ++outside;
      } else {
        s.kind = Wrong::color, s.expected_owner = static_cast<int>(covering[0]);
      }
    }
    p.case_id = c.id(), p.drawing = given, p.got = picture, p.count = strays.size(),
    p.wrong = std::move(strays);
    if (outside > 0) {
      p.verdict = "cov.extra", p.message = "pixels outside all polygons have colours of no polygon",
      p.hint = "draw covered pixels only, in the polygon's colour";
    } else {
      p.verdict = "colour.wrong", p.message = "a polygon of one colour is drawn in others",
      p.hint = "the smallest example is below";
      out.colors.add(expected, p.wrong);
    }
    out.problems.push_back(std::move(p));
  }

  void run_coverage(const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
    const Drawing& drawing = c.drawings.front();
    const Drawing given = maker_.as_given(drawing);
    const auto picture = picture_of(c, subject, given, out);
    if (!picture) return;
    std::vector<Evidence> evidence;
    for (const TestPolygon& polygon : drawing.polygons) {
      Evidence& e = evidence.emplace_back();
      e.case_id = row.id, e.name = c.name;
      e.polygons = pieces_of(drawing.frame, polygon);
      if (e.polygons.empty()) e.polygons.push_back(polygon);
      e.got = Bitmap(bounds(polygon, drawing.frame, 2));
    }
    std::vector<WrongSample> strays;
    std::uint64_t truncated = 0;
    collect(drawing, *picture, evidence, strays, truncated);
    for (Evidence& e : evidence) {
      row.judged += e.got.at.size();
      e.wrong = wrong_samples(e);
      row.wrong += e.wrong;
    }
    add_strays(c, given, std::move(strays), *picture, out);
    note_truncation(c, given, truncated, *picture, out);
    // Frames of millions of samples are no use for naming a rule: kept only when wrong.
    for (Evidence& e : evidence) {
      if (e.wrong > 0 || e.got.at.size() <= 20000) out.evidence.push_back(std::move(e));
    }
  }

  static Window tile_window(std::size_t slot) {
    const int x = static_cast<int>(slot % k_tiles) * k_tile, y = static_cast<int>(slot / k_tiles) * k_tile;
    return {x, y, x + k_tile, y + k_tile};
  }

  void run_sheet(const Unit& unit, Subject& subject, Outcome& out) {
    const Case& first = corpus_[unit.cases.front()];
    Drawing sheet{{k_sheet, k_sheet, 512, 256}, {}};
    std::vector<Evidence> evidence;
    for (std::size_t slot = 0; slot < unit.cases.size(); ++slot) {
      const Case& c = corpus_[unit.cases[slot]];
      const Window w = tile_window(slot);
      TestPolygon polygon =
          moved(c.drawings.front().polygons.front(), w.x0 + k_tile_origin, w.y0 + k_tile_origin);
      paint(polygon, identification_color(slot));
      Evidence& e = evidence.emplace_back();
      e.case_id = c.id(), e.name = c.name, e.got = Bitmap(w);
      e.polygons = pieces_of(sheet.frame, polygon);
      sheet.polygons.push_back(std::move(polygon));
      out.rows.push_back(row_of(unit.cases[slot]));
    }
    const Drawing given = maker_.as_given(sheet);
    const auto picture = picture_of(first, subject, given, out);
    if (!picture) {
      // Whose fault: one by one, until it has happened a few times.
      int failed = 0;
      for (std::size_t slot = 0; slot < unit.cases.size() && failed < 3; ++slot) {
        const Case& c = corpus_[unit.cases[slot]];
        Outcome alone;
        if (!picture_of(c, subject, maker_.as_given(c.drawings.front()), alone)) ++failed;
        for (Problem& p : alone.problems) out.problems.push_back(std::move(p));
      }
      return;
    }
    std::vector<WrongSample> strays;
    std::uint64_t truncated = 0;
    collect(sheet, *picture, evidence, strays, truncated);
    for (std::size_t slot = 0; slot < evidence.size(); ++slot) {
      evidence[slot].wrong = wrong_samples(evidence[slot]);
      out.rows[slot].judged = evidence[slot].got.at.size(), out.rows[slot].wrong = evidence[slot].wrong;
    }
    add_strays(first, given, std::move(strays), *picture, out);
    note_truncation(first, given, truncated, *picture, out);
    for (Evidence& e : evidence) out.evidence.push_back(std::move(e));
  }

  /// Names the cause of all wrong coverage seen so far. False: there is no point in going on.
  bool name_coverage_cause() {
    if (stop_) return false;
    cause_ = name_coverage(evidence_);
    result_.rule_fingerprint.required = options_.accepted_rule;
    result_.rule_fingerprint.table = fingerprint(evidence_);
    if (cause_.verdict.empty()) {
      result_.rule_fingerprint.named = "lb";
      if (options_.accepted_rule != "lb") {
        cause_.verdict = "fill.rule", cause_.detail = "lb",
        cause_.message = "it follows the fill rule lb, where " + options_.accepted_rule + " is asked for";
        cause_.hint = "--accept-rule lb is the default";
      }
      return true;
    }
    if (!cause_.detail.empty() && cause_.explained == cause_.wrong) {
      result_.rule_fingerprint.named = cause_.detail;
    } else if (!cause_.detail.empty()) {
      result_.rule_fingerprint.closest = cause_.detail;
      result_.rule_fingerprint.closest_explains =
          static_cast<double>(cause_.explained) / static_cast<double>(cause_.wrong);
    }
    if (carries_state()) {
      cause_ = {};
      evidence_.clear();
      std::erase_if(problems_,
                    [](const Problem& p) { return p.verdict == "cov.extra" || p.verdict == "colour.wrong"; });
      return false;
    }
    if (does_not_repeat()) {
      cause_.verdict = "cov.extra", cause_.detail.clear(), cause_.consistent = false;
      cause_.message = "samples are wrong that are right when the polygon is drawn again",
      cause_.hint = "look for memory that was never written, for threads, or for a random number";
      return true;
    }
    if (cause_.consistent) {
      rule_ = cause_.rule;
    } else {
      skip_boundary_ = true;
      for (int r = 0; r < k_fill_rules; ++r) {
        if (rule_name(FillRule{static_cast<std::uint8_t>(r)}) == cause_.detail)
          known_rule_ = FillRule{static_cast<std::uint8_t>(r)};
      }
      result_.notes.push_back(
          "depth and colour are judged inside polygons only, since no consistent fill rule was found");
    }
    return true;
  }

  /// Draws a wrong case twice in a new life: right at first and wrong then means that a frame leaves
  /// something behind.
  bool carries_state() {
    int tried = 0;
    for (const std::size_t w : cause_.witnesses) {
      if (++tried > 3) break;
      const Evidence& e = evidence_[w];
      if (leaves_state_behind(e.case_id, alone(e))) return true;
    }
    return false;
  }

  /// Every wrong case, or the first few, come out right alone.
  bool does_not_repeat() {
    const std::unique_ptr<Subject> life = maker_.make(0);
    int tried = 0;
    for (std::size_t n = 0; n < cause_.witnesses.size() && tried < 5; ++n) {
      const Drawing given = alone(evidence_[cause_.witnesses[n]]);
      // In a large picture it may well happen again.
      if (window_of(given.frame).samples() > 64 * 64) continue;
      ++tried;
      const Delivered d = draw(*life, given);
      if (!d.picture) return false;
      const Expectation expected(given, ConsistentRule::lb);
      if (!judge(expected, *d.picture, {maker_.background(), false, false, Precision_ask::normal})
               .wrong.empty())
        return false;
    }
    return tried > 0;
  }

  bool leaves_state_behind(const std::string& case_id, const Drawing& given) {
    const std::unique_ptr<Subject> life = maker_.make(0);
    const Delivered first = draw(*life, given), second = draw(*life, given);
    if (!first.picture) return false;
    const Expectation expected(given, ConsistentRule::lb);
    const JudgeOptions how{maker_.background(), false, false, Precision_ask::normal};
    if (!judge(expected, *first.picture, how).wrong.empty()) return false;
    if (second.picture && judge(expected, *second.picture, how).wrong.size() < 3) return false;
    Problem p;
    p.case_id = case_id, p.verdict = "abi.state", p.drawing = given;
    p.message =
        "the first frame of a life is right, the same frame again is not: something is left over from frame "
        "to frame";
    p.hint = "begin_frame() has to start from nothing: clear your tables there";
    if (second.picture)
      p.got = *second.picture, p.wrong = judge(expected, *second.picture, how).wrong,
      p.count = p.wrong.size();
    problems_.push_back(std::move(p));
    return true;
  }

  /// A drawing of one piece of evidence alone, in a small frame.
  static Drawing alone(const Evidence& e) {
    Drawing d{{64, 64, 512, 256}, e.polygons};
    const Window w = e.got.window;
    const int dx = w.x0 > 0 && w.x1 - w.x0 <= 60 ? w.x0 - 1 : 0,
              dy = w.y0 > 0 && w.y1 - w.y0 <= 60 ? w.y0 - 1 : 0;
    for (TestPolygon& p : d.polygons) p = moved(std::move(p), -dx, -dy);
    for (const TestPolygon& p : d.polygons) {
      for (const ScreenVertex& v : p)
        d.frame.x = std::max(d.frame.x, v.x + 1), d.frame.y = std::max(d.frame.y, v.y + 1);
    }
    return d;
  }

  // ---- pictures -----------------------------------------------------------------------------------------

  void run_pictures(const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
    std::vector<std::optional<Framebuffer>> pictures;
    for (const Drawing& drawing : c.drawings) {
      const Drawing given = maker_.as_given(drawing);
      auto picture = picture_of(c, subject, given, out);
      if (picture) judge_picture(c, given, *picture, out, row);
      pictures.push_back(std::move(picture));
    }
    if (c.kind != CaseKind::state) return;
    for (std::size_t i = 0; i < c.drawings.size(); ++i) {
      for (std::size_t k = i + 1; k < c.drawings.size(); ++k) {
        if (corpus_hash_of(c.drawings[i]) != corpus_hash_of(c.drawings[k]) || !pictures[i] || !pictures[k])
          continue;
        if (same_picture(*pictures[i], *pictures[k])) continue;
        Problem p;
        p.case_id = row.id, p.verdict = "abi.state", p.drawing = c.drawings[k], p.got = *pictures[k];
        p.message = "a frame comes out differently after another one",
        p.hint = "begin_frame() has to start from nothing: clear your tables there";
        p.count = 1;
        out.problems.push_back(std::move(p));
        return;
      }
    }
  }

  static std::uint64_t corpus_hash_of(const Drawing& d) {
    Case c;
    c.drawings = {d};
    return corpus_hash({c});
  }

  void judge_picture(const Case& c, const Drawing& given, const Framebuffer& picture, Outcome& out,
                     CaseResult& row) const {
    Expectation expected(given, rule_);
    if (known_rule_) expected.add_boundary_of(*known_rule_);
    Judged judged = judge(expected, picture, judge_options(c));
    row.judged += judged.judged, row.ambiguous += judged.ambiguous, row.wrong += judged.wrong.size();
    out.worst_color = std::max(out.worst_color, judged.worst_color);
    if (c.family == "depth") out.depths.add(expected, picture);
    const auto note = [&](const char* verdict, Severity severity, std::string message, std::string hint,
                          std::uint64_t count) {
      Problem p;
      p.case_id = row.id, p.verdict = verdict, p.severity = severity, p.drawing = given, p.got = picture,
      p.count = count;
      p.message = std::move(message), p.hint = std::move(hint);
      out.problems.push_back(std::move(p));
    };
    note_truncation(c, given, judged.truncated, picture, out);
    if (judged.drifted > 0) {
      note("colour.drift", Severity::warning, "colours are off by more than rounding",
           "keep more fractional bits, or use double", judged.drifted);
    }
    if (judged.wrong.empty()) return;
    out.colors.add(expected, judged.wrong);
    // By kind, so that one cause is told once.
    std::map<std::string, std::vector<WrongSample>> kinds;
    for (const WrongSample& s : judged.wrong) kinds[kind_of(expected, s, c.family)].push_back(s);
    for (auto& [verdict, samples] : kinds) {
      note(verdict.c_str(), Severity::error, "", "", samples.size());
      out.problems.back().wrong = std::move(samples);
    }
  }

  /// A provisional verdict of one wrong sample; those with a star get their name from statistics.
  static std::string kind_of(const Expectation& expected, const WrongSample& s, const std::string& family) {
    switch (s.kind) {
      case Wrong::missing: {
        const ExactPolygon& p = expected.polygons()[static_cast<std::size_t>(s.expected_owner)];
        const bool farthest = p.range(Attribute::z).first == expected.drawing().frame.z - 1;
        return farthest ? "depth.far-plane" : "cov.missing";
      }
      case Wrong::extra:
        return "cov.extra";
      case Wrong::owner:
        return family == "colour" ? "colour.stale" : "depth.*";
      case Wrong::color:
        break;
    }
    return "colour.*";
  }

  // ---- tilings ------------------------------------------------------------------------------------------

  void run_tiling(const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
    const Drawing given = maker_.as_given(c.drawings.front());
    Drawing backward = given;
    std::ranges::reverse(backward.polygons);
    const auto one = picture_of(c, subject, given, out);
    if (!one) return;
    const auto two = picture_of(c, subject, backward, out);
    if (!two) return;
    const Expectation expected(given, rule_);
    Problem gap, overlap, extra;
    for (int y = 0; y < given.frame.y; ++y) {
      for (int x = 0; x < given.frame.x; ++x) {
        const auto covering = expected.covering(x, y);
        const Color a = pixel_at(*one, x, y), b = pixel_at(*two, x, y);
        ++row.judged;
        const bool drawn = a != maker_.background();
        const int owner = covering.empty() ? -1 : static_cast<int>(covering[0]);
        if (!covering.empty() && !drawn) gap.wrong.push_back({x, y, Wrong::missing, owner, -1, a});
        if (covering.size() == 1 && drawn && !near(a, b))
          overlap.wrong.push_back({x, y, Wrong::owner, owner, -2, a});
        // Where it should not be: neighbours that overlap beyond the border of the tiling.
        if (covering.empty() && drawn)
          (near(a, b) ? extra : overlap).wrong.push_back({x, y, Wrong::extra, -1, -2, a});
      }
    }
    const auto note = [&](Problem& p, const char* verdict, const char* message, const char* hint) {
      if (p.wrong.empty()) return;
      p.case_id = row.id, p.verdict = verdict, p.message = message, p.hint = hint, p.drawing = given,
      p.got = *one, p.count = p.wrong.size();
      row.wrong += p.wrong.size();
      out.problems.push_back(std::move(p));
    };
    note(gap, "tile.gap", "a pixel inside a tiling belongs to no polygon",
         "every pixel of a shared edge belongs to exactly one of its two polygons");
    note(overlap, "tile.overlap", "a pixel is drawn by two neighbours",
         "every pixel of a shared edge belongs to exactly one of its two polygons");
    note(extra, "cov.extra", "pixels outside a tiling are drawn", "the smallest example is below");
  }

  static bool near(const Color& a, const Color& b) {
    return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
  }

  // ---- depth that nobody shows --------------------------------------------------------------------------

  struct Probe {
    int x = 0, y = 0;
    std::uint32_t owner = 0;
    Rational value;
    std::int64_t low = -1, high = 0;  ///< farthest depth known to win, nearest known to lose
  };

  /// The unit square that covers exactly this sample under the rule in use; where it fits.
  std::optional<TestPolygon> probe_square(const Resolution& frame, int x, int y) const {
    const auto r = static_cast<unsigned>(rule_) % 4;
    const int x0 = (r & 2) != 0 ? x - 1 : x, y0 = (r & 1) != 0 ? y - 1 : y;
    if (x0 < 0 || y0 < 0 || x0 + 1 >= frame.x || y0 + 1 >= frame.y) return std::nullopt;
    return rectangle(x0, y0, x0 + 1, y0 + 1);
  }

  /// Draws the scene and one probe per sample at the depths given; true where the probe shows.
  std::optional<std::vector<bool>> probes_show(const Case& c, Subject& subject, const Drawing& scene,
                                               const std::vector<Probe>& probes,
                                               const std::vector<std::int64_t>& depths, Outcome& out) {
    Drawing drawing = scene;
    for (TestPolygon& p : drawing.polygons) paint(p, {252, 4, 8});
    for (std::size_t i = 0; i < probes.size(); ++i) {
      if (depths[i] < 0 || depths[i] >= scene.frame.z) continue;
      TestPolygon square = *probe_square(scene.frame, probes[i].x, probes[i].y);
      paint(square, {4, 252, 8});
      set_depth(square, depths[i]);
      drawing.polygons.push_back(std::move(square));
    }
    const auto picture = picture_of(c, subject, maker_.as_given(drawing), out);
    if (!picture) return std::nullopt;
    std::vector<bool> shows;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const Color got = pixel_at(*picture, probes[i].x, probes[i].y);
      shows.push_back(depths[i] < 0 || (depths[i] < scene.frame.z && got[1] > 128));
    }
    return shows;
  }

  void run_probe(const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
    if (skip_boundary_) {
      row.status = CaseStatus::skipped,
      row.reason = "depth cannot be measured without a consistent fill rule";
      return;
    }
    const Drawing given = maker_.as_given(c.drawings.front());
    const Expectation expected(given, rule_);
    std::vector<Probe> probes;
    std::uint64_t covered = 0;
    for (const Window w = window_of(given.frame); covered == 0;) {
      for (int y = w.y0; y < w.y1; ++y) {
        for (int x = w.x0; x < w.x1; ++x) covered += expected.covering(x, y).empty() ? 0 : 1;
      }
      if (covered == 0) return;
    }
    // Large polygons are measured at every n-th sample, n odd to the rows' lengths.
    const std::uint64_t every = covered / k_max_probes + 1;
    std::uint64_t number = 0;
    for (int y = 0; y < given.frame.y; ++y) {
      for (int x = 0; x < given.frame.x; ++x) {
        const int owner = expected.nearest(x, y);
        if (owner < 0 || number++ % every != 0 || !probe_square(given.frame, x, y)) continue;
        const auto& plane = expected.polygons()[static_cast<std::size_t>(owner)].plane(Attribute::z);
        if (!plane) continue;
        probes.push_back({x, y, static_cast<std::uint32_t>(owner), plane->at(x, y), -1, given.frame.z});
      }
    }
    row.judged += probes.size();
    // Right when a probe just beyond the tolerance wins in front and loses behind.
    const auto bound = [&](const Probe& p, bool loose) {
      const Tolerance& t = expected.polygons()[p.owner].tolerance(Attribute::z);
      return loose ? t.bound : t.unremarkable;
    };
    const auto misses = [&](bool loose) -> std::optional<std::vector<std::size_t>> {
      std::vector<std::int64_t> front, behind;
      for (const Probe& p : probes) {
        const Rational t = bound(p, loose);
        front.push_back(static_cast<std::int64_t>((p.value - t - Rational{1, 1}).ceil()));
        behind.push_back(static_cast<std::int64_t>((p.value + t).floor()) + 1);
      }
      const auto wins = probes_show(c, subject, given, probes, front, out);
      if (!wins) return std::nullopt;
      const auto loses = probes_show(c, subject, given, probes, behind, out);
      if (!loses) return std::nullopt;
      std::vector<std::size_t> wrong;
      for (std::size_t i = 0; i < probes.size(); ++i) {
        if (!(*wins)[i] || (*loses)[i]) wrong.push_back(i);
      }
      return wrong;
    };
    const auto drifting = misses(false);
    if (!drifting || drifting->empty()) return;
    const auto wrong = misses(true);
    if (!wrong) return;
    std::vector<Probe> bad;
    for (const std::size_t i : wrong->empty() ? *drifting : *wrong) bad.push_back(probes[i]);
    // How deep is it there? All at once, by halving.
    for (bool open = true; open;) {
      open = false;
      std::vector<std::int64_t> depths;
      for (const Probe& p : bad) depths.push_back(p.high - p.low > 1 ? p.low + (p.high - p.low) / 2 : -1);
      const auto shows = probes_show(c, subject, given, bad, depths, out);
      if (!shows) return;
      for (std::size_t i = 0; i < bad.size(); ++i) {
        if (depths[i] < 0) continue;
        ((*shows)[i] ? bad[i].low : bad[i].high) = depths[i];
        open = open || bad[i].high - bad[i].low > 1;
      }
    }
    std::vector<MeasuredDepth> measured;
    Problem p;
    for (const Probe& b : bad) {
      measured.push_back({b.x, b.y, b.owner, b.low});
      p.wrong.push_back({b.x, b.y, Wrong::owner, static_cast<int>(b.owner), static_cast<int>(b.owner), {}});
    }
    DepthStatistics::Name name = name_depths(expected, measured);
    if (c.name == "write" && name.verdict == "depth.wrong")
      name = {"depth.stale", "a polygon that loses the depth test leaves its depth behind",
              "write depth and colour together, and only where the test is won"};
    if (c.name == "zres" && given.frame.z > 65536 && name.verdict != "depth.drift")
      name = {"depth.overflow", fmt::format("depths are wrong at a depth resolution of {}", given.frame.z),
              "a product exceeds 32 bits: use 64"};
    if (wrong->empty())
      name = {"depth.drift", "depths are off by more than rounding",
              "keep more fractional bits, or use double"};
    p.case_id = row.id, p.verdict = name.verdict, p.message = name.message, p.hint = name.hint;
    p.severity = wrong->empty() ? Severity::warning : Severity::error;
    p.drawing = given, p.count = p.wrong.size();
    row.wrong += wrong->size();
    if (const auto picture = picture_of(c, subject, given, out)) p.got = *picture;
    out.problems.push_back(std::move(p));
  }

  // ---- relations ----------------------------------------------------------------------------------------

  void run_ties(const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
    std::uint64_t first = 0, last = 0;
    Framebuffer got;
    Drawing given;
    for (const Drawing& drawing : c.drawings) {
      given = maker_.as_given(drawing);
      const auto picture = picture_of(c, subject, given, out);
      if (!picture) return;
      Expectation expected(given, rule_);
      if (known_rule_) expected.add_boundary_of(*known_rule_);
      for (int y = 0; y < given.frame.y; ++y) {
        for (int x = 0; x < given.frame.x; ++x) {
          const auto covering = expected.covering(x, y);
          if (covering.size() < 2 || (skip_boundary_ && expected.on_boundary(x, y))) continue;
          ++row.judged;
          const auto shows = [&](std::uint32_t k) {
            const ScreenVertex& v = given.polygons[k].front();
            return near(pixel_at(*picture, x, y),
                        {static_cast<std::uint8_t>(v.r), static_cast<std::uint8_t>(v.g),
                         static_cast<std::uint8_t>(v.b)});
          };
          first += shows(covering.front()) ? 1 : 0, last += shows(covering.back()) ? 1 : 0;
        }
      }
      got = *picture;
    }
    const std::lock_guard lock(ties_mutex_);
    ties_first_ += first, ties_last_ += last;
    if (first == 0 || last == 0) return;
    Problem p;
    p.case_id = row.id, p.verdict = "depth.ties", p.severity = Severity::warning, p.drawing = given,
    p.got = got, p.count = std::min(first, last);
    p.message =
        fmt::format("of equal depths the first drawn wins at {} samples and the last at {}", first, last),
    p.hint = "decide once: < keeps the first, <= the last";
    out.problems.push_back(std::move(p));
  }

  void run_relation(const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
    // A cut polygon and the like: under an inconsistent rule they need not agree, and that is known already.
    if (skip_boundary_) {
      row.status = CaseStatus::skipped, row.reason = "no consistent fill rule";
      return;
    }
    const Drawing a = maker_.as_given(c.drawings[0]), b = maker_.as_given(c.drawings[1]);
    const auto one = picture_of(c, subject, a, out);
    const auto two = one ? picture_of(c, subject, b, out) : std::nullopt;
    if (!one || !two) return;
    Problem p;
    for (int y = c.window.y0; y < c.window.y1; ++y) {
      for (int x = c.window.x0; x < c.window.x1; ++x) {
        ++row.judged;
        const Color got = pixel_at(*two, x + c.shift_x, y + c.shift_y);
        // The frame's last column and row are cut off in the smaller frame under some rules.
        if (c.name == "crop" && (x == 0 || y == 0 || x == c.window.x1 - 1 || y == c.window.y1 - 1)) continue;
        if (!near(pixel_at(*one, x, y), got))
          p.wrong.push_back({x + c.shift_x, y + c.shift_y, Wrong::color, -1, -2, got});
      }
    }
    if (p.wrong.empty()) return;
    row.wrong += p.wrong.size();
    p.case_id = row.id, p.verdict = "meta." + c.name, p.drawing = b, p.got = *two, p.count = p.wrong.size();
    p.message = "two pictures that must be equal are not: " + c.purpose, p.hint = "compare both pictures";
    out.problems.push_back(std::move(p));
  }

  void run_repeat(const Case& c, Outcome& out, CaseResult& row) {
    std::vector<Drawing> given;
    for (const Drawing& d : c.drawings) given.push_back(maker_.as_given(d));
    const auto life = [&](std::uint8_t memory, int times) {
      std::vector<Framebuffer> pictures;
      const std::unique_ptr<Subject> subject = maker_.make(memory);
      for (int t = 0; t < times; ++t) {
        for (const Drawing& d : given)
          pictures.push_back(picture_of(c, *subject, d, out).value_or(Framebuffer{}));
      }
      return pictures;
    };
    const std::vector<Framebuffer> twice = life(0, 2), again = life(0, 1), filled = life(0xA5, 1),
                                   other = life(0x3C, 1);
    const std::vector<Framebuffer> once(twice.begin(),
                                        twice.begin() + static_cast<std::ptrdiff_t>(given.size()));
    const std::vector<Framebuffer> second(twice.begin() + static_cast<std::ptrdiff_t>(given.size()),
                                          twice.end());
    const auto compare = [&](const std::vector<Framebuffer>& pictures, const char* verdict,
                             const char* message, const char* hint) {
      for (std::size_t i = 0; i < given.size(); ++i) {
        row.judged += window_of(given[i].frame).samples();
        if (same_picture(once[i], pictures[i]) || once[i].rgb.empty() || pictures[i].rgb.empty()) continue;
        Problem p;
        for (int y = 0; y < once[i].height; ++y) {
          for (int x = 0; x < once[i].width; ++x) {
            if (pixel_at(once[i], x, y) != pixel_at(pictures[i], x, y))
              p.wrong.push_back({x, y, Wrong::color, -1, -2, pixel_at(pictures[i], x, y)});
          }
        }
        row.wrong += p.wrong.size();
        p.case_id = row.id, p.verdict = verdict, p.message = message, p.hint = hint, p.drawing = given[i],
        p.got = pictures[i], p.count = p.wrong.size();
        out.problems.push_back(std::move(p));
        return true;
      }
      return false;
    };
    const char* read =
        "you read memory that was never written, or use a clock, an address or a random number";
    if (!compare(second, "det.rerun", "the same frame drawn again in the same life differs", read))
      compare(again, "det.rerun", "the same frames in another process differ", read);
    const char* clear = "you read memory that was never written: clear it first";
    if (!compare(filled, "det.fill", "pictures depend on what fresh memory contains", clear))
      compare(other, "det.fill", "pictures depend on what fresh memory contains", clear);
  }

  // ---- smoke --------------------------------------------------------------------------------------------

  /// True when the rest is worth running.
  bool run_smoke() {
    struct Smoke {
      std::size_t index;
      Drawing given;
      Framebuffer picture;
    };
    std::vector<Smoke> drawn;
    Outcome out;
    const std::unique_ptr<Subject> subject = maker_.make(0);
    for (std::size_t i = 0; i < corpus_.size(); ++i) {
      if (corpus_[i].family != "smoke") continue;
      const Drawing given = maker_.as_given(corpus_[i].drawings.front());
      const auto picture = picture_of(corpus_[i], *subject, given, out);
      rows_[i] = row_of(i);
      if (picture) drawn.push_back({i, given, *picture});
    }
    done_ += drawn.size();
    const bool failed =
        std::ranges::any_of(out.problems, [](const Problem& p) { return p.severity == Severity::error; });
    take(std::move(out));
    if (failed) return give_up("smoke failed: see there");
    const auto wrong = [&](const Smoke& s, const Transform& t) {
      const Expectation expected(s.given, ConsistentRule::lb);
      return judge(expected, t.undo(s.picture, maker_.background()),
                   {maker_.background(), false, false, Precision_ask::normal});
    };
    std::uint64_t bad = 0;
    for (const Smoke& s : drawn) bad += wrong(s, {}).wrong.size();
    if (bad == 0) {
      for (const Smoke& s : drawn) judge_smoke(s.index, s.given, s.picture);
      return true;
    }
    const auto untouched = [&](const Smoke& s) {
      for (std::size_t i = 0; i < s.picture.rgb.size(); ++i) {
        if (s.picture.rgb[i] != maker_.background()[i % 3]) return false;
      }
      return true;
    };
    const auto report = [&](const Smoke& s, std::string verdict, std::string detail, std::string message,
                            std::string hint, std::vector<WrongSample> samples) {
      Problem p;
      p.case_id = rows_[s.index].id, p.verdict = std::move(verdict), p.detail = std::move(detail),
      p.message = std::move(message), p.hint = std::move(hint);
      p.drawing = s.given, p.got = s.picture, p.count = samples.size(), p.wrong = std::move(samples);
      rows_[s.index].wrong = p.count;
      problems_.push_back(std::move(p));
    };
    for (const Smoke& s : drawn) {
      if (s.given.polygons.empty() || !wrong(s, {}).wrong.empty()) {
        if (!s.given.polygons.empty() && leaves_state_behind(rows_[s.index].id, s.given))
          return give_up("frames depend on each other");
      }
    }
    const bool blank =
        std::ranges::all_of(drawn, [&](const Smoke& s) { return s.given.polygons.empty() || untouched(s); });
    if (blank && !drawn.empty()) {
      const Smoke& s = *std::ranges::find_if(drawn, [](const Smoke& d) { return !d.given.polygons.empty(); });
      // Perhaps it draws the other way round only; then the triangles will tell.
      Drawing other = s.given;
      for (TestPolygon& polygon : other.polygons) polygon = reversed(std::move(polygon));
      const Delivered d = draw(*subject, other);
      if (d.picture && !untouched({s.index, other, *d.picture})) return true;
      report(s, "frame.blank", "", "no pixel changed",
             "is the polygon function called? does it write to the buffer that it is given?",
             wrong(s, {}).wrong);
      return give_up("nothing is drawn");
    }
    for (const Transform& t : whole_frame_transforms()) {
      const bool exact =
          std::ranges::all_of(drawn, [&](const Smoke& s) { return wrong(s, t).wrong.empty(); });
      if (!exact) continue;
      const auto s = std::ranges::find_if(drawn, [&](const Smoke& d) { return !wrong(d, {}).wrong.empty(); });
      report(*s, t.verdict, t.detail, t.message, t.hint, wrong(*s, {}).wrong);
      transform_ = t;
      return true;
    }
    for (const Smoke& s : drawn) {
      const Judged judged = wrong(s, {});
      std::uint64_t outside = 0;
      for (const WrongSample& w : judged.wrong) outside += w.kind == Wrong::extra ? 1 : 0;
      if (2 * outside < judged.judged) continue;
      report(s, "frame.background", "", "pixels that no polygon covers are changed",
             "the background is there already: do not clear, and draw covered pixels only", judged.wrong);
      return give_up("the background is not kept");
    }
    for (const Smoke& s : drawn) judge_smoke(s.index, s.given, s.picture);
    return true;
  }

  void judge_smoke(std::size_t i, const Drawing& given, const Framebuffer& picture) {
    Outcome out;
    judge_picture(corpus_[i], given, picture, out, rows_[i]);
    // Wrong coverage counts with that of the family that is about it.
    const Drawing& drawing = corpus_[i].drawings.front();
    if (drawing.polygons.size() == 1) {
      Evidence e;
      e.case_id = rows_[i].id, e.name = corpus_[i].name;
      e.polygons = pieces_of(drawing.frame, drawing.polygons.front());
      e.got = Bitmap(bounds(drawing.polygons.front(), drawing.frame, 2));
      const Window& w = e.got.window;
      for (int y = w.y0; y < w.y1; ++y) {
        for (int x = w.x0; x < w.x1; ++x)
          e.got.set(x, y, pixel_at(picture, x, y) != maker_.background() ? 1 : 0);
      }
      out.evidence.push_back(std::move(e));
    }
    take(std::move(out));
  }

  bool give_up(const std::string& why) {
    for (CaseResult& row : rows_) {
      if (row.status == CaseStatus::skipped) row.reason = why;
    }
    return false;
  }

  // ---- causes become findings ---------------------------------------------------------------------------

  void name_values() {
    const DepthStatistics::Name depth = depths_.name(), color = colors_.name();
    const bool coverage_known = !cause_.verdict.empty();
    std::vector<Problem> kept;
    const bool depth_trouble =
        std::ranges::any_of(problems_, [](const Problem& p) { return p.verdict == "depth.*"; });
    for (Problem& p : problems_) {
      if (p.verdict == "colour.*" || p.verdict == "colour.wrong")
        p.verdict = color.verdict, p.message = color.message, p.hint = color.hint;
      if (p.verdict == "colour.stale") {
        if (depth_trouble) continue;  // the wrong polygon is in front: known
        p.message = "a hidden polygon's colour shows",
        p.hint = "write depth and colour together, and only where the depth test is won";
      }
      if (p.verdict == "depth.*") p.verdict = depth.verdict, p.message = depth.message, p.hint = depth.hint;
      if (p.verdict == "depth.far-plane")
        p.message = "a polygon at the farthest depth does not appear",
        p.hint = "start the depth buffer beyond the farthest value";
      if (p.verdict.starts_with("cov.")) {
        if (coverage_known) continue;  // named already
        if (p.message.empty()) {
          p.message =
              p.verdict == "cov.missing" ? "pixels are missing" : "pixels are drawn that no polygon covers";
          p.hint = "the smallest example is below";
        }
      }
      if (p.verdict == "tile.gap" && (cause_.verdict.starts_with("fill."))) continue;
      if (p.verdict == "tile.overlap" &&
          (cause_.verdict == "fill.rule" || cause_.verdict == "fill.neither-end" ||
           cause_.verdict == "fill.truncated" || cause_.verdict == "fill.half-pixel"))
        continue;
      kept.push_back(std::move(p));
    }
    problems_ = std::move(kept);
    if (!cause_.verdict.empty() && !(cause_.detail == options_.accepted_rule)) {
      Problem p;
      p.verdict = cause_.verdict, p.detail = cause_.detail, p.hint = cause_.hint;
      p.message = cause_.detail.empty() || cause_.wrong == 0
                      ? cause_.message
                      : fmt::format("{} ({} of {} wrong samples explained)", cause_.message, cause_.explained,
                                    cause_.wrong);
      p.count = cause_.wrong;
      std::set<std::string> seen;
      for (std::size_t n = 0; n < cause_.witnesses.size(); ++n) {
        const Evidence& e = evidence_[cause_.witnesses[n]];
        if (seen.insert(e.case_id).second) coverage_cases_.push_back(e.case_id);
      }
      if (!cause_.witnesses.empty()) {
        p.drawing = alone(evidence_[cause_.witnesses.front()]);
        p.case_id = evidence_[cause_.witnesses.front()].case_id;
      }
      problems_.insert(problems_.begin(), std::move(p));
    }
  }

  void finish() {
    std::map<std::string, std::size_t> index;
    std::vector<std::vector<const Problem*>> members;
    for (const Problem& p : problems_) {
      const std::string key = p.verdict + " " + p.detail + " " + severity_letter(p.severity);
      const auto [at, is_new] = index.try_emplace(key, result_.findings.size());
      if (is_new) {
        Finding& f = result_.findings.emplace_back();
        f.verdict = p.verdict, f.detail = p.detail, f.severity = p.severity, f.message = p.message,
        f.hint = p.hint;
        f.trace = p.trace, f.at_polygon = p.polygon;
        members.emplace_back();
      }
      Finding& f = result_.findings[at->second];
      f.count += p.count, f.total += p.count, f.explained += p.count;
      members[at->second].push_back(&p);
      if (&p == &problems_.front() && !coverage_cases_.empty() && p.verdict == cause_.verdict) {
        f.case_ids = coverage_cases_;
        f.explained = cause_.explained;
      } else if (f.case_ids.empty() || f.case_ids.back() != p.case_id) {
        f.case_ids.push_back(p.case_id);
      }
    }
    std::map<std::string, std::vector<std::pair<std::string, Severity>>> verdicts;
    for (std::size_t i = 0; i < result_.findings.size(); ++i) {
      Finding& f = result_.findings[i];
      add_examples(f, members[i]);
      for (const std::string& id : f.case_ids) verdicts[id].emplace_back(f.verdict, f.severity);
    }
    std::ranges::stable_sort(result_.findings, {}, [](const Finding& f) { return f.severity; });
    std::map<std::string, FamilyResult> families;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      CaseResult& row = rows_[i];
      if (const auto found = verdicts.find(row.id);
          found != verdicts.end() && row.status != CaseStatus::skipped) {
        for (const auto& [verdict, severity] : found->second) {
          row.verdicts.push_back(verdict);
          if (severity == Severity::error) row.status = CaseStatus::failed;
          if (severity == Severity::warning && row.status == CaseStatus::passed)
            row.status = CaseStatus::warned;
        }
      }
      FamilyResult& family = families[corpus_[i].family];
      Summary& s = result_.summary;
      ++s.cases;
      family.judged += row.judged, family.wrong += row.wrong, family.ambiguous += row.ambiguous,
          family.milliseconds += row.milliseconds;
      s.judged += row.judged, s.wrong += row.wrong, s.ambiguous += row.ambiguous;
      switch (row.status) {
        case CaseStatus::passed:
          ++family.passed;
          break;
        case CaseStatus::failed:
          ++family.failed, ++s.failed;
          break;
        case CaseStatus::warned:
          ++family.warned, ++s.warned;
          break;
        case CaseStatus::skipped:
          ++family.skipped, ++s.skipped;
          if (family.skip_reason.empty()) family.skip_reason = row.reason;
          break;
      }
    }
    double share = 0;
    for (const FamilyFacts& facts : corpus_families()) {
      const auto found = families.find(std::string(facts.name));
      if (found == families.end()) continue;
      FamilyResult family = found->second;
      family.name = facts.name;
      const double all = static_cast<double>(family.passed + family.warned + family.failed + family.skipped);
      share += all == 0 ? 0 : static_cast<double>(family.passed + family.warned) / all;
      if (family.passed + family.warned + family.failed > 0) family.skip_reason.clear();
      result_.families.push_back(std::move(family));
    }
    result_.summary.score = families.empty() ? 0 : 100 * share / static_cast<double>(families.size());
    result_.summary.renders = renders_;
    result_.summary.verdict = result_.has_errors()             ? "fail"
                              : options_.accepted_rule != "lb" ? "pass.other-rule"
                                                               : "pass";
    if (options_.interrupted && options_.interrupted()) result_.summary.verdict = "interrupted";
    result_.cases = std::move(rows_);
  }

  // ---- examples -----------------------------------------------------------------------------------------

  static std::string_view kind_name(Wrong kind) {
    switch (kind) {
      case Wrong::missing:
        return "missing";
      case Wrong::extra:
        return "extra";
      case Wrong::owner:
        return "owner";
      case Wrong::color:
        break;
    }
    return "colour";
  }

  Example example_of(const Drawing& drawing, const Framebuffer& got, ConsistentRule rule) const {
    Example e;
    e.frame = drawing.frame, e.background = maker_.background(), e.polygons = drawing.polygons;
    e.flat = flat_text(drawing);
    const Expectation expected(drawing, rule);
    e.expected = ideal_picture(expected, maker_.background());
    for (int y = 0; y < drawing.frame.y; ++y) {
      for (int x = 0; x < drawing.frame.x; ++x) e.owners.push_back(expected.nearest(x, y));
    }
    if (got.rgb.empty()) {
      e.expected = {}, e.owners.clear();
      return e;
    }
    e.got = got;
    const Judged judged = judge(expected, got, {maker_.background(), false, false, options_.precision});
    e.wrong_pixels = judged.wrong.size();
    for (const WrongSample& s : judged.wrong) {
      if (e.pixels.size() == k_max_example_pixels) break;
      WrongPixel p;
      p.x = s.x, p.y = s.y, p.kind = kind_name(s.kind), p.expected_owner = s.expected_owner,
      p.got_owner = s.got_owner;
      p.expected = pixel_at(e.expected, s.x, s.y), p.got = s.got;
      if (s.expected_owner >= 0) {
        for (const Attribute a : k_attributes) {
          const auto& plane = expected.polygons()[static_cast<std::size_t>(s.expected_owner)].plane(a);
          if (!plane) continue;
          const Rational v = plane->at(s.x, s.y);
          ExactValue value;
          value.name = std::string(1, "zrgb"[static_cast<std::size_t>(a)]);
          value.numerator = static_cast<std::int64_t>(v.numerator),
          value.denominator = static_cast<std::int64_t>(v.denominator);
          if (a != Attribute::z) value.got = s.got[static_cast<std::size_t>(a) - 1];
          p.values.push_back(std::move(value));
        }
      }
      e.pixels.push_back(std::move(p));
    }
    return e;
  }

  /// Whether a drawing shows a verdict of this kind; fills the picture.
  bool shows(const std::string& verdict, const Drawing& drawing, Subject& subject, Framebuffer& got) {
    const Drawing given = maker_.as_given(drawing);
    if (given.polygons.empty()) return false;
    Delivered d = draw(subject, given);
    if (d.failure) return d.failure->verdict == verdict;
    if (!d.picture) return false;
    for (const SubjectFailure& r : d.remarks) {
      if (r.verdict == verdict) return got = *d.picture, true;
    }
    const bool coverage = verdict.starts_with("cov.") || verdict.starts_with("fill.");
    const Expectation expected(given, coverage ? ConsistentRule::lb : rule_);
    Judged judged;
    bool found = false;
    if (verdict.starts_with("tile.")) {
      // A neighbour is needed: a gap between two polygons, a sample drawn twice.
      Drawing backward = given;
      std::ranges::reverse(backward.polygons);
      const Delivered b = draw(subject, backward);
      if (!b.picture || given.polygons.size() < 2) return false;
      for (int y = 0; y < given.frame.y && !found; ++y) {
        for (int x = 0; x < given.frame.x && !found; ++x) {
          const bool drawn = pixel_at(*d.picture, x, y) != maker_.background();
          found = verdict == "tile.gap" ? !expected.covering(x, y).empty() && !drawn
                                        : expected.covering(x, y).size() < 2 && drawn &&
                                              !near(pixel_at(*d.picture, x, y), pixel_at(*b.picture, x, y));
        }
      }
    } else {
      judged = judge(expected, *d.picture,
                     {maker_.background(), skip_boundary_ && !coverage, false, options_.precision});
      for (const WrongSample& s : judged.wrong) {
        const bool samples = s.kind == Wrong::missing || s.kind == Wrong::extra;
        if (coverage || verdict == "depth.far-plane")
          found = found || samples;
        else if (verdict.starts_with("depth.") || verdict == "colour.stale")
          found = found || s.kind == Wrong::owner;
        else if (verdict.starts_with("colour."))
          found = found || s.kind == Wrong::color;
      }
      if (verdict == "colour.truncation") found = judged.truncated > 0;
    }
    if (found) got = *d.picture;
    return found;
  }

  void add_examples(Finding& f, std::vector<const Problem*> members) {
    const auto effort = [](const Problem* p) {
      std::size_t corners = 0;
      for (const TestPolygon& polygon : p->drawing.polygons) corners += polygon.size();
      return std::tuple(p->drawing.polygons.size(), corners, p->count);
    };
    std::ranges::stable_sort(members,
                             [&](const Problem* a, const Problem* b) { return effort(a) < effort(b); });
    const bool coverage = f.verdict.starts_with("cov.") || f.verdict.starts_with("fill.");
    const std::unique_ptr<Subject> subject = maker_.make(0);
    for (std::size_t i = 0; i < members.size() && i < 3; ++i) {
      const Problem& p = *members[i];
      Drawing drawing = p.drawing;
      Framebuffer got = p.got;
      int renders = 0;
      bool shrunk_it = false;
      const bool can_shrink = options_.shrink && i == 0 && f.severity != Severity::information &&
                              !f.verdict.starts_with("det.") && !f.verdict.starts_with("meta.") &&
                              f.verdict != "abi.state" && f.verdict != "depth.ties";
      if (can_shrink && !f.verdict.starts_with("frame.")) {
        Framebuffer last = got, seen;
        const auto fails = [&](const Drawing& d) {
          if (!shows(f.verdict, d, *subject, seen)) return false;
          last = seen;
          return true;
        };
        if (fails(drawing)) {
          drawing = shrunk(drawing, fails, {}, renders);
          got = last, shrunk_it = true;
        }
      }
      Example e = example_of(drawing, got, coverage ? ConsistentRule::lb : rule_);
      e.from_case = p.case_id, e.renders = renders, e.shrunk = shrunk_it;
      f.examples.push_back(std::move(e));
    }
  }

  const std::vector<Case>& corpus_;
  const SubjectMaker& maker_;
  const CheckOptions& options_;
  CheckResult result_;
  std::vector<CaseResult> rows_;
  std::vector<Problem> problems_;
  std::vector<Evidence> evidence_;
  std::vector<std::string> coverage_cases_;
  CoverageCause cause_;
  DepthStatistics depths_;
  ColorStatistics colors_;
  Transform transform_;
  ConsistentRule rule_ = ConsistentRule::lb;
  std::optional<FillRule> known_rule_;  ///< not consistent, but nearly all follows it
  bool skip_boundary_ = false, go_on_ = true;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> renders_{0};
  std::uint64_t done_ = 0;
  std::map<std::string, int> crashes_;
  std::mutex ties_mutex_;
  std::uint64_t ties_first_ = 0, ties_last_ = 0;
};

}  // namespace

CheckResult run_check(const std::vector<Case>& corpus, const SubjectMaker& maker,
                      const CheckOptions& options) {
  return Checker(corpus, maker, options).run();
}

}  // namespace farop::conformance
