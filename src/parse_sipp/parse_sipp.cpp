// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/parse_sipp.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <filesystem>
#include <new>

#include "core/error.h"
#include "parse_sipp/scene_stream.h"
#include "parse_sipp/script.h"
#include "parse_sipp/script_process.h"

namespace farop {

bool is_variable_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !name.empty() && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

namespace sipp {
namespace {

namespace fs = std::filesystem;

/// A script and its surroundings.
struct Source {
  std::string name;            ///< for messages
  std::string path;            ///< where Tcl reads it
  std::string folder;          ///< of its files; may be empty
  std::string display_folder;  ///< in front of their names in messages
  std::string text;
};

/// What the child says, each with its kind in front.
enum class Message : char { line = 'L', remark = 'D', scene = 'S', out_of_memory = 'M', broken = 'B' };

std::string object_name(const std::string& name) {
  return name == "-" ? "standard input" : fs::path(name).stem().string();
}

/// Runs the script. Remarks and at most one error go to `sink`; the scene has nothing of files in it.
std::optional<Scene> evaluate(const Source& source, const SippOptions& options, DiagnosticSink& sink,
                              const std::function<void(const std::string&)>& log) {
  ScriptFiles files(source.folder, source.display_folder);
  files.add(source.path, source.name, source.text);
  TclInterpreter interpreter(options.limits, files, log);
  Script script(interpreter, options, object_name(source.name));
  interpreter.set_variable("argv0", source.name);
  interpreter.set_variable("argv", "");
  interpreter.set_variable("argc", "0");
  for (const auto& [name, value] : options.variables) interpreter.set_variable(name, value);
  const TclInterpreter::Ending ending = interpreter.run(source.path);
  std::optional<Diagnostic> error;
  if (ending == TclInterpreter::Ending::failed) {
    error = interpreter.failure();
  } else {
    try {
      script.finish();
    } catch (const ScriptError& e) {
      error = interpreter.diagnostic(Severity::error, {source.path, 0, {}}, e.what(), e.hint());
    }
  }
  for (Diagnostic remark : script.remarks()) {
    if (remark.where.file.empty()) remark.where.file = source.name;
    sink.report(std::move(remark));
  }
  if (error) {
    sink.report(std::move(*error));
    return std::nullopt;
  }
  return std::move(script.scene());
}

// ---- the child ----

class PipeSink : public DiagnosticSink {
 public:
  explicit PipeSink(ChildOutput& out) : out_(out) {}
  void report(Diagnostic d) override {
    out_.write("D", 1);
    out_.write(&d.severity, sizeof d.severity);
    for (const std::uint64_t n :
         {d.where.line, d.where.column, std::uint64_t{d.excerpt_column}, std::uint64_t{d.length}})
      out_.write(&n, sizeof n);
    for (const std::string* s : {&d.where.file, &d.message, &d.hint, &d.excerpt}) put_text(*s);
    out_.flush();
  }
  void log(const std::string& text) {
    out_.write("L", 1);
    put_text(text);
    out_.flush();
  }

