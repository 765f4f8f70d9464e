// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolate/crash_words.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "core/diagnostics.h"
#include "isolate/frame_memory.h"

namespace farop::isolate {
namespace {

/// Text of the black box, which may not end.
template <std::size_t Size>
std::string text_of(const char (&text)[Size]) {
  return printable({text, ::strnlen(text, Size)}, Size);
}

std::string signal_name(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name == nullptr ? fmt::format("signal {}", signal) : fmt::format("SIG{}", name);
}

const char* did(const BlackBox& box) {
  return box.writing == 1   ? "it wrote to"
         : box.writing == 0 ? "it read"
         : box.writing == 3 ? "it jumped to"
                            : "it touched";
}

/// Reading and writing where memory ends: verdict and words.
void describe_address(PluginFinding& finding, const Circumstances& c, const std::string& where) {
  const BlackBox& box = *c.box;
  const bool reads = box.writing == 0;
  switch (box.region) {
    case Region::stack:
      finding.verdict = "crash.stack";
      finding.message = "the stack is full " + where;
      finding.hint = "does a function call itself without end? Large arrays belong on the heap (malloc, new)";
      return;
    case Region::before_frame:
    case Region::after_frame: {
      if (c.frame == nullptr) break;
      const std::string place = place_of(box.offset, *c.frame);
      const std::string verdict = write_verdict(box.offset, *c.frame);
      // Who reads a pixel is about to write it: blending, x ^= y. The place makes the verdict.
      finding.verdict = verdict.empty() ? "oob.write-after" : verdict;
      finding.message =
          fmt::format("{} pixels outside the frame {}: {}", reads ? "it read" : "it wrote to", where, place);
      finding.hint = "check coordinates against 0, width and height, and step by row_bytes from row to row";
      return;
    }
    case Region::frame:
      finding.message =
          fmt::format("{} pixels of the frame that it had taken away itself {}", did(box), where);
      finding.hint = "do not unmap or protect memory that is not yours";
      return;
    case Region::old_frame:
      if (box.other_thread != 0) {
        finding.verdict = "det.threads";
        finding.message = fmt::format(
            "a thread that it had started wrote to a frame whose end_frame() had returned, {}", where);
        finding.hint = "wait for your threads in end_frame()";
        return;
      }
      finding.verdict = "oob.write-after-end";
      finding.message = fmt::format("{} a frame whose end_frame() had returned, {}", did(box), where);
      finding.hint = "take `pixels` from the frame of the last begin_frame()";
      return;
    case Region::after_input: {
      finding.verdict = reads ? "oob.read" : "oob.write-input";
      const std::int64_t beyond = box.offset / static_cast<std::int64_t>(sizeof(farop_vertex));
      finding.message = fmt::format("{} vertices that are not there {}: number {} behind the last", did(box),
                                    where, beyond + 1);
      finding.hint = "a polygon has vertices 0 .. vertex_count - 1";
      return;
    }
    case Region::input:
      finding.verdict = reads ? "crash.segv" : "oob.write-input";
      finding.message = fmt::format("{} the polygon's own data, which may only be read, {}", did(box), where);
      finding.hint = "copy the vertices before you sort or change them";
      return;
    case Region::old_input:
      finding.verdict = reads ? "oob.read" : "oob.write-input";
      finding.message = fmt::format("{} vertices of a polygon() that had returned, {}", did(box), where);
      finding.hint = "copy what you keep: a polygon lives until polygon() returns";
      return;
    case Region::text:
      finding.verdict = "abi.name";
      finding.message = "its name or summary cannot be read: there is no NUL at its end";
      finding.hint = "name and summary are strings that live until the process ends";
      return;
    case Region::unknown:
      break;
  }
  if (box.address < 4096) {
    finding.message = fmt::format("null pointer: {} address {} {}", did(box), box.address, where);
    finding.hint = "which pointer was not set? Was the result of malloc() looked at?";
  } else {
    finding.message =
        fmt::format("{} address {:#x}, where there is nothing, {}", did(box), box.address, where);
    finding.hint = "an index out of range, or a pointer to memory that was freed?";
  }
}

void describe_signal(PluginFinding& finding, int signal, const Circumstances& c, const std::string& where) {
  const BlackBox& box = *c.box;
  const bool known = box.signal == static_cast<std::uint32_t>(signal);
  switch (signal) {
    case SIGSEGV:
    case SIGBUS:
      finding.verdict = signal == SIGSEGV ? "crash.segv" : "crash.bus";
      if (known && box.code > 0) return describe_address(finding, c, where);
      finding.message = fmt::format("ended by {} {}", signal_name(signal), where);
      return;
    case SIGFPE:
      finding.verdict = "crash.fpe";
      finding.message =
          (known && box.code == FPE_INTDIV ? "division by zero " : "arithmetic error (SIGFPE) ") + where;
      finding.hint = "horizontal edges have a height of 0, empty polygons an area of 0";
      return;
    case SIGILL:
      finding.verdict = "crash.ill";
      finding.message = "illegal instruction " + where;
      finding.hint =
          "was it built for another processor (-march=native), or does it end in __builtin_unreachable()?";
      return;
    case SIGABRT: {
      finding.verdict = "crash.abort";
      const std::string thrown = text_of(box.thrown);
      if (thrown == k_thread_exit) {
        finding.verdict = "crash.exit";
        finding.message = "it called pthread_exit() in farop's thread " + where;
        finding.hint = "return a negative status instead";
      } else if (!thrown.empty()) {
        finding.message = fmt::format("an exception ({}) left the rasterizer {}", thrown, where);
        finding.hint = "catch everything in the functions of the table and return a negative status";
      } else {
        finding.message = "it called abort() " + where;
      }
      return;
    }
    case SIGSYS:
      finding.verdict = "limit.syscall";
      finding.message = "it made a system call that is forbidden here, " + where;
      finding.hint = "a rasterizer draws; files, network and other processes are none of its business";
      return;
    case SIGXCPU:
      finding.verdict = "limit.time";
      finding.message = "its CPU time ran out " + where;
      return;
    case SIGTRAP:
      finding.verdict = "crash.trap";
      finding.message = "a breakpoint or the trap flag stopped it " + where;
      return;
    default:
      finding.verdict = "crash.exit";
      finding.message = fmt::format("ended by {} {}", signal_name(signal), where);
  }
}

}  // namespace

std::string where_text(const Circumstances& c, std::optional<std::uint32_t>* polygon) {
  switch (c.box->phase) {
    case Phase::start:
    case Phase::load:
      return "while it was loaded";
    case Phase::create:
      return "in create";
    case Phase::begin_frame:
      return "in begin_frame";
    case Phase::polygon: {
      const std::uint32_t number = c.box->current;
      if (polygon != nullptr) *polygon = number;
      std::string text = fmt::format("in polygon {}", number);
      if (c.corners && c.first_corner) {
        text +=
            fmt::format(" ({} corners, first at {},{})", *c.corners, c.first_corner->x, c.first_corner->y);
      }
      return text;
    }
    case Phase::end_frame:
      return "in end_frame";
    case Phase::destroy:
      return "in destroy or while it was unloaded";
    case Phase::idle:
      break;
  }
  return "between two calls";
}

namespace {

/// The verdict of what ended a library before it was one.
void belongs_to_loading(PluginFinding& finding, const Circumstances& c) {
  const bool ended = finding.verdict.starts_with("crash.") || finding.verdict == "limit.time";
  if (c.box->phase != Phase::load || !ended) return;
  finding.message += fmt::format(" ({})", finding.verdict);
  finding.verdict = "abi.load";
  finding.hint = "code that runs before farop_rasterizer_entry() returns: constructors, that function itself";
}

}  // namespace

std::optional<PluginFinding> finding_of_end(int wait_status, const Circumstances& c) {
  PluginFinding finding;
  finding.fatal = true;
  const std::string where = where_text(c, &finding.polygon);
  if (WIFSIGNALED(wait_status)) {
    const int signal = WTERMSIG(wait_status);
    if (signal == SIGKILL && c.walled) return std::nullopt;
    describe_signal(finding, signal, c, where);
    const bool may_be_memory = finding.verdict == "crash.segv" || finding.verdict == "crash.abort";
    if (c.box->memory_refused != 0 && may_be_memory) {
      finding.verdict = "limit.memory";
      finding.message = fmt::format("out of memory (limit {} MB): {}", c.memory_bytes >> 20, finding.message);
      finding.hint = "free what is not needed any more; malloc() returns NULL when there is no more";
    }
    const std::uint32_t count = std::min<std::uint32_t>(c.box->trace_count, k_max_trace);
    for (std::uint32_t i = 0; i < count; ++i) finding.trace.push_back(text_of(c.box->trace[i]));
    if (finding.verdict == "crash.abort" && !c.last_error_line.empty())
      finding.message += ": " + c.last_error_line;
  } else if (WEXITSTATUS(wait_status) == k_exit_control) {
    finding.verdict = "abi.protocol";
    finding.message = "it took away the descriptors that farop talks through, " + where;
    finding.hint = "close only what you have opened";
  } else if (WEXITSTATUS(wait_status) == k_exit_memory) {
    finding.verdict = "limit.memory";
    finding.message = "it left no address space for the frame";
  } else {
    finding.verdict = "crash.exit";
    finding.message =
        fmt::format("it ended the process with exit status {} {}", WEXITSTATUS(wait_status), where);
    finding.hint = "return a negative status instead";
  }
  belongs_to_loading(finding, c);
  return finding;
}

PluginFinding finding_of_memory(const Circumstances& c) {
  PluginFinding finding;
  finding.fatal = true;
  finding.verdict = "limit.memory";
  finding.message = fmt::format("out of memory (limit {} MB): the kernel ended it ", c.memory_bytes >> 20) +
                    where_text(c, &finding.polygon);
  finding.hint = "free what is not needed any more";
  return finding;
}

PluginFinding finding_of_time(bool cpu, double seconds, const Circumstances& c) {
  PluginFinding finding;
  finding.fatal = true;
  finding.verdict = "limit.time";
  const std::string where = where_text(c, &finding.polygon);
  finding.message = cpu ? fmt::format("stopped after {:g} s of CPU time {}", seconds, where)
                        : fmt::format("stopped after {:g} s in which it hardly computed, {}", seconds, where);
  finding.hint = cpu ? "does a loop end for every polygon? Empty ones, one pixel wide ones?"
                     : "does it wait for something?";
  belongs_to_loading(finding, c);
  return finding;
}

PluginFinding finding_of_refusal(const WardenMessage& refusal) {
  PluginFinding finding;
  finding.verdict = "limit.syscall";
  finding.fatal = refusal.fatal != 0;
  if (refusal.polygon != 0xFFFFFFFFu) finding.polygon = refusal.polygon;
  const char* what = "do something that only administrators do";
  switch (refusal.deed) {
    case Deed::process:
      what = "start a process";
      break;
    case Deed::program:
      what = "run a program";
      break;
    case Deed::network:
      what = "use the network";
      break;
    case Deed::write_file:
      what = "write, remove or rename a file";
      break;
    case Deed::signal:
      what = "send a signal to another process";
      break;
    case Deed::other_process:
      what = "look into another process";
      break;
    case Deed::code:
      what = "make code while running";
      break;
    case Deed::threads:
      what = "start more threads than allowed";
      finding.verdict = "limit.threads";
      break;
    case Deed::memory:
      what = "share memory or messages with others";
      break;
    case Deed::control:
      what = "use descriptors that it has not opened";
      finding.verdict = "abi.protocol";
      break;
    case Deed::kernel:
    case Deed::count:
      break;
  }
  finding.message = fmt::format("it tried to {} ({}){}", what, printable(refusal.what),
                                finding.polygon ? fmt::format(" in polygon {}", *finding.polygon) : "");
  finding.hint = refusal.deed == Deed::threads
                     ? "more threads can be allowed"
                     : "a rasterizer draws; files, network and other processes are none of its business";
  return finding;
}

}  // namespace farop::isolate
