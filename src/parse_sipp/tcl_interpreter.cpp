// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/tcl_interpreter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <new>
#include <set>

#include "core/error.h"
#include "parse_sipp/script_error_internal.h"

namespace farop::sipp {
namespace {

/// All that stays of Tcl; everything else is removed, whatever a version of Tcl brings along.
constexpr std::string_view k_kept_commands[] = {
    "append", "apply",    "array",    "binary",   "break",    "catch",   "concat",  "continue", "coroutine",
    "dict",   "error",    "eval",     "expr",     "for",      "foreach", "format",  "global",   "if",
    "incr",   "info",     "join",     "lappend",  "lassign",  "lindex",  "linsert", "list",     "llength",
    "lmap",   "lrange",   "lrepeat",  "lreplace", "lreverse", "lsearch", "lset",    "lsort",    "namespace",
    "proc",   "regexp",   "regsub",   "rename",   "return",   "scan",    "set",     "split",    "string",
    "subst",  "switch",   "tailcall", "throw",    "time",     "trace",   "try",     "unset",    "uplevel",
    "upvar",  "variable", "while",    "yield",    "yieldto"};

/// Words of Tcl that are answered with the reason why they are missing.
constexpr std::string_view k_refused_commands[] = {
    "after",    "bgerror",    "cd",      "chan",      "close",  "encoding", "eof",     "exec",
    "fblocked", "fconfigure", "fcopy",   "fileevent", "gets",   "glob",     "history", "interp",
    "load",     "open",       "pid",     "pwd",       "read",   "seek",     "socket",  "system",
    "tell",     "thread",     "unknown", "unlink",    "unload", "update",   "vwait",   "zlib"};
constexpr const char* k_refused_hint =
    "a scene script has no files (but for source), programs, network, timers or other interpreters";

constexpr std::size_t k_longest_line = 500;
constexpr std::size_t k_most_callers = 3;
constexpr int k_most_frames = 100'000;
constexpr int k_most_open_sources = 50;

/// Tcl evaluated for a command failed and has said why.
struct ErrorInside {};

std::string tail_of(std::string_view qualified) {
  const std::size_t at = qualified.rfind("::");
  return std::string(at == std::string_view::npos ? qualified : qualified.substr(at + 2));
}

std::string_view first_word(std::string_view text) {
  return text.substr(0, text.find_first_of(" \t\n;"));
}

std::string_view first_line(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\n");
  if (begin == std::string_view::npos) return {};
  text.remove_prefix(begin);
  return text.substr(0, text.find('\n'));
}

/// Where `word` stands in `line`, from `from` on; npos also where several words could be meant.
std::size_t only_place(std::string_view line, std::string_view word, std::size_t from) {
  const auto joins = [&](std::size_t at) {
    return at < line.size() && (std::isalnum(static_cast<unsigned char>(line[at])) != 0 || line[at] == '_' ||
                                line[at] == '.' || line[at] == '-');
  };
  std::size_t found = std::string_view::npos;
  for (std::size_t at = line.find(word, from); at != std::string_view::npos; at = line.find(word, at + 1)) {
    if ((at > 0 && joins(at - 1)) || joins(at + word.size())) continue;
    if (found != std::string_view::npos) return std::string_view::npos;
    found = at;
  }
  return found;
}

/// Which argument, from 1, has the text `word`, or has it inside; 0 where none has, nothing where several
/// have.
std::optional<std::size_t> argument_of(TclInterpreter::Words arguments, const std::string& word) {
  for (const bool whole : {true, false}) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (arguments[i]->bytes == nullptr) continue;  // was never text: no message quotes it
      const std::string_view text = text_of(arguments[i]);
      if (whole ? text != word : text.find(word) == std::string_view::npos) continue;
      if (found > 0) return std::nullopt;
      found = i + 1;
    }
    if (found > 0) return found;
  }
  return 0;
}

