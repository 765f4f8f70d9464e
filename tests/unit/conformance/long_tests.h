// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace farop::test {

/// How many random cases: `usual`, or `many` when the environment has FAROP_LONG_TESTS=1 (hours, for a
/// release).
inline std::uint64_t repetitions(std::uint64_t usual, std::uint64_t many) {
  const char* const value = std::getenv("FAROP_LONG_TESTS");
  return value != nullptr && *value == '1' ? many : usual;
}

/// Calls `check` with 0..count-1, from two threads where the machine has them. Returns what the first call
/// that did not return an empty string said, preceded by its number.
template <class Check>
std::string first_failure(std::uint64_t count, const Check& check) {
  constexpr std::uint64_t k_block = 64;
  std::atomic<std::uint64_t> next{0};
  std::atomic<bool> failed{false};
  std::string message;
  std::mutex mutex;
  const auto work = [&] {
    for (std::uint64_t begin = next.fetch_add(k_block); begin < count && !failed;
         begin = next.fetch_add(k_block)) {
      for (std::uint64_t i = begin; i < begin + k_block && i < count; ++i) {
        std::string wrong = check(i);
        if (wrong.empty()) continue;
        const std::lock_guard lock(mutex);
        if (!failed) message = std::to_string(i) + ": " + wrong;
        failed = true;
        return;
      }
    }
  };
  std::vector<std::thread> others;
  if (std::thread::hardware_concurrency() > 1) others.emplace_back(work);
  work();
  for (std::thread& t : others) t.join();
  return message;
}

}  // namespace farop::test
