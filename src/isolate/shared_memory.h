// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that the runner gets to see: made here, of a size that nobody can change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace farop::isolate {

/// `bytes` rounded up to pages.
constexpr std::uint64_t whole_pages(std::uint64_t bytes) {
  constexpr std::uint64_t k_page = 4096;
  return (bytes + k_page - 1) / k_page * k_page;
}

/// A file descriptor that closes itself.
class OwnedDescriptor {
 public:
  OwnedDescriptor() = default;
  explicit OwnedDescriptor(int fd) : fd_(fd) {}
  ~OwnedDescriptor() { reset(); }
  OwnedDescriptor(OwnedDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  OwnedDescriptor& operator=(OwnedDescriptor&& other) noexcept {
    if (this != &other) reset(std::exchange(other.fd_, -1));
    return *this;
  }
  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  void reset(int fd = -1);

 private:
  int fd_ = -1;
};

/// A memfd with a sealed size: if the runner could shrink it, a look at it would end this process (SIGBUS).
/// All functions throw Error(ExitStatus::surroundings) when the machine has no memory.
class SharedMemory {
 public:
  SharedMemory() = default;
  /// `bytes` of zeros, there for sure.
  SharedMemory(const char* name, std::uint64_t bytes);

  int fd() const { return memory_.get(); }
  std::uint64_t bytes() const { return bytes_; }
  explicit operator bool() const { return static_cast<bool>(memory_); }

  /// Copies in and out by system calls, which fail where a look at the memory would kill. read() is false
  /// when it could not be read.
  void write(std::uint64_t at, std::span<const std::byte> bytes);
  bool read(std::uint64_t at, std::span<std::byte> bytes) const;
  /// From now on nobody can write it.
  void make_constant();

 private:
  OwnedDescriptor memory_;
  std::uint64_t bytes_ = 0;
};

/// A SharedMemory that only this process can write, through one mapping.
class WritableView {
 public:
  WritableView() = default;
  /// Maps all of `memory` and forbids every further way to write it.
  explicit WritableView(const SharedMemory& memory);
  ~WritableView();
  WritableView(WritableView&& other) noexcept
      : memory_(std::exchange(other.memory_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  WritableView& operator=(WritableView&& other) noexcept {
    std::swap(memory_, other.memory_), std::swap(bytes_, other.bytes_);
    return *this;
  }
  std::span<std::byte> bytes() const { return {memory_, bytes_}; }

 private:
  std::byte* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace farop::isolate