/// How an argument, from 1, of the command that begins at `command` is written in `line`. Empty where the
/// line does not tell.
std::string_view written_argument(std::string_view line, std::size_t command, std::size_t argument) {
  const int nested = command > 0 && line[command - 1] == '[' ? 1 : 0;
  std::string_view text = line.substr(command);
  if (text.ends_with('\\')) text.remove_suffix(1);  // goes on in the next line
  Tcl_Parse parse;
  if (Tcl_ParseCommand(nullptr, text.data(), static_cast<int>(text.size()), nested, &parse) != TCL_OK)
    return {};
  std::string_view written;
  const Tcl_Token* token = parse.tokenPtr;
  for (std::size_t i = 0; i < static_cast<std::size_t>(parse.numWords); ++i) {
    if (token->type == TCL_TOKEN_EXPAND_WORD) break;  // {*}: several arguments
    if (i == argument)
      written = text.substr(static_cast<std::size_t>(token->start - text.data()),
                            static_cast<std::size_t>(token->size));
    token += token->numComponents + 1;
  }
  Tcl_FreeParse(&parse);
  return written;
}

/// Of Tcl's complaint about a variable that has no value: its name. Otherwise empty.
std::string unset_variable(std::string_view message) {
  constexpr std::string_view k_start = "can't read \"", k_end = "\": no such variable";
  if (!message.starts_with(k_start) || !message.ends_with(k_end)) return {};
  message.remove_prefix(k_start.size());
  message.remove_suffix(k_end.size());
  return std::string(message);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

/// One level of Tcl's account of an error: a command, and the texts around it.
struct InfoEntry {
  std::string_view command;
  struct Context {
    std::string_view kind, name;  ///< `procedure "leg"`, `file "a.tcl"`; anything else is a body
    int line = 0;                 ///< of the command in that text
  };
  std::vector<Context> contexts;  ///< innermost first
};

InfoEntry::Context context_of(std::string_view line) {
  InfoEntry::Context context;
  const std::size_t end = line.rfind(" line ");
  if (end == std::string_view::npos) return context;
  context.line = std::atoi(std::string(line.substr(end + 6)).c_str());
  const std::size_t quote = line.find('"'), last = line.rfind('"', end);
  if (quote != std::string_view::npos && last > quote)
    context.name = line.substr(quote + 1, last - quote - 1);
  for (const std::string_view kind : {"procedure", "file"}) {
    if (line.starts_with(fmt::format("({} ", kind))) context.kind = kind;
  }
  return context;
}

/// Innermost first.
std::vector<InfoEntry> entries_of(std::string_view info) {
  constexpr std::string_view k_first = "\n    while executing\n\"", k_next = "\n    invoked from within\n\"";
  std::vector<InfoEntry> entries;
  std::size_t at = info.find(k_first);
  std::size_t skip = k_first.size();
  if (at == std::string_view::npos) at = info.find(k_next), skip = k_next.size();
  while (at != std::string_view::npos && entries.size() < 10'000) {
    info.remove_prefix(at + skip);
    at = info.find(k_next), skip = k_next.size();
    std::string_view part = info.substr(0, at);
    InfoEntry entry;
    const std::size_t end = part.find("\"\n    (");
    entry.command = part.substr(0, end == std::string_view::npos ? part.rfind('"') : end);
    part = end == std::string_view::npos ? std::string_view() : part.substr(end + 2);
    while (!part.empty()) {
      const std::string_view line = first_line(part);
      const InfoEntry::Context context = context_of(line);
      if (context.line > 0) entry.contexts.push_back(context);
      part.remove_prefix(std::min(part.size(), part.find(line) + line.size() + 1));
      if (line.empty()) break;
    }
    entries.push_back(entry);
  }
  return entries;
}

}  // namespace

