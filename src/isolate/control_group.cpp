// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolate/control_group.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "isolate/shared_memory.h"

namespace farop::isolate {
namespace {

/// What no limit of processes counts: page tables, sockets, pages of the frame that the runner touches first.
constexpr std::uint64_t k_margin = std::uint64_t{256} << 20;

std::string line_of(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

bool has_word(const std::string& line, const std::string& word) {
  std::istringstream words(line);
  for (std::string w; words >> w;) {
    if (w == word) return true;
  }
  return false;
}

/// Where the unified hierarchy is mounted, and which folder of it is mounted there.
struct Mount {
  std::string place, folder;
};

std::optional<Mount> find_mount(const std::string& root) {
  std::ifstream file(root + "/proc/self/mountinfo");
  for (std::string line; std::getline(file, line);) {
    // id parent major:minor folder place options... - type source options
    std::istringstream words(line);
    std::string skip, folder, place, word;
    words >> skip >> skip >> skip >> folder >> place;
    while (words >> word && word != "-") {
    }
    if (words >> word && word == "cgroup2") return Mount{place, folder};
  }
  return std::nullopt;
}

/// This process's group, as a path below the mounted folder; nothing when it lies outside.
std::optional<std::string> own_group(const std::string& root, const Mount& mount) {
  std::ifstream file(root + "/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("0::/", 0) != 0) continue;
    std::string path = line.substr(3);
    if (mount.folder != "/") {
      if (path.rfind(mount.folder, 0) != 0) return std::nullopt;
      path.erase(0, mount.folder.size());
    }
    return path == "/" ? "" : path;
  }
  return std::nullopt;
}

std::string fresh_name() {
  static std::atomic<unsigned> count{0};
  return fmt::format("farop-{}-{}", ::getpid(), count++);
}

/// Groups of programs that were killed before they could remove them. Those that have processes stay.
void remove_left_over(const std::string& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    int owner = 0;
    const bool ours = std::sscanf(entry.path().filename().c_str(), "farop-%d-", &owner) == 1;
    if (ours && owner > 0 && ::kill(owner, 0) != 0 && errno == ESRCH) ::rmdir(entry.path().c_str());
  }
}

std::string words_of(const char* what, const std::string& path, int error) {
  return fmt::format("cannot {} {}: {}", what, path, std::strerror(error));
}

}  // namespace

ControlGroup::ControlGroup(const Limits& limits, const std::string& root) {
  const std::optional<Mount> mount = find_mount(root);
  if (!mount) {
    why_ = "no cgroup v2 is mounted";
    return;
  }
  const std::optional<std::string> own = own_group(root, *mount);
  if (!own) {
    why_ = "this process is in none of the groups that are mounted";
    return;
  }
  // Groups that have processes share out nothing to groups below them, but for the root: so, beside ours.
  std::vector<std::string> parents = {*own};
  if (!own->empty()) parents.push_back(own->substr(0, own->rfind('/')));
  for (const std::string& parent : parents) {
    const std::string folder = fmt::format("{}{}{}", root, mount->place, parent);
    const std::string controllers = line_of(folder + "/cgroup.subtree_control");
    if (!has_word(controllers, "memory") || !has_word(controllers, "pids")) {
      why_ = fmt::format("{} does not share out memory and pids", mount->place + parent);
      continue;
    }
    remove_left_over(folder);
    path_ = folder + "/" + fresh_name();
    if (::mkdir(path_.c_str(), 0755) != 0) {
      why_ = words_of("make", std::exchange(path_, ""), errno);
      continue;
    }
    const std::string memory =
        limits.memory_bytes == 0 ? "max" : std::to_string(limits.memory_bytes * 5 / 4 + k_margin);
    if (set("memory.max", memory) && set("pids.max", std::to_string(limits.tasks))) {
      // Not everywhere: swapping may be switched off, and the others are younger.
      const std::string kept = why_;
      set("memory.swap.max", "0"), set("memory.oom.group", "1");
      why_ = kept;
      return;
    }
    remove();
  }
}

ControlGroup::~ControlGroup() {
  remove();
}

bool ControlGroup::set(const char* file, const std::string& value) {
  const std::string path = path_ + "/" + file;
  // O_CREAT makes nothing in the kernel's file system, where files come with the folder.
  const OwnedDescriptor out(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  if (!out || ::write(out.get(), value.data(), value.size()) != static_cast<ssize_t>(value.size())) {
    why_ = words_of("write", path, errno);
    return false;
  }
  return true;
}

bool ControlGroup::add(pid_t process) {
  return there() && set("cgroup.procs", std::to_string(process));
}

std::uint64_t ControlGroup::killed_for_memory() const {
  std::ifstream file(path_ + "/memory.events");
  std::string word;
  std::uint64_t count = 0;
  while (there() && file >> word >> count) {
    if (word == "oom_kill") return count;
  }
  return 0;
}

std::optional<std::uint64_t> ControlGroup::peak_bytes() const {
  std::ifstream file(path_ + "/memory.peak");
  std::uint64_t bytes = 0;
  if (!there() || !(file >> bytes)) return std::nullopt;
  return bytes;
}

bool ControlGroup::remove() {
  if (!there()) return true;
  // Processes take a moment to be gone after they were killed.
  for (int tries = 0; tries < 500; ++tries) {
    if (::rmdir(path_.c_str()) == 0 || errno == ENOENT) {
      path_.clear();
      return true;
    }
    if (errno != EBUSY) break;
    set("cgroup.kill", "1");
    const timespec moment{0, 1000000};
    ::nanosleep(&moment, nullptr);
  }
  why_ = words_of("remove", path_, errno);
  return false;
}

IsolationLayer control_group_layer(bool holds, const std::string& why) {
  IsolationLayer layer{"E cgroup", holds, why, ""};
  if (!holds) {
    layer.how_to_enable =
        "needs a sub-tree of cgroup v2 that was delegated: a systemd session (`systemd-run --user --scope "
        "farop ...`), a job of Slurm, or root outside of containers";
  }
  return layer;
}

IsolationLayer probe_control_group(const std::string& root) {
  ControlGroup group({std::uint64_t{64} << 20, 1}, root);
  if (!group.there()) return control_group_layer(false, group.why());
  std::array<int, 2> go{};
  if (::pipe2(go.data(), O_CLOEXEC) != 0) return control_group_layer(false, std::strerror(errno));
  OwnedDescriptor wait(go[0]), tell(go[1]);
  const pid_t child = ::fork();
  if (child == 0) {
    char byte = 0;
    tell.reset();
    if (::read(wait.get(), &byte, 1) != 1) ::_exit(2);
    const pid_t more = ::fork();
    if (more == 0) ::_exit(0);
    if (more > 0) ::waitpid(more, nullptr, 0);
    ::_exit(more < 0 ? 0 : 1);
  }
  if (child < 0) return control_group_layer(false, std::strerror(errno));
  const bool inside = group.add(child);
  const char byte = 'g';
  if (inside && ::write(tell.get(), &byte, 1) != 1) ::kill(child, SIGKILL);
  tell.reset();
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!inside) return control_group_layer(false, group.why());
  const bool stopped = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return control_group_layer(stopped, stopped ? "" : "it is there, but what it should stop went through");
}

}  // namespace farop::isolate
