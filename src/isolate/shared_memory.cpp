// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolate/shared_memory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

#ifndef F_SEAL_FUTURE_WRITE
#define F_SEAL_FUTURE_WRITE 0x0010  // Linux 5.1
#endif

namespace farop::isolate {
namespace {

[[noreturn]] void no_memory(std::uint64_t bytes, int error) {
  throw Error(ExitStatus::surroundings, fmt::format("no {} bytes of memory to share with the rasterizer: {}",
                                                    bytes, std::strerror(error)));
}

}  // namespace

void OwnedDescriptor::reset(int fd) {
  if (fd_ >= 0) ::close(fd_);
  fd_ = fd;
}

SharedMemory::SharedMemory(const char* name, std::uint64_t bytes)
    : memory_(::memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING)), bytes_(bytes) {
  if (!memory_ || ::ftruncate(fd(), static_cast<off_t>(bytes)) != 0) no_memory(bytes, errno);
  int error = 0;
  do {
    error = bytes == 0 ? 0 : ::posix_fallocate(fd(), 0, static_cast<off_t>(bytes));
  } while (error == EINTR);
  if (error != 0) no_memory(bytes, error);
  if (::fcntl(fd(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0) no_memory(bytes, errno);
}

void SharedMemory::write(std::uint64_t at, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(fd(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) no_memory(bytes_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    at += static_cast<std::uint64_t>(done);
  }
}

bool SharedMemory::read(std::uint64_t at, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t done = ::pread(fd(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    at += static_cast<std::uint64_t>(done);
  }
  return true;
}

void SharedMemory::make_constant() {
  if (::fcntl(fd(), F_ADD_SEALS, F_SEAL_WRITE | F_SEAL_SEAL) != 0) no_memory(bytes_, errno);
}

WritableView::WritableView(const SharedMemory& memory) {
  void* const place = ::mmap(nullptr, memory.bytes(), PROT_READ | PROT_WRITE, MAP_SHARED, memory.fd(), 0);
  if (place == MAP_FAILED) no_memory(memory.bytes(), errno);
  memory_ = static_cast<std::byte*>(place);
  bytes_ = memory.bytes();
  if (::fcntl(memory.fd(), F_ADD_SEALS, F_SEAL_FUTURE_WRITE | F_SEAL_SEAL) != 0) {
    throw Error(ExitStatus::surroundings, "this kernel cannot share memory for reading only",
                "rasterizers run beside farop from Linux 5.1 on");
  }
}

WritableView::~WritableView() {
  if (memory_ != nullptr) ::munmap(memory_, bytes_);
}

}  // namespace farop::isolate