TclInterpreter::TclInterpreter(const ScriptLimits& limits, ScriptFiles& files,
                               std::function<void(const std::string&)> log)
    : files_(files), log_(std::move(log)), limits_(limits) {
  Tcl_FindExecutable(nullptr);
  // No Tcl_Init(): the library of Tcl scripts on the disk (auto-loading, packages) is never looked at.
  interp_ = Tcl_CreateInterp();
  if (interp_ == nullptr || Tcl_MakeSafe(interp_) != TCL_OK) {
    throw Error(ExitStatus::internal, "Tcl cannot make a safe interpreter");
  }
  Tcl_GetCommandInfo(interp_, "::tcl::info::frame", &frame_info_);
  Tcl_GetCommandInfo(interp_, "proc", &original_proc_);
  remove_commands();
  Tcl_CreateObjCommand(interp_, "proc", define_procedure, this, nullptr);
  add_host_commands();
}

TclInterpreter::~TclInterpreter() {
  if (interp_ != nullptr) Tcl_DeleteInterp(interp_);
}

void TclInterpreter::remove_commands() {
  const std::set<std::string_view> kept(std::begin(k_kept_commands), std::end(k_kept_commands));
  Tcl_Eval(interp_, "info commands ::*");
  const TclValue names(Tcl_GetObjResult(interp_));
  for (Tcl_Obj* name : list(names.get(), "commands")) {
    const std::string tail = tail_of(text_of(name));
    if (!kept.contains(tail)) Tcl_DeleteCommand(interp_, ("::" + tail).c_str());
  }
  Tcl_Eval(interp_,
           "foreach n [namespace children ::] {if {$n ne {::tcl}} {namespace delete $n}}\n"
           "foreach n [namespace children ::tcl] {\n"
           "  if {$n ni {::tcl::mathfunc ::tcl::mathop ::tcl::array ::tcl::binary ::tcl::dict ::tcl::info\n"
           "             ::tcl::namespace ::tcl::prefix ::tcl::string}} {namespace delete $n}\n"
           "}\n"
           "foreach n [info commands ::tcl::*] {rename $n {}}\n"
           "foreach n {hostname library loaded nameofexecutable sharedlibextension} {\n"
           "  if {[llength [info commands ::tcl::info::$n]]} {rename ::tcl::info::$n {}}\n"
           "}\n"
           "unset -nocomplain n");
  Tcl_ResetResult(interp_);
}

void TclInterpreter::add_host_commands() {
  for (const std::string_view name : k_refused_commands) {
    if (name == "unknown") continue;  // its absence is what "invalid command name" comes from
    add_command(std::string(name), "?...?", 0, 1 << 30, [name = std::string(name)](Words) -> Tcl_Obj* {
      throw ScriptError("not available to a scene script", name, k_refused_hint);
    });
  }
  const auto do_source = [this](Words words) { return source(words); };
  add_command("source", "file", 1, 3, do_source);
  add_command("include", "file", 1, 1, do_source);
  add_command("puts", "?-nonewline? ?stdout|stderr? text", 1, 3, [this](Words words) { return put(words); });
  add_command("flush", "stdout|stderr", 1, 1, [](Words) { return nullptr; });
  add_command("package", "require name ?version?", 1, 1 << 30, [](Words words) -> Tcl_Obj* {
    std::size_t at = 1;
    if (words.size() > 1 && text_of(words[1]) == "-exact") ++at;
    if (is_word(words[0], "require") && words.size() > at) {
      for (const std::string_view known : {"Tcl", "Tclx", "Sipp", "Tsipp"}) {
        if (is_word(words[at], known)) return new_text(known == "Tcl" ? TCL_PATCH_LEVEL : "3.1");
      }
      throw ScriptError(fmt::format("no package {}", quoted(words[at])), std::string(text_of(words[at])),
                        "Tcl, Tclx and Tsipp are there already; nothing else can be loaded");
    }
    throw ScriptError(fmt::format("{} found", quoted(words[0])), std::string(text_of(words[0])));
  });
  add_command("file", "dirname|tail|extension|rootname|join name ?name ...?", 2, 1000,
              [](Words words) -> Tcl_Obj* {
                const std::string_view name = text_of(words[1]);
                const std::size_t slash = name.rfind('/');
                const std::string_view tail = slash == std::string_view::npos ? name : name.substr(slash + 1);
                const std::size_t dot = tail.rfind('.');
                const std::string_view extension =
                    dot == std::string_view::npos ? std::string_view() : tail.substr(dot);
                if (is_word(words[0], "tail")) return new_text(tail);
                if (is_word(words[0], "extension")) return new_text(extension);
                if (is_word(words[0], "rootname"))
                  return new_text(name.substr(0, name.size() - extension.size()));
                if (is_word(words[0], "dirname")) {
                  if (slash == std::string_view::npos) return new_text(".");
                  return new_text(slash == 0 ? "/" : name.substr(0, slash));
                }
                if (is_word(words[0], "join")) {
                  std::string joined;
                  for (Tcl_Obj* word : words.subspan(1)) {
                    const std::string_view part = text_of(word);
                    if (part.starts_with('/')) joined.clear();
                    if (!joined.empty() && !joined.ends_with('/')) joined += '/';
                    joined += part;
                  }
                  return new_text(joined);
                }
                throw ScriptError(
                    fmt::format("file {} is not available to a scene script", printable(text_of(words[0]))),
                    std::string(text_of(words[0])), k_refused_hint);
              });
}