 private:
  void put_text(const std::string& s) {
    const std::uint64_t size = s.size();
    out_.write(&size, sizeof size);
    out_.write(s.data(), s.size());
  }
  ChildOutput& out_;
};

int panic_descriptor = -1;  // of the one script that a child runs

/// Tcl calls this when it cannot go on; nearly always because there is no more memory.
[[noreturn]] void panic(const char* format, ...) {
  char text[400];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  const bool memory = std::strstr(text, "alloc") != nullptr || std::strstr(text, "memory") != nullptr;
  // The child flushes behind every message, so nothing is lost before this one.
  char message[1 + sizeof(std::uint64_t) + sizeof text];
  const std::uint64_t size = std::strlen(text);
  message[0] = static_cast<char>(memory ? Message::out_of_memory : Message::broken);
  std::memcpy(message + 1, &size, sizeof size);
  std::memcpy(message + 1 + sizeof size, text, size);
  if (::write(panic_descriptor, message, 1 + sizeof size + size) < 0) ::_exit(2);
  ::_exit(1);
}

void child(const Source& source, const SippOptions& options, ChildOutput& out) {
  panic_descriptor = out.descriptor();
  Tcl_SetPanicProc(panic);
  PipeSink sink(out);
  try {
    const std::optional<Scene> scene =
        evaluate(source, options, sink, [&](const std::string& line) { sink.log(line); });
    if (!scene) return;
    out.write("S", 1);
    write_scene(*scene, [&](const void* data, std::size_t size) { out.write(data, size); });
    out.flush();
    ::_exit(0);  // the memory goes as a whole
  } catch (const std::bad_alloc&) {
    panic("unable to alloc");
  }
}

// ---- the parent ----

Diagnostic about_file(const Source& source, std::string message, std::string hint) {
  Diagnostic d;
  d.where.file = source.name;
  d.message = std::move(message);
  d.hint = std::move(hint);
  return d;
}

class Listener {
 public:
  Listener(ScriptProcess& process, DiagnosticSink& sink, const SippOptions& options)
      : process_(process), sink_(sink), options_(options) {}

  /// Up to the scene or the one error.
  std::optional<Scene> listen(const Source& source) {
    for (;;) {
      char kind = 0;
      process_.read(&kind, 1);
      switch (static_cast<Message>(kind)) {
        case Message::line: {
          const std::string line = text();
          if (options_.log) options_.log(line);
          break;
        }
        case Message::remark: {
          Diagnostic d = remark();
          const bool last = d.severity == Severity::error;
          sink_.report(std::move(d));
          if (last) return std::nullopt;
          break;
        }
        case Message::scene: {
          process_.stop_clock();
          return read_scene([this](void* data, std::size_t size) { process_.read(data, size); },
                            options_.limits.memory_mb << 20);
        }
        case Message::out_of_memory:
          sink_.report(about_file(source,
                                  fmt::format("the script needs more than {} MB", options_.limits.memory_mb),
                                  "--script-memory MB allows more"));
          return std::nullopt;
        default:
          sink_.report(about_file(source,
                                  fmt::format("the script broke the interpreter: {}", printable(text(), 400)),
                                  "please report it with the script"));
          return std::nullopt;
      }
    }
  }

 private:
  template <class T>
  T get() {
    T value;
    process_.read(&value, sizeof value);
    return value;
  }
  std::string text() {
    constexpr std::uint64_t k_longest = 1 << 16;  // what is longer was not written by evaluate()
    const auto size = get<std::uint64_t>();
    if (size > k_longest) throw std::runtime_error("a message of the script is too long");
    std::string s(size, '\0');
    process_.read(s.data(), s.size());
    return s;
  }
  Diagnostic remark() {
    Diagnostic d;
    const auto severity = get<std::underlying_type_t<Severity>>();
    d.severity = severity == static_cast<int>(Severity::note)      ? Severity::note
                 : severity == static_cast<int>(Severity::warning) ? Severity::warning
                                                                   : Severity::error;
    d.where.line = get<std::uint64_t>();
    d.where.column = get<std::uint64_t>();
    d.excerpt_column = get<std::uint64_t>();
    d.length = get<std::uint64_t>();
    for (std::string* s : {&d.where.file, &d.message, &d.hint, &d.excerpt}) *s = text();
    return d;
  }

