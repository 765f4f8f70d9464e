// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/check.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

#include "check_causes.h"
#include "check_reports.h"
#include "check_scenes.h"
#include "check_subjects.h"
#include "command_line.h"
#include "conformance_report/terminal_report.h"
#include "core/output_file.h"
#include "core/word_reader.h"
#include "drawing_recorder.h"
#include "export/flat_reader.h"
#include "stop_signals.h"
#include "version.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;
using namespace conformance;

struct CheckCommand {
  std::string rasterizer;
  RasterizerOptions options;
  bool quick = false, thorough = false, list = false, beyond = false, shrink = true;
  std::uint64_t seed = 1;
  std::vector<std::string> families, cases;
  std::string regress;
  std::optional<double> perf_limit;
  std::string accepted = "lb", precision = "default", examples, emit, images;
  CheckReports reports;
};

/// Id of a case that is a flat file.
constexpr const char* k_file_case = "depth/file#0@0";

Case case_of_file(Session& session, const std::string& file) {
  DrawingRecorder flat;
  WordReader reader(file);
  if (!read_flat(reader, session.console, flat, {})) throw Error(ExitStatus::input, "");
  Case c;
  c.family = "depth", c.name = "file", c.seed = 0;
  c.purpose = "The polygons of " + printable(file, 200) + ".";
  c.kind = CaseKind::file, c.expect_nothing_ambiguous = false;
  c.drawings.push_back(std::move(flat.drawing));
  return c;
}

bool wanted(const Case& c, const std::vector<std::string>& names) {
  return names.empty() ||
         std::ranges::any_of(names, [&](const std::string& n) { return n == c.family || n == c.group(); });
}

/// Flat files of a folder, by name: cases that are run right after smoke.
void add_regressions(Session& session, const std::string& folder, std::vector<Case>& all) {
  if (!fs::is_directory(folder))
    throw Error(ExitStatus::input, fmt::format("--regress: {}: is no folder", printable(folder, 4096)),
                "it takes a folder of flat files (.scr)");
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".scr") files.push_back(entry.path().string());
  }
  std::ranges::sort(files);
  for (const std::string& file : files) {
    Case c = case_of_file(session, file);
    c.family = "regress", c.name = printable(fs::path(file).stem().string(), 100);
    all.push_back(std::move(c));
  }
}

