// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "check_reports.h"
#include "check_subjects.h"
#include "command_line.h"
#include "core/output_file.h"
#include "core/word_reader.h"
#include "export/flat_reader.h"
#include "version.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;
using namespace conformance;

struct CheckCommand {
  std::string rasterizer;
  RasterizerOptions options;
  bool quick = false, thorough = false, list = false, beyond = false;
  std::uint64_t seed = 1;
  std::vector<std::string> families, cases;
  std::string accepted = "lb", precision = "default", examples, emit, images;
  CheckReports reports;
};

/// The polygons of a flat file as a case.
class FlatCase : public ScreenPolygonSink {
 public:
  Drawing drawing;
  void begin_frame(const ScreenFrame& frame) override { drawing.frame = frame.resolution; }
  void polygons(const ScreenPolygonBatch& batch) override {
    for (const ScreenPolygonRecord& record : batch.polygons) {
      const auto corners = batch.corners(record);
      drawing.polygons.emplace_back(corners.begin(), corners.end());
    }
  }
  void end_frame() override {}
};

Case case_of_file(Session& session, const std::string& file) {
  FlatCase flat;
  WordReader reader(file);
  if (!read_flat(reader, session.console, flat, {})) throw Error(ExitStatus::input, "");
  Case c;
  c.family = "depth", c.name = "file", c.seed = 0;
  c.purpose = "The polygons of " + printable(file, 200) + ".";
  c.kind = CaseKind::picture, c.expect_nothing_ambiguous = false;
  c.drawings.push_back(std::move(flat.drawing));
  return c;
}

bool wanted(const Case& c, const std::vector<std::string>& names) {
  return names.empty() ||
         std::ranges::any_of(names, [&](const std::string& n) { return n == c.family || n == c.group(); });
}

std::vector<Case> chosen_cases(Session& session, const CheckCommand& command) {
  const CorpusOptions corpus_options{command.quick      ? Level::quick
                                     : command.thorough ? Level::thorough
                                                        : Level::normal,
                                     command.seed, command.beyond};
  std::vector<Case> all = make_corpus(corpus_options);
  for (const std::string& name : command.families) {
    if (std::ranges::any_of(all, [&](const Case& c) { return c.family == name || c.group() == name; }))
      continue;
    std::string known;
    for (const FamilyFacts& f : corpus_families()) known += (known.empty() ? "" : ", ") + std::string(f.name);
    throw Error(ExitStatus::usage, fmt::format("--family: no family is called '{}'", printable(name)),
                "families are " + known + "; `farop check --list` shows all cases");
  }
  std::vector<Case> chosen;
  for (const std::string& name : command.cases) {
    if (fs::exists(name)) {
      chosen.push_back(case_of_file(session, name));
      continue;
    }
    const auto found = std::ranges::find_if(
        all, [&](const Case& c) { return c.id() == name || c.id().starts_with(name + "@"); });
    if (found == all.end())
      throw Error(ExitStatus::usage,
                  fmt::format("--case: '{}' is neither a case nor a file", printable(name)),
                  "`farop check --list` shows all cases");
    chosen.push_back(*found);
  }
  if (!command.cases.empty()) return chosen;
  for (Case& c : all) {
    if (wanted(c, command.families)) chosen.push_back(std::move(c));
  }
  return chosen;
}

std::string list_of(const std::vector<Case>& cases) {
  std::string text;
  for (const Case& c : cases) text += fmt::format("{:<28} {}\n", c.id(), c.purpose);
  return text;
}

std::string command_for(const CheckCommand& command, const std::string& file) {
  const std::string what =
      command.options.command.empty() ? command.rasterizer : "--cmd '" + command.options.command + "'";
  return fmt::format("farop check --case {} {}", file, what);
}

/// The first example of each finding as a flat file.
void write_examples(const CheckCommand& command, CheckResult& result) {
  if (command.examples.empty()) return;
  std::error_code error;
  fs::create_directories(command.examples, error);
  std::map<std::string, int> used;
  for (Finding& f : result.findings) {
    if (f.examples.empty() || f.examples.front().flat.empty() || f.severity == conformance::Severity::none)
      continue;
    conformance::Example& e = f.examples.front();
    const int n = ++used[f.verdict];
    e.file =
        (fs::path(command.examples) / (n == 1 ? f.verdict + ".scr" : fmt::format("{}-{}.scr", f.verdict, n)))
            .string();
    e.command = command_for(command, e.file);
    OutputFile file(e.file);
    file.write(e.flat);
    file.commit();
  }
}

