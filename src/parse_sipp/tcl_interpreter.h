// SPDX-License-Identifier: GPL-3.0-or-later
// Tcl for scene scripts: a safe interpreter that has no files, processes, sockets, timers or other
// interpreters, counts what a script uses up, and knows where in which file an error stands.
#pragma once

#include <tcl.h>

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "parse_sipp/parse_sipp.h"
#include "parse_sipp/script_error_internal.h"
#include "parse_sipp/script_files.h"
#include "parse_sipp/tcl_values.h"

namespace farop::sipp {

/// A line of a script and the lines from which that was called, innermost first.
struct ScriptPlace {
  std::string path;
  int line = 0;  ///< 0: nowhere in particular
  std::vector<std::pair<std::string, int>> callers;
};

class TclInterpreter {
 public:
  using Words = std::span<Tcl_Obj* const>;  ///< arguments of a command, without its name
  /// Returns the result, or nullptr for none. Throws ScriptError.
  using Command = std::function<Tcl_Obj*(Words)>;

  /// `files` and `log` must outlive the interpreter. With seconds = 0 there is no limit of time.
  TclInterpreter(const ScriptLimits& limits, ScriptFiles& files, std::function<void(const std::string&)> log);
  ~TclInterpreter();
  TclInterpreter(const TclInterpreter&) = delete;
  TclInterpreter& operator=(const TclInterpreter&) = delete;

  /// `usage`: the arguments in words; a call with fewer than `fewest` or more than `most` of them is answered
  /// with it.
  void add_command(const std::string& name, const std::string& usage, std::size_t fewest, std::size_t most,
                   Command command);
  /// Runs Tcl of our own, outside all limits, before the script.
  void run_prelude(const char* text);
  void set_variable(const std::string& name, const std::string& value);

  enum class Ending { finished, stopped, failed };
  /// Runs the file `path`, which `files` knows by this name; messages and `info script` use it.
  Ending run(const std::string& path);
  /// Ends the script whatever it catches; run() then returns `stopped`. For use inside a command, which
  /// returns right after it.
  void stop();
  /// Of a run that failed: the one error.
  Diagnostic failure() const;
  /// Where the running command stands.
  ScriptPlace place() const;
  /// `word`: what is wrong, `argument`: which argument of the command it came with, from 1 (0: not known).
  Diagnostic diagnostic(Severity severity, const ScriptPlace& place, const std::string& message,
                        const std::string& hint, const std::string& word = {},
                        std::size_t argument = 0) const;

  const ScriptFiles& files() const { return files_; }

 private:
  struct Entry {
    TclInterpreter* owner;
    std::string name, usage;
    std::size_t fewest, most;
    Command command;
  };
  /// An error and what to say about it.
  struct Problem {
    std::string message, hint, word;
    std::size_t argument = 0;  ///< of the command, from 1: the one that has the word; 0: not known
    ScriptPlace place;
  };

  static int call(ClientData data, Tcl_Interp* interp, int count, Tcl_Obj* const words[]);
  static int define_procedure(ClientData data, Tcl_Interp* interp, int count, Tcl_Obj* const words[]);
  static void limit_exceeded(ClientData data, Tcl_Interp* interp);

  int invoke(const Entry& entry, Words arguments);
  void remove_commands();
  void add_host_commands();
  void set_limits(const ScriptLimits& limits);
  int no_memory(const std::string& name);
  int report(const std::string& name, const std::string& usage, const ScriptError& error,
             Words arguments = {});
  void fail_for_good(Problem problem);
  Tcl_Obj* source(Words words);
  Tcl_Obj* put(Words words);
  void print(std::string_view text, bool end_of_line);
  void flush_output();
  Problem tcl_problem() const;
  /// From the line where a text begins to the line of `command` in it, if the file bears that out.
  void refine(ScriptPlace& place, int line_in_text, const std::string& command) const;
  /// What to do about an error of Tcl's own; empty where nothing is known.
  std::string remedy(const std::string& message) const;

  Tcl_Interp* interp_ = nullptr;
  ScriptFiles& files_;
  std::function<void(const std::string&)> log_;
  std::string line_;  ///< printed without its end so far
  std::uint64_t printed_ = 0;
  std::map<std::string, Entry> commands_;
  Tcl_CmdInfo frame_info_{}, original_proc_{};
  std::map<std::string, std::pair<std::string, int>> procedures_;  ///< name -> where its `proc` stands
  std::string main_path_;
  ScriptLimits limits_;
  bool stopped_ = false;
  int sources_open_ = 0;
  Problem command_problem_;               ///< the last error of a command of ours, caught or not
  std::optional<Problem> final_problem_;  ///< no way on
};

}  // namespace farop::sipp
