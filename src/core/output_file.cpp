// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/diagnostics.h"
#include "core/error.h"

namespace farop {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_failure(const std::string& path, const char* what, int error_number) {
  const char* hint = error_number == ENOSPC   ? "free some space or write to another folder with -o"
                     : error_number == EACCES ? "write to a folder of your own with -o"
                     : error_number == ENOENT ? "create the folder first, or write elsewhere with -o"
                                              : "";
  throw Error(ExitStatus::surroundings,
              fmt::format("{}: {}: {}", path == "-" ? "<stdout>" : printable(path, 4096), what,
                          std::strerror(error_number)),
              hint);
}

mode_t default_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

// A file that a symbolic link names is replaced where it really is; the link stays.
fs::path resolved(const std::string& path) {
  std::error_code ec;
  const fs::path real = fs::canonical(path, ec);
  return ec ? fs::path(path) : real;
}

// Creates an empty file beside `path`; returns its name, with `descriptor` open for reading and writing.
std::string create_temporary(const std::string& path, int& descriptor) {
  const fs::path target = resolved(path);
  const std::string extension = target.extension().string();
  std::string name =
      (target.parent_path() / fmt::format(".{}.XXXXXX{}", target.stem().string().substr(0, 64), extension))
          .string();
  descriptor = ::mkostemps(name.data(), static_cast<int>(extension.size()), O_CLOEXEC);
  if (descriptor < 0) throw_failure(path, "cannot create", errno);
  struct stat old {};
  const mode_t mode = ::stat(target.c_str(), &old) == 0 ? (old.st_mode & 0777) : default_mode();
  if (::fchmod(descriptor, mode) != 0) { /* a file system without permissions: nothing to keep */
  }
  return name;
}

void move_into_place(const std::string& temporary, const std::string& path) {
  if (::rename(temporary.c_str(), resolved(path).c_str()) != 0)
    throw_failure(path, "cannot put in place", errno);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  if (path_ == "-") {
    descriptor_ = STDOUT_FILENO;
    owns_descriptor_ = false;
    return;  // never seekable: the shell may have opened the file for appending
  }
  struct stat info {};
  const bool exists = ::stat(path_.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) fail("cannot write", EISDIR);
  if (exists && !S_ISREG(info.st_mode)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot open for writing", errno);
    return;
  }
  if (exists && ::access(path_.c_str(), W_OK) != 0) fail("cannot write", errno);
  temporary_path_ = create_temporary(path_, descriptor_);
  seekable_ = true;
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0 && owns_descriptor_) ::close(descriptor_);
  if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
}

void OutputFile::fail(const char* what, int error_number) const {
  throw_failure(path_, what, error_number);
}

void OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("cannot write", errno);
    size_ += static_cast<std::uint64_t>(done);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail("cannot write", errno);
    offset += static_cast<std::uint64_t>(done);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void OutputFile::commit() {
  if (!owns_descriptor_) return;
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail("cannot finish writing", errno);
  if (temporary_path_.empty()) return;
  move_into_place(temporary_path_, path_);
  temporary_path_.clear();
}

}  // namespace farop