/// Cells of two characters: expected and delivered side by side, wrong samples marked.
std::string cells(const conformance::Example& e, bool colored) {
  if (e.got.rgb.empty() || e.pixels.empty()) return {};
  int x0 = e.pixels.front().x, x1 = x0, y0 = e.pixels.front().y, y1 = y0;
  for (const WrongPixel& p : e.pixels)
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  x0 = std::max(0, x0 - 2), y0 = std::max(0, y0 - 2);
  x1 = std::min({e.frame.x - 1, x1 + 2, x0 + 15}), y1 = std::min({e.frame.y - 1, y1 + 2, y0 + 11});
  std::string text = fmt::format("    {:<{}}   {}\n", "expected", 2 * (x1 - x0 + 1), "yours");
  for (int y = y1; y >= y0; --y) {
    text += fmt::format("{:>3} ", y);
    for (const bool mine : {false, true}) {
      for (int x = x0; x <= x1; ++x) {
        const Color c = pixel_at(mine ? e.got : e.expected, x, y);
        const auto wrong =
            std::ranges::find_if(e.pixels, [&](const WrongPixel& p) { return p.x == x && p.y == y; });
        const bool empty = c == e.background;
        const char* mark = empty ? ". " : "# ";
        if (mine && wrong != e.pixels.end())
          mark = wrong->kind == "missing" ? "<>" : wrong->kind == "extra" ? "++" : "!!";
        if (colored) {
          text += fmt::format("\033[48;2;{};{};{}m\033[97m{}\033[0m", c[0], c[1], c[2],
                              mine && wrong != e.pixels.end() ? mark : "  ");
        } else {
          text += mark;
        }
      }
      text += mine ? "\n" : "   ";
    }
  }
  return text + fmt::format("    columns {} to {};  <> missing, ++ too many, !! other\n", x0, x1);
}

std::string report_of(const CheckResult& result, bool colored) {
  std::string text;
  for (const Finding& f : result.findings) text += finding_line(f) + "\n";
  bool first = true;
  for (const Finding& f : result.findings) {
    text += fmt::format("\n{} {}: {}\n", f.verdict, f.detail, f.message);
    if (!f.hint.empty()) text += fmt::format("  hint: {}\n", f.hint);
    for (const std::string& line : f.trace) text += fmt::format("  at {}\n", line);
    if (f.examples.empty()) continue;
    const conformance::Example& e = f.examples.front();
    if (first) {
      text += cells(e, colored);
      first = e.pixels.empty();
    }
    if (!e.file.empty()) text += fmt::format("  repeat: {}\n", e.command);
  }
  const Summary& s = result.summary;
  text += fmt::format("{}{}: {} cases, {} failed, {} skipped; {} samples judged, {} wrong, {} open\n",
                      text.empty() ? "" : "\n", s.verdict, s.cases, s.failed, s.skipped, s.judged, s.wrong,
                      s.ambiguous);
  for (const FamilyResult& f : result.families) {
    text += fmt::format("  {:<7} {:>6} passed {:>5} failed {:>5} skipped{}\n", f.name, f.passed + f.warned,
                        f.failed, f.skipped, f.skip_reason.empty() ? "" : "  (" + f.skip_reason + ")");
  }
  for (const std::string& note : result.notes) text += "note: " + note + "\n";
  return text;
}