  ScriptProcess& process_;
  DiagnosticSink& sink_;
  const SippOptions& options_;
};

void name_input(Scene& scene, const Source& source) {
  scene.inputs.front().file = source.name;
  scene.inputs.front().bytes = source.text.size();
}

std::optional<Scene> guarded(const Source& source, DiagnosticSink& sink, const SippOptions& options) {
  ScriptProcess process([&](ChildOutput& out) { child(source, options, out); }, options.limits.seconds,
                        options.limits.memory_mb);
  std::optional<Scene> scene;
  try {
    scene = Listener(process, sink, options).listen(source);
  } catch (const ChildLost& lost) {
    using Reason = ChildLost::Reason;
    sink.report(
        lost.reason == Reason::too_long
            ? about_file(source,
                         fmt::format("the script runs longer than {:g} seconds", options.limits.seconds),
                         "--script-time S allows more; one command alone may take as long, like a regexp")
        : lost.reason == Reason::too_much_memory
            ? about_file(source, lost.what(), "--script-memory MB allows more")
            : about_file(source, lost.what(), "look for procedures or brackets without an end"));
    return std::nullopt;
  } catch (const std::runtime_error& error) {
    sink.report(about_file(source, error.what(), "please report it with the script"));
    return std::nullopt;
  }
  if (scene) name_input(*scene, source);
  return scene;
}

/// A text in memory that has a path, for as long as this lives.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view text) : descriptor_(::memfd_create("script", MFD_CLOEXEC)) {
    for (std::string_view rest = text; descriptor_ >= 0 && !rest.empty();) {
      const ssize_t n = ::write(descriptor_, rest.data(), rest.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      rest.remove_prefix(static_cast<std::size_t>(n));
    }
    if (descriptor_ < 0) throw Error(ExitStatus::surroundings, "no memory for the text of a script");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

std::string read_all(const std::string& path) {
  const std::string shown = path == "-" ? "standard input" : printable(path, 200);
  const auto fail = [&](const std::string& why) { throw Error(ExitStatus::input, shown + ": " + why); };
  const int descriptor = path == "-" ? ::dup(0) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(fmt::format("cannot open: {}", std::strerror(errno)));
  std::string text, why;
  std::vector<char> block(std::size_t{1} << 16);
  for (;;) {
    const ssize_t n = ::read(descriptor, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      why = errno == EISDIR ? "is a directory" : fmt::format("cannot read: {}", std::strerror(errno));
    if (n > 0 && text.size() > k_max_script_bytes)
      why = fmt::format("is larger than {} MB", k_max_script_bytes >> 20);
    if (n <= 0 || !why.empty()) break;
    text.append(block.data(), static_cast<std::size_t>(n));
  }
  ::close(descriptor);
  if (!why.empty()) fail(why);
  return text;
}

}  // namespace
}  // namespace sipp

std::optional<Scene> parse_sipp(const std::string& path, DiagnosticSink& sink, const SippOptions& options) {
  namespace fs = std::filesystem;
  std::string text = sipp::read_all(path);
  std::error_code ec;
  if (path == "-" || !fs::is_regular_file(path, ec)) {
    return parse_sipp_text(text, path == "-" ? "standard input" : path, fs::current_path().string(), sink,
                           options);
  }
  const fs::path real = fs::canonical(path, ec);
  if (ec)
    throw Error(ExitStatus::input, fmt::format("{}: cannot open: {}", printable(path, 200), ec.message()));
  return sipp::guarded({path, real.string(), real.parent_path().string(),
                        fs::path(path).parent_path().string(), std::move(text)},
                       sink, options);
}

std::optional<Scene> parse_sipp_text(std::string_view text, const std::string& name,
                                     const std::string& folder, DiagnosticSink& sink,
                                     const SippOptions& options) {
  const sipp::MemoryFile file(text);
  return sipp::guarded({name, file.path(), folder, {}, std::string(text)}, sink, options);
}

std::optional<Scene> parse_sipp_unguarded(std::string_view text, const std::string& name,
                                          DiagnosticSink& sink, const SippOptions& options) {
  const sipp::MemoryFile file(text);
  const sipp::Source source{name, file.path(), {}, {}, std::string(text)};
  std::optional<Scene> scene = sipp::evaluate(
      source, options, sink, options.log ? options.log : [](const std::string&) {});
  if (!scene) return std::nullopt;
  std::string bytes;
  sipp::write_scene(*scene, [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  });
  std::size_t at = 0;
  scene = sipp::read_scene(
      [&](void* data, std::size_t size) {
        if (size > bytes.size() - at) throw std::runtime_error("the scene ends early");
        std::memcpy(data, bytes.data() + at, size);
        at += size;
      },
      bytes.size());
  sipp::name_input(*scene, source);
  return scene;
}

}  // namespace farop
