// SPDX-License-Identifier: GPL-3.0-or-later
// What a run of the checker has found out: plain data, filled by run_check() and written by whoever reports.
//
// All pictures have row 0 at the bottom. All coordinates are those that the rasterizer got. Text comes in
// English and is safe to print (what a rasterizer says has been through printable()).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/framebuffer.h"
#include "core/screen_polygon.h"

namespace farop::conformance {

/// E fails a run, W and I do not. `none`: not judged (skip.*, unsupported, harness.error).
enum class Severity { error, warning, information, none };

/// Letter of a severity: E, W, I, -.
char severity_letter(Severity severity);

/// One polygon of an example, with values as a flat file has them.
using TestPolygon = std::vector<ScreenVertex>;

/// Red, green, blue, 0..255.
using Color = std::array<std::uint8_t, 3>;

/// One exact value at a sample: "z = 1207/7 = 172.43". Denominator > 0.
struct ExactValue {
  std::string name;  ///< "z", "r", "g", "b"
  std::int64_t numerator = 0, denominator = 1;
  std::optional<std::int64_t> got;  ///< what was delivered, or measured; nothing where that is not known
};

/// A sample that came out wrong.
struct WrongPixel {
  int x = 0, y = 0;
  Color expected{}, got{};
  /// "missing", "extra", "owner", "depth", "colour"; "differs" where two pictures were to be equal.
  std::string kind;
  int expected_owner = -1;         ///< polygon number within the example; -1: background
  int got_owner = -1;              ///< whose colour it has; -1: background; -2: nobody's
  std::vector<ExactValue> values;  ///< of the expected owner
};

/// The smallest drawing known to show a finding.
struct Example {
  Resolution frame;
  Color background{};
  std::vector<TestPolygon> polygons;  ///< in drawing order; empty where a finding has no drawing
  std::string flat;                   ///< the same as a flat file
  std::string file;                   ///< where that file was written; empty: nowhere
  std::string command;                ///< repeats it
  std::string from_case;              ///< id of the case it was shrunk from
  std::vector<WrongPixel> pixels;     ///< at most k_max_example_pixels, lowest rows first
  std::uint64_t wrong_pixels = 0;     ///< all of them
  Framebuffer expected, got;          ///< both empty where there was no picture (a crash)
  /// Polygon that is nearest at each pixel, -1 for none; parallel to the pixels of `expected`.
  std::vector<std::int32_t> owners;
  int renders = 0;      ///< drawings that shrinking took
  bool alone = false;   ///< the drawing as a flat file shows the finding; else only its case does
  bool shrunk = false;  ///< false: shown as the corpus has it
};
constexpr std::size_t k_max_example_pixels = 256;

/// One cause, reported once.
struct Finding {
  std::string verdict;  ///< "fill.rule", "depth.none" ...: the list is in docs/check.md
  std::string detail;   ///< what the verdict's star stands for: "lt", "rb"; "x 2 y -1"; often empty
  Severity severity = Severity::error;
  std::string message;      ///< one sentence with the numbers in it
  std::string hint;         ///< the remedy
  std::uint64_t count = 0;  ///< wrong samples; for verdicts without samples the number of cases
  std::uint64_t explained = 0, total = 0;   ///< of `total` wrong samples the named cause explains `explained`
  std::vector<std::string> case_ids;        ///< all that show it, in order of the corpus
  std::vector<Example> examples;            ///< at most 3, best one first; only the first is shrunk
  std::vector<std::string> trace;           ///< of a crash: innermost first, hints
  std::optional<std::uint32_t> at_polygon;  ///< of a crash: number within the frame
};

enum class CaseStatus { passed, failed, warned, skipped };

struct CaseResult {
  std::string id;       ///< family/name#index@seed
  std::string purpose;  ///< one sentence
  CaseStatus status = CaseStatus::passed;
  std::string reason;  ///< of a skip
  std::vector<std::string> verdicts;
  std::uint64_t judged = 0, wrong = 0, ambiguous = 0;  ///< samples
  double milliseconds = 0;  ///< drawing and judging; cases of a sheet share its time evenly
};

struct FamilyResult {
  std::string name;  ///< "smoke", "cov", "tile", ...
  std::uint64_t passed = 0, failed = 0, warned = 0, skipped = 0;
  std::uint64_t judged = 0, wrong = 0, ambiguous = 0;
  double milliseconds = 0;
  std::string skip_reason;  ///< of a family that was not run at all
};

/// How often boundary samples of a kind were drawn, over all single polygons of family `cov`.
struct FingerprintRow {
  std::string kind;  ///< "left", "right", "bottom", "top", "minimum", "maximum", "through"
  std::uint64_t owned = 0, cases = 0;
};
struct RuleFingerprint {
  std::string required = "lb";
  std::string named;                  ///< rule without any disagreement; empty: none
  std::string closest;                ///< best rule that explains at least 95% of the wrong samples
  double closest_explains = 0;        ///< 0..1
  std::vector<FingerprintRow> table;  ///< seven rows
};

struct PluginFacts {
  std::string kind;      ///< "library", "python", "command", "internal", "images"
  std::string argument;  ///< as given on the command line
  std::string name, summary, sha256;
  std::vector<std::string> wants;  ///< "triangles", ...
  std::string abi;                 ///< "1.0"; empty where it has none
};

struct RunFacts {
  std::string program_version, compiler, system, processor;
  std::string command;  ///< repeats the run
  std::string level;    ///< "quick", "default", "thorough"
  std::uint64_t seed = 1;
  std::string corpus_hash;  ///< 16 hexadecimal digits
  std::string rule = "lb", precision = "default";
  std::vector<std::string> isolation;  ///< layers that held
  bool in_process = false;
  int workers = 1;
  double time_seconds = 0;
  std::string started;               ///< UTC, ISO 8601
  std::string output, error_output;  ///< what the rasterizer printed, bounded
};

/// Largest error seen of a depth or a colour, as the precision class of the rasterizer. Depths that are
/// probed lie in an interval of length 1: the error is the distance to that.
struct Precision {
  double worst_depth = 0, worst_color = 0;
  std::string depth_class,
      color_class;  ///< "exact", "nearest", "within 1", "drift", "wrong"; empty: not measured
};

struct Summary {
  std::string verdict;  ///< "pass", "pass.other-rule", "fail", "interrupted"
  double score = 0;     ///< 0..100: mean over families of their passed share
  std::uint64_t cases = 0, failed = 0, warned = 0, skipped = 0;
  std::uint64_t judged = 0, wrong = 0, ambiguous = 0;
  std::uint64_t renders = 0;
  Precision precision;
};

/// A measured curve or ratio of family `perf`.
struct PerfResult {
  std::string name;
  std::vector<double> sizes, seconds, reference_seconds;
  double slope = 0, slope_low = 0, slope_high = 0;
  double ratio = 0, ratio_low = 0, ratio_high = 0;  ///< to the shipped z-buffer
};

struct CheckResult {
  PluginFacts plugin;
  RunFacts run;
  Summary summary;
  RuleFingerprint rule_fingerprint;
  std::vector<Finding> findings;  ///< errors first, then by family order
  std::vector<FamilyResult> families;
  std::vector<CaseResult> cases;
  std::vector<PerfResult> perf;
  std::vector<std::string> notes;  ///< what a reader should know: depth not judged because ...

  bool has_errors() const;
};

/// "E fill.rule lt  312 samples  cov/tri4#17@1": severity, verdict, detail (or "-"), two blanks, count and
/// its unit ("samples" or "cases"), two blanks, the first case. One line, stable, for programs.
std::string finding_line(const Finding& finding);

}  // namespace farop::conformance
