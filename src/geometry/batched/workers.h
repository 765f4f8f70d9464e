// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#include "core/task_order.h"

namespace farop::batched {

/// Threads for work that falls apart into independent pieces.
class Workers {
 public:
  /// More threads than the machine has processors only when asked for.
  explicit Workers(int threads)
      : more_(tbb::global_control::max_allowed_parallelism,
              static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency()))),
        arena_(threads) {}

  /// Calls work(i, worker) for every i < count, in any order; `worker`, below the number of threads, names
  /// the thread. The caller works too. Passes on what `work` throws.
  template <class Work>
  void run(std::size_t count, const Work& work) {
    TaskOrder order;
    const auto in_order = [&](std::size_t i) {
      order.begin();
      work(i, static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
      order.end();
    };
    order.before_all();
    arena_.execute([&] { tbb::parallel_for(std::size_t{0}, count, in_order, tbb::simple_partitioner()); });
    order.after_all();
  }

 private:
  tbb::global_control more_;
  tbb::task_arena arena_;
};

}  // namespace farop::batched