std::vector<Case> chosen_cases(Session& session, const CheckCommand& command) {
  const Level level = command.quick ? Level::quick : command.thorough ? Level::thorough : Level::normal;
  const CorpusOptions corpus_options{level, command.seed, command.beyond, check_scenes(level)};
  std::vector<Case> all = make_corpus(corpus_options);
  if (!command.regress.empty()) add_regressions(session, command.regress, all);
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

/// A word as a shell takes it.
std::string shell_word(const std::string& word) {
  constexpr std::string_view k_plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%{}";
  if (!word.empty() && word.find_first_not_of(k_plain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// What is checked, as the command line names it.
std::string subject_words(const CheckCommand& command) {
  const RasterizerOptions& r = command.options;
  if (!command.images.empty()) return " --images " + shell_word(command.images);
  std::string text =
      " " + (r.command.empty() ? shell_word(command.rasterizer) : "--cmd " + shell_word(r.command));
  for (const std::string& folder : r.folders) text += " -I " + shell_word(folder);
  for (const std::string& pair : r.key_values) text += " --plugin-option " + shell_word(pair);
  if (r.threads > 0) text += fmt::format(" --threads {}", r.threads);
  return text + (r.in_process ? " --in-process" : "");
}

/// How pictures are judged.
std::string judging_words(const CheckCommand& command) {
  std::string text;
  if (command.accepted != "lb") text += " --accept-rule " + shell_word(command.accepted);
  if (command.precision != "default") text += " --precision " + command.precision;
  return text;
}

/// Repeats one example: from its flat file, or, where that shows nothing alone, as a case.
std::string command_for(const CheckCommand& command, const conformance::Example& e) {
  std::string text = "farop check --case " + shell_word(e.file.empty() || !e.alone ? e.from_case : e.file) +
                     subject_words(command) + judging_words(command);
  if (!e.file.empty() && e.alone) return text;
  if (command.seed != CorpusOptions{}.seed) text += fmt::format(" --seed {}", command.seed);
  if (command.thorough) text += " --thorough";
  if (command.beyond) text += " --beyond-contract";
  return text;
}

/// Repeats the whole run.
std::string repeat_command(const CheckCommand& command) {
  std::string text = "farop check" + subject_words(command) + fmt::format(" --seed {}", command.seed);
  if (command.quick) text += " --quick";
  if (command.thorough) text += " --thorough";
  if (command.beyond) text += " --beyond-contract";
  text += judging_words(command);
  if (command.perf_limit) text += fmt::format(" --perf-limit {}", *command.perf_limit);
  if (!command.regress.empty()) text += " --regress " + shell_word(command.regress);
  for (const std::string& name : command.families) text += " --family " + shell_word(name);
  for (const std::string& name : command.cases) text += " --case " + shell_word(name);
  return text;
}

/// All but what is measured while it runs.
RunFacts facts_of(const CheckCommand& command, const std::vector<Case>& cases) {
  RunFacts facts;
  facts.program_version = k_version, facts.compiler = compiler_name();
  facts.system = system_name(), facts.processor = processor_name(), facts.started = time_now();
  facts.command = repeat_command(command);
  facts.level = command.quick ? "quick" : command.thorough ? "thorough" : "default";
  facts.seed = command.seed, facts.corpus_hash = fmt::format("{:016x}", corpus_hash(cases));
  facts.rule = command.accepted, facts.precision = command.precision;
  facts.in_process = command.options.in_process;
  facts.workers = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
  return facts;
}

CheckOptions check_options(const CheckCommand& command, const RunFacts& facts) {
  CheckOptions options;
  options.accepted_rule = command.accepted;
  options.precision = command.precision == "nearest" ? PrecisionAsk::nearest
                      : command.precision == "exact" ? PrecisionAsk::exact
                                                     : PrecisionAsk::normal;
  options.workers = facts.workers, options.shrink = command.shrink;
  return options;
}

/// The first example of each finding as a flat file.
void write_examples(const CheckCommand& command, CheckResult& result) {
  for (Finding& f : result.findings) {
    for (conformance::Example& e : f.examples) {
      const bool of_corpus = e.from_case != k_file_case && !e.from_case.starts_with("regress/");
      if (of_corpus) e.command = command_for(command, e);
    }
  }
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
    e.command = command_for(command, e);
    OutputFile file(e.file);
    file.write(e.flat);
    file.commit();
  }
}

/// Looks for causes by running again what failed.
void explain(Session& session, const CheckCommand& command, const ChosenRasterizer& chosen,
             const std::vector<Case>& cases, const CheckOptions& options, CheckResult& result) {
  const CheckedRun run{session, chosen, command.options, options, command.seed};
  blame_threads(run, cases, result);
  // A case that is named with its seed is not there under another one.
  const auto has_seed = [](const std::string& name) { return name.find('@') != std::string::npos; };
  if (!result.has_errors() || command.seed == CorpusOptions{}.seed ||
      std::ranges::any_of(command.cases, has_seed))
    return;
  CheckCommand usual = command;
  usual.seed = CorpusOptions{}.seed;
  note_seed_dependence(run, chosen_cases(session, usual), result);
}

void refuse_contradictions(const CheckCommand& command) {
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
}

void tell(const Session& session, const CheckReports& reports, const CheckResult& result) {
  write_check_reports(reports, result);
  if (reports.to_stdout()) return;
  const bool colored =
      session.options.color == "always" || (session.options.color == "auto" && ::isatty(STDOUT_FILENO) != 0);
  OutputFile out("-");
  out.write(conformance_report::to_terminal(result, reports.words(), colored));
  out.commit();
}

void run(Session& session, CheckCommand command) {
  if (command.list) {
    OutputFile out("-");
    out.write(list_of(chosen_cases(session, command)));
    out.commit();
    return;
  }
  refuse_contradictions(command);
  if (!command.rasterizer.empty()) command.options.name = command.rasterizer;
  const ChosenRasterizer chosen = choose_rasterizer(command.options);
  const std::vector<Case> cases = chosen_cases(session, command);
  begin_check_reports(command.reports);
  const auto begun = std::chrono::steady_clock::now();
  RunFacts facts = facts_of(command, cases);
  PrintedLines printed;
  const std::unique_ptr<SubjectMaker> maker =
      !command.emit.empty()     ? make_emitter(command.emit)
      : !command.images.empty() ? make_picture_reader(command.images)
                                : make_subjects(session, chosen, command.options, command.seed, printed);
  CaseLines lines(command.reports, facts.corpus_hash);
  CheckOptions options = check_options(command, facts);
  PrintedLines not_told;
  const std::unique_ptr<SubjectMaker> reference =
      maker->timed() ? make_reference(session, command.options, not_told) : nullptr;
  if (command.perf_limit && !reference)
    throw Error(ExitStatus::usage, "--perf-limit: there is nothing to compare the times with",
                "it takes a library, and trapezoid beside it (farop plugins)");
  options.reference = reference.get(), options.perf_limit = command.perf_limit;
  const StopSignals signals;
  options.interrupted = [] { return StopSignals::came(); };
  options.progress = session.console.progress("checking");
  if (!command.reports.jsonl.empty()) options.finished = [&lines](const CaseResult& c) { lines.add(c); };
  if (command.emit.empty() && command.images.empty()) {
    options.explain = [&](CheckResult& result) {
      if (!StopSignals::came()) explain(session, command, chosen, cases, options, result);
    };
  }
  CheckResult result = run_check(cases, *maker, options);
  session.console.end_progress();
  const bool stopped = StopSignals::came();
  if (!command.emit.empty()) {
    session.console.summary("{}: the flat files of {} cases; draw each as .ppm beside it, then --images {}",
                            command.emit, cases.size(), command.emit);
    return;
  }
  if (command.images.empty()) {
    result.plugin = describe_subject(chosen, command.options, facts.isolation);
  } else {
    result.plugin.kind = "images",
    result.plugin.argument = result.plugin.name = printable(command.images, 4096);
  }
  facts.output = printed.text();
  facts.time_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  result.run = std::move(facts);
  write_examples(command, result);
  tell(session, command.reports, conformance_report::translated(result, command.reports.words()));
  session.console.summary("{}: {} cases ({:.2f} s)", result.plugin.name, result.summary.cases,
                          result.run.time_seconds);
  if (stopped) {
    throw Error(ExitStatus::surroundings, "stopped by a signal: the report is about what was done before",
                "cases that were not reached are marked as skipped");
  }
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
            ->take_all()
            ->allow_extra_args(false));
  cases(command.add_option("--case", options->cases, "only these: an id of --list, or a flat file")
            ->type_name("ID|FILE")
            ->expected(1)
            ->take_all()
            ->allow_extra_args(false));
  cases(command.add_option("--regress", options->regress, "also the flat files of this folder, after smoke")
            ->type_name("DIR"));
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
  judging(command
              .add_option("--perf-limit", options->perf_limit,
                          "times as long as `trapezoid` may it take; longer is an error")
              ->check(CLI::PositiveNumber)
              ->type_name("RATIO"));
  judging(command.add_flag("--shrink,!--no-shrink", options->shrink,
                           "look for the smallest drawing that fails [yes]"));
  judging(command.add_option("--examples", options->examples, "write the smallest drawings that fail there")
              ->type_name("DIR"));
  add_check_reports(command, options->reports);
  RasterizerOptions& r = options->options;
  add_rasterizer_options(command, r);
  command.remove_option(command.get_option("--rasterizer"));
  line.add_report_options(command);
}

}  // namespace farop::app