void run(Session& session, CheckCommand command) {
  if (command.list) {
    OutputFile out("-");
    out.write(list_of(chosen_cases(session, command)));
    out.commit();
    return;
  }
  if (command.quick && command.thorough)
    throw Error(ExitStatus::usage, "--quick and --thorough are both given", "give one");
  const bool named = !command.rasterizer.empty() || !command.options.command.empty();
  const bool elsewhere = !command.emit.empty() || !command.images.empty();
  if (named && elsewhere)
    throw Error(ExitStatus::usage, "a rasterizer and --emit or --images are both given", "give one");
  if (!command.emit.empty() && !command.images.empty())
    throw Error(ExitStatus::usage, "--emit and --images are both given", "give one after the other");
  if (!named && !elsewhere) {
    throw Error(ExitStatus::usage, "no rasterizer is given",
                "name a library, a Python script, a rasterizer of `farop plugins`, or --cmd");
  }
  if (!command.rasterizer.empty()) command.options.name = command.rasterizer;
  const ChosenRasterizer chosen = choose_rasterizer(command.options);
  const std::vector<Case> cases = chosen_cases(session, command);
  begin_check_reports(command.reports);
  const auto begun = std::chrono::steady_clock::now();
  const std::unique_ptr<SubjectMaker> maker =
      !command.emit.empty()     ? make_emitter(command.emit)
      : !command.images.empty() ? make_picture_reader(command.images)
                                : make_subjects(session, chosen, command.options, command.seed);
  CheckOptions options;
  options.accepted_rule = command.accepted;
  options.precision = command.precision == "nearest" ? Precision_ask::nearest
                      : command.precision == "exact" ? Precision_ask::exact
                                                     : Precision_ask::normal;
  options.workers = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
  options.progress = session.console.progress("checking");
  CheckResult result = run_check(cases, *maker, options);
  session.console.end_progress();
  if (!command.emit.empty()) {
    session.console.summary("{}: the flat files of {} cases; draw each as .ppm beside it, then --images {}",
                            command.emit, cases.size(), command.emit);
    return;
  }
  if (command.images.empty()) {
    result.plugin = describe_subject(chosen, command.options, result.run.isolation);
  } else {
    result.plugin.kind = "images",
    result.plugin.argument = result.plugin.name = printable(command.images, 4096);
  }
  result.run.command = fmt::format(
      "farop check {} --seed {}{}{}",
      command.options.command.empty() ? command.rasterizer : "--cmd '" + command.options.command + "'",
      command.seed,
      command.quick      ? " --quick"
      : command.thorough ? " --thorough"
                         : "",
      command.accepted == "lb" ? "" : " --accept-rule \"" + command.accepted + "\"");
  for (const std::string& name : command.families) result.run.command += " --family " + name;
  for (const std::string& name : command.cases) result.run.command += " --case '" + name + "'";
  result.run.program_version = k_version;
  result.run.level = command.quick ? "quick" : command.thorough ? "thorough" : "default";
  result.run.seed = command.seed;
  result.run.corpus_hash = fmt::format("{:016x}", corpus_hash(cases));
  result.run.rule = command.accepted, result.run.precision = command.precision;
  result.run.in_process = command.options.in_process, result.run.workers = options.workers;
  result.run.time_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  write_examples(command, result);
  write_check_reports(command.reports, result);
  OutputFile out(command.reports.to_stdout() ? "/dev/null" : "-");
  out.write(report_of(result, session.options.color == "always" ||
                                  (session.options.color == "auto" && ::isatty(STDOUT_FILENO) != 0)));
  out.commit();
  session.console.summary("{}: {} cases ({:.2f} s)", result.plugin.name, result.summary.cases,
                          result.run.time_seconds);
  if (result.has_errors()) throw Error(ExitStatus::input, "");
}

}  // namespace

void add_check(CommandLine& line) {
  const auto options = std::make_shared<CheckCommand>();
  CLI::App& command =
      line.add_command("check", "is a rasterizer right, and if not, why",
                       {{"farop check trapezoid --quick", "smoke test and every small polygon, in a second"},
                        {"farop check internal --family depth", "one family of cases"}},
                       [options](Session& session) { run(session, *options); });
  command.add_option("rasterizer", options->rasterizer, "yours, or a name that `farop plugins` shows")
      ->type_name("NAME|FILE.so|FILE.py")
      ->group("Input");
  command.add_option("--emit", options->emit, "only write the flat files, for a rasterizer elsewhere")
      ->type_name("DIR")
      ->group("Input");
  command.add_option("--images", options->images, "check the pictures that were made of them")
      ->type_name("DIR")
      ->group("Input");
  const auto cases = [](CLI::Option* option) { return option->group("Cases"); };
  cases(command.add_flag("--quick", options->quick, "smoke test and exhaustive sheets"));
  cases(command.add_flag("--thorough", options->thorough, "50 times as many random cases"));
  cases(command.add_option("--family", options->families, "only these: smoke, cov, tile/fan ...")
            ->type_name("NAME")
            ->expected(1)
            ->take_all());
  cases(command.add_option("--case", options->cases, "only these: an id of --list, or a flat file")
            ->type_name("ID|FILE")
            ->expected(1)
            ->take_all());
  cases(command.add_option("--seed", options->seed, "of the random cases [1]")->type_name("N"));
  cases(command.add_flag("--list", options->list, "print the cases with their reasons, and stop"));
  cases(command.add_flag("--beyond-contract", options->beyond, "also what may break it: must not crash"));
  const auto judging = [](CLI::Option* option) { return option->group("Judging"); };
  judging(
      command.add_option("--accept-rule", options->accepted, "fill rule that passes [lb: left and bottom]")
          ->check(CLI::IsMember({"lb", "lt", "rb", "rt", "lb'", "lt'", "rb'", "rt'", "lb+min"}))
          ->type_name("RULE"));
  judging(command.add_option("--precision", options->precision, "of depth and colour [default]")
              ->check(CLI::IsMember({"default", "nearest", "exact"}))
              ->type_name("default|nearest|exact"));
  judging(command.add_option("--examples", options->examples, "write the smallest drawings that fail there")
              ->type_name("DIR"));
  add_check_reports(command, options->reports);
  RasterizerOptions& r = options->options;
  add_rasterizer_options(command, r);
  command.remove_option(command.get_option("--rasterizer"));
  line.add_report_options(command);
}

}  // namespace farop::app
