// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_rasterizer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/diagnostics.h"
#include "core/error.h"
#include "export/ppm_reader.h"
#include "plugin/plugin_rasterizer.h"

namespace farop::app {
namespace {

namespace fs = std::filesystem;

std::string shell_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string replaced(std::string text, std::string_view word, const std::string& by) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size())) {
    text.replace(at, word.size(), by);
  }
  return text;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code ec;
  std::string name = (fs::temp_directory_path(ec) / "farop-XXXXXX").string();
  if (ec || ::mkdtemp(name.data()) == nullptr) {
    throw Error(ExitStatus::surroundings,
                fmt::format("cannot make a temporary folder: {}", std::strerror(errno)),
                "set TMPDIR to a folder that can be written to");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ec;
  fs::remove_all(path_, ec);
}

CommandRasterizer::CommandRasterizer(std::string command, int samples)
    : command_(std::move(command)), samples_(samples) {
  for (const char* word : {"{flat}", "{ppm}"}) {
    if (command_.find(word) == std::string::npos) {
      throw Error(ExitStatus::usage,
                  fmt::format("--cmd '{}' does not say where {} goes", printable(command_), word),
                  "for instance --cmd './mine {flat} {ppm}'");
    }
  }
}

CommandRasterizer::~CommandRasterizer() = default;

void CommandRasterizer::begin_frame(const ScreenFrame& frame) {
  frame_ = frame;
  flat_ = std::make_unique<OutputFile>(flat_file().string());
  writer_ = std::make_unique<FlatWriter>(*flat_);
  writer_->begin_frame(frame);
}

void CommandRasterizer::end_frame() {
  writer_->end_frame();
  flat_->commit();
  writer_.reset();
  flat_.reset();
  run();
  Framebuffer drawn;
  try {
    drawn = read_ppm(ppm_file().string());
  } catch (const Error& error) {
    throw Error(ExitStatus::plugin, fmt::format("the picture of --cmd: {}", error.what()), error.hint());
  }
  if (drawn.width != frame_.resolution.x || drawn.height != frame_.resolution.y) {
    throw Error(ExitStatus::plugin,
                fmt::format("the picture of --cmd has {} x {} pixels, expected {} x {}", drawn.width,
                            drawn.height, frame_.resolution.x, frame_.resolution.y),
                "the first line of the flat file has the size");
  }
  farop_frame view{};
  view.width = drawn.width, view.height = drawn.height;
  view.row_bytes = 3 * std::int64_t{drawn.width};
  view.pixels = drawn.rgb.data();
  picture_ =
      average_blocks(view, samples_, false);  // a PPM begins with its top row, whatever the flat file counts
}

void CommandRasterizer::run() const {
  std::string line = replaced(command_, "{flat}", shell_quoted(flat_file().string()));
  line = replaced(line, "{ppm}", shell_quoted(ppm_file().string()));
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  // We ignore these two; a program expects them as they are by default.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  std::string shell = "sh", flag = "-c";
  char* arguments[] = {shell.data(), flag.data(), line.data(), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawn(&child, "/bin/sh", &files, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (error != 0)
    throw Error(ExitStatus::surroundings, fmt::format("cannot start a shell: {}", std::strerror(error)));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::string reason;
  if (WIFSIGNALED(status)) {
    reason = fmt::format("was killed by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  } else {
    reason = fmt::format("ended with exit status {}", WEXITSTATUS(status));
  }
  throw Error(
      ExitStatus::plugin, fmt::format("--cmd '{}' {}", printable(command_, 200), reason),
      WIFEXITED(status) && WEXITSTATUS(status) == 127 ? "the shell did not find it: is its path right?" : "");
}

Framebuffer CommandRasterizer::take() {
  return std::exchange(picture_, {});
}

}  // namespace farop::app