void TclInterpreter::set_limits(const ScriptLimits& limits) {
  Tcl_SetRecursionLimit(interp_, limits.nesting);
  Tcl_LimitAddHandler(interp_, TCL_LIMIT_COMMANDS, limit_exceeded, this, nullptr);
  Tcl_LimitAddHandler(interp_, TCL_LIMIT_TIME, limit_exceeded, this, nullptr);
  Tcl_LimitSetCommands(interp_, static_cast<int>(std::min<std::uint64_t>(limits.commands, 2'147'483'647)));
  Tcl_LimitTypeSet(interp_, TCL_LIMIT_COMMANDS);
  if (limits.seconds <= 0) return;
  Tcl_Time end;
  Tcl_GetTime(&end);
  const double seconds = std::min(limits.seconds, 1e8);
  end.sec += static_cast<long>(seconds);
  end.usec += static_cast<long>((seconds - std::floor(seconds)) * 1e6);
  if (end.usec >= 1'000'000) end.usec -= 1'000'000, ++end.sec;
  Tcl_LimitSetTime(interp_, &end);
  Tcl_LimitTypeSet(interp_, TCL_LIMIT_TIME);
}

void TclInterpreter::add_command(const std::string& name, const std::string& usage, std::size_t fewest,
                                 std::size_t most, Command command) {
  Entry& entry = commands_[name];
  entry = {this, name, usage, fewest, most, std::move(command)};
  Tcl_CreateObjCommand(interp_, name.c_str(), call, &entry, nullptr);
}

void TclInterpreter::run_prelude(const char* text) {
  if (Tcl_Eval(interp_, text) != TCL_OK) throw Error(ExitStatus::internal, Tcl_GetStringResult(interp_));
  Tcl_ResetResult(interp_);
}

void TclInterpreter::set_variable(const std::string& name, const std::string& value) {
  Tcl_SetVar2Ex(interp_, name.c_str(), nullptr, new_text(value), TCL_GLOBAL_ONLY);
}

int TclInterpreter::call(ClientData data, Tcl_Interp*, int count, Tcl_Obj* const words[]) {
  const Entry& entry = *static_cast<const Entry*>(data);
  try {
    return entry.owner->invoke(entry, Words(words + 1, static_cast<std::size_t>(count) - 1));
  } catch (const std::bad_alloc&) {
    return entry.owner->no_memory(entry.name);
  } catch (const std::exception& error) {
    Tcl_Panic("%s: %s", entry.name.c_str(), error.what());
    return TCL_ERROR;
  }
}

int TclInterpreter::invoke(const Entry& entry, Words arguments) {
  try {
    if (arguments.size() < entry.fewest || arguments.size() > entry.most) {
      const std::string expected = entry.fewest == entry.most ? fmt::format("{}", entry.most)
                                   : entry.most >= 1000       ? fmt::format("{} or more", entry.fewest)
                                                        : fmt::format("{} to {}", entry.fewest, entry.most);
      throw ScriptError(fmt::format("{} argument{} found, expected {}", arguments.size(),
                                    arguments.size() == 1 ? "" : "s", expected));
    }
    Tcl_Obj* result = entry.command(arguments);
    if (stopped_ || final_problem_) return TCL_ERROR;
    if (result != nullptr) {
      Tcl_SetObjResult(interp_, result);
    } else {
      Tcl_ResetResult(interp_);
    }
    return TCL_OK;
  } catch (const ErrorInside&) {
    return TCL_ERROR;
  } catch (const ScriptError& error) {
    return report(entry.name, entry.usage, error, arguments);
  } catch (const Error& error) {
    return report(entry.name, entry.usage, ScriptError(error.what(), {}, error.hint()));
  }
}

int TclInterpreter::no_memory(const std::string& name) {
  try {
    return report(name, {},
                  ScriptLimitError(fmt::format("the script needs more than {} MB", limits_.memory_mb), {},
                                   "--script-memory MB allows more"));
  } catch (const std::bad_alloc&) {
    Tcl_Panic("unable to alloc memory for a message");  // nothing may be thrown through Tcl
    return TCL_ERROR;
  }
}

int TclInterpreter::report(const std::string& name, const std::string& usage, const ScriptError& error,
                           Words arguments) {
  if (final_problem_ || stopped_) return TCL_ERROR;
  Problem problem;
  problem.message = fmt::format("{}: {}", name, error.what());
  problem.hint = error.hint().empty() ? fmt::format("usage: {} {}", name, usage) : error.hint();
  if (!error.word().empty()) {
    const std::optional<std::size_t> argument = argument_of(arguments, error.word());
    if (argument) problem.word = error.word(), problem.argument = *argument;
  }
  problem.place = place();
  Tcl_SetObjResult(interp_, new_text(problem.message));
  if (dynamic_cast<const ScriptLimitError*>(&error) != nullptr) {
    fail_for_good(std::move(problem));
  } else {
    command_problem_ = std::move(problem);
  }
  return TCL_ERROR;
}

void TclInterpreter::fail_for_good(Problem problem) {
  final_problem_ = std::move(problem);
  // An exceeded limit is the one error that no `catch` holds up.
  Tcl_LimitSetCommands(interp_, 0);
  Tcl_LimitTypeSet(interp_, TCL_LIMIT_COMMANDS);
  Tcl_LimitCheck(interp_);
}

void TclInterpreter::stop() {
  stopped_ = true;
  Tcl_LimitSetCommands(interp_, 0);
  Tcl_LimitTypeSet(interp_, TCL_LIMIT_COMMANDS);
  Tcl_LimitCheck(interp_);
}

void TclInterpreter::limit_exceeded(ClientData data, Tcl_Interp* interp) {
  TclInterpreter& self = *static_cast<TclInterpreter*>(data);
  if (self.stopped_ || self.final_problem_) return;
  try {
    Problem problem;
    if (Tcl_LimitTypeExceeded(interp, TCL_LIMIT_TIME) != 0) {
      problem.message = fmt::format("the script runs longer than {:g} seconds", self.limits_.seconds);
      problem.hint = "--script-time S allows more";
    } else {
      problem.message = fmt::format("the script runs more than {} commands", self.limits_.commands);
      problem.hint = "--script-commands N allows more";
    }
    problem.place = self.place();
    self.final_problem_ = std::move(problem);
  } catch (const std::bad_alloc&) {
    self.no_memory("limit");
  }
}

int TclInterpreter::define_procedure(ClientData data, Tcl_Interp* interp, int count, Tcl_Obj* const words[]) {
  TclInterpreter& self = *static_cast<TclInterpreter*>(data);
  try {
    const ScriptPlace place = self.place();
    if (count == 4 && place.line > 0) {
      self.procedures_[tail_of(text_of(words[1]))] = {place.path, place.line};
    }
  } catch (const std::bad_alloc&) {
    return self.no_memory("proc");
  }
  return self.original_proc_.objProc(self.original_proc_.objClientData, interp, count, words);
}

ScriptPlace TclInterpreter::place() const {
  ScriptPlace place;
  place.path = main_path_;
  Tcl_InterpState saved = Tcl_SaveInterpState(interp_, TCL_OK);
  const TclValue name("frame");
  int line_in_text = 0;
  std::string text_command, inner_procedure;
  Tcl_Obj* count_words[] = {name.get()};
  int frames = 0;
  if (frame_info_.objProc(frame_info_.objClientData, interp_, 1, count_words) == TCL_OK) {
    Tcl_GetIntFromObj(nullptr, Tcl_GetObjResult(interp_), &frames);
  }
  for (int level = 0; level > -std::min(frames, k_most_frames); --level) {
    const TclValue number(Tcl_NewIntObj(level));
    Tcl_Obj* words[] = {name.get(), number.get()};
    if (frame_info_.objProc(frame_info_.objClientData, interp_, 2, words) != TCL_OK) break;
    const TclValue frame(Tcl_GetObjResult(interp_));
    const auto member = [&](const char* key) -> std::string {
      const TclValue k{std::string_view(key)};
      Tcl_Obj* value = nullptr;
      if (Tcl_DictObjGet(nullptr, frame.get(), k.get(), &value) != TCL_OK || value == nullptr) return {};
      return std::string(text_of(value));
    };
    const std::string command = member("cmd"), procedure = member("proc");
    const bool in_file = member("type") == "source";
    const int line = std::atoi(member("line").c_str());
    if (in_file) {
      std::string path = member("file");
      if (files_.find(path) == nullptr) path = main_path_;
      if (place.line == 0) {
        place.path = path;
        place.line = line;
        if (line_in_text > 0) refine(place, line_in_text, text_command);
      } else if (!inner_procedure.empty() && tail_of(first_word(command)) == tail_of(inner_procedure) &&
                 place.callers.size() < k_most_callers) {
        place.callers.emplace_back(path, line);
      }
      inner_procedure = procedure;
      if (place.callers.size() == k_most_callers) break;
    } else if (level == 0) {
      line_in_text = line;
      text_command = command;
    }
  }
  Tcl_RestoreInterpState(interp_, saved);
  return place;
}

void TclInterpreter::refine(ScriptPlace& place, int line_in_text, const std::string& command) const {
  const ScriptText* text = files_.find(place.path);
  if (text == nullptr) return;
  const std::string_view wanted = first_line(command);
  const auto holds = [&](int line) {
    return !wanted.empty() && text->line(line).find(wanted) != std::string_view::npos;
  };
  const int guess = place.line + line_in_text - 1;
  for (const int line : {guess, guess + 1, guess - 1}) {
    if (holds(line)) {
      place.line = line;
      return;
    }
  }
  for (int line = place.line; line < place.line + 200; ++line) {
    if (holds(line)) {
      place.line = line;
      return;
    }
  }
}

TclInterpreter::Problem TclInterpreter::tcl_problem() const {
  std::string message(text_of(Tcl_GetObjResult(interp_)));
  if (message == command_problem_.message) return command_problem_;
  std::replace(message.begin(), message.end(), '\n', ' ');  // `expr` breaks the line before what it shows
  Problem problem;
  problem.message = message;
  problem.place.path = main_path_;
  problem.place.line = Tcl_GetErrorLine(interp_);
  const char* value = Tcl_GetVar2(interp_, "errorInfo", nullptr, TCL_GLOBAL_ONLY);
  const std::string info = value == nullptr ? "" : value;
  const std::vector<InfoEntry> entries = entries_of(info);
  // From the file inwards: every text begins on the line of the command that was reached so far.
  ScriptPlace& place = problem.place;
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    if (entry->contexts.empty()) refine(place, 1, std::string(entry->command));  // of an `if`, say
    for (auto context = entry->contexts.rbegin(); context != entry->contexts.rend(); ++context) {
      const auto procedure = procedures_.find(tail_of(context->name));
      if (context->kind == "file") {
        if (entry != entries.rbegin()) place.callers.insert(place.callers.begin(), {place.path, place.line});
        const std::string path(context->name);
        place.path = files_.find(path) == nullptr ? main_path_ : path;
        place.line = context->line;
      } else {
        if (context->kind == "procedure" && procedure != procedures_.end()) {
          place.callers.insert(place.callers.begin(), {place.path, place.line});
          std::tie(place.path, place.line) = procedure->second;
        }
        refine(place, context->line, std::string(entry->command));
      }
    }
  }
  if (place.callers.size() > k_most_callers) place.callers.resize(k_most_callers);
  const std::string command(entries.empty() ? std::string_view() : first_line(entries.front().command));
  const std::string shown = printable(command);
  problem.word = std::string(first_word(command));
  problem.hint = remedy(message);
  const std::string variable = "$" + unset_variable(message);
  const ScriptText* text = variable.size() > 1 ? files_.find(place.path) : nullptr;
  if (text != nullptr && text->line(place.line).find(variable) != std::string_view::npos) {
    problem.word = variable;
  }
  const bool own_words = problem.word == "error" || problem.word == "throw" || problem.word == "return";
  if (!shown.empty() && !own_words && message.find(problem.word) == std::string::npos) {
    problem.message += fmt::format(", in '{}'", shown);
  }
  return problem;
}

std::string TclInterpreter::remedy(const std::string& message) const {
  constexpr std::string_view k_unknown = "invalid command name \"";
  if (message.starts_with("too many nested evaluations")) {
    return "does a procedure call itself for ever? --script-nesting N allows more";
  }
  if (!unset_variable(message).empty()) {
    return "set it before, or from outside by --define NAME=VALUE; procedures write $::NAME for what is set "
           "outside them";
  }
  if (message.starts_with("missing close-brace")) {
    return "every { needs its }, in comments and strings too: look for the one that is open";
  }
  if (!message.starts_with(k_unknown)) return {};
  const std::string name = message.substr(k_unknown.size(), message.size() - k_unknown.size() - 1);
  std::size_t best = 1 + name.size() / 4;
  std::string found;
  for (const auto& [candidate, entry] : commands_) {
    const std::size_t distance = edit_distance(name.substr(0, 60), candidate);
    if (distance <= best && distance > 0) best = distance, found = candidate;
  }
  return found.empty() ? "" : fmt::format("did you mean '{}'?", found);
}

TclInterpreter::Ending TclInterpreter::run(const std::string& path) {
  main_path_ = path;
  set_limits(limits_);
  const TclValue name{std::string_view(path)};
  const int status = Tcl_FSEvalFileEx(interp_, name.get(), "utf-8");
  flush_output();
  if (stopped_) return Ending::stopped;
  if (final_problem_) return Ending::failed;
  if (status == TCL_OK) return Ending::finished;
  final_problem_ = tcl_problem();
  return Ending::failed;
}

Diagnostic TclInterpreter::failure() const {
  const Problem& p = *final_problem_;
  return diagnostic(Severity::error, p.place, p.message, p.hint, p.word, p.argument);
}

Diagnostic TclInterpreter::diagnostic(Severity severity, const ScriptPlace& place, const std::string& message,
                                      const std::string& hint, const std::string& word,
                                      std::size_t argument) const {
  Diagnostic d;
  d.severity = severity;
  d.message = printable(message, 400);
  d.hint = printable(hint, 400);
  const auto display = [&](const std::string& path) {
    const ScriptText* text = files_.find(path);
    return printable(text == nullptr ? path : text->display_name, 300);
  };
  d.where.file = display(place.path);
  d.where.line = static_cast<std::uint64_t>(std::max(place.line, 0));
  if (!place.callers.empty()) {
    std::string chain;
    for (const auto& [path, line] : place.callers) {
      chain += fmt::format("{}{}:{}", chain.empty() ? "" : ", ", display(path), line);
    }
    d.hint += fmt::format("{}called from {}", d.hint.empty() ? "" : "; ", chain);
  }
  const ScriptText* text = files_.find(place.path);
  if (text == nullptr || place.line < 1) return d;
  const std::string_view line = text->line(place.line);
  if (line.empty()) return d;
  // Behind the name of the command, if that is on this line too.
  const std::string_view name = first_word(std::string_view(message).substr(0, message.find(':')));
  const std::size_t command = line.find(name);
  std::size_t at = std::string_view::npos, length = word.size();
  if (argument > 0 && command != std::string_view::npos) {
    const std::string_view written = written_argument(line, command, argument);
    if (!written.empty()) at = static_cast<std::size_t>(written.data() - line.data());
    const bool literal = written.starts_with('{') || written.starts_with('"');
    const std::size_t inside = literal ? written.find(word) : std::string_view::npos;
    if (inside != std::string_view::npos) {
      at += inside;
    } else {
      length = written.size();
    }
  }
  if (at == std::string_view::npos && !word.empty()) {
    length = word.size();
    at = only_place(line, word, command == std::string_view::npos ? 0 : command);
    if (at == std::string_view::npos && command == std::string_view::npos) at = line.find(word);
  }
  if (at == std::string_view::npos && command != std::string_view::npos && !name.empty()) {
    at = command;
    length = name.size();
  }
  d.excerpt = std::string(line.substr(0, 1000));
  if (at != std::string_view::npos && at < d.excerpt.size()) {
    d.where.column = at + 1;
    d.excerpt_column = at + 1;
    d.length = std::max<std::size_t>(1, std::min(length, d.excerpt.size() - at));
  }
  return d;
}

Tcl_Obj* TclInterpreter::source(Words words) {
  if (words.size() == 2 || (words.size() == 3 && text_of(words[0]) != "-encoding")) {
    throw ScriptError(fmt::format("{} found, expected one file name", quoted(words[0])));
  }
  if (sources_open_ >= k_most_open_sources) {
    throw ScriptError(fmt::format("files source each other more than {} levels deep", k_most_open_sources),
                      std::string(text_of(words.back())), "does a file source itself?");
  }
  const std::string path = files_.resolve(std::string(text_of(words.back())));
  files_.load(path);
  const TclValue name{std::string_view(path)};
  ++sources_open_;
  const int status = Tcl_FSEvalFileEx(interp_, name.get(), "utf-8");
  --sources_open_;
  if (status == TCL_OK) {
    Tcl_Obj* result = Tcl_GetObjResult(interp_);
    return result;
  }
  throw ErrorInside();
}

Tcl_Obj* TclInterpreter::put(Words words) {
  const bool no_newline = words.size() > 1 && text_of(words[0]) == "-nonewline";
  const Words rest = no_newline ? words.subspan(1) : words;
  if (rest.empty() || rest.size() > 2) throw ScriptError("no text found");
  if (rest.size() == 2 && text_of(rest[0]) != "stdout" && text_of(rest[0]) != "stderr") {
    unexpected(rest[0], "the channel", "stdout or stderr");
  }
  print(text_of(rest.back()), !no_newline);
  return nullptr;
}

void TclInterpreter::print(std::string_view text, bool end_of_line) {
  if (printed_ > k_max_script_output) return;
  printed_ += text.size() + (end_of_line ? 1 : 0);
  if (printed_ > k_max_script_output) {
    flush_output();
    if (log_) log_("(the script prints more than this; the rest is left out)");
    return;
  }
  line_ += text;
  if (end_of_line) line_ += '\n';
  std::size_t at = 0;
  for (std::size_t end = line_.find('\n'); end != std::string::npos; end = line_.find('\n', at)) {
    if (log_) log_(printable(std::string_view(line_).substr(at, end - at), k_longest_line));
    at = end + 1;
  }
  line_.erase(0, at);
}

void TclInterpreter::flush_output() {
  if (line_.empty()) return;
  if (log_) log_(printable(line_, k_longest_line));
  line_.clear();
}

}  // namespace farop::sipp
