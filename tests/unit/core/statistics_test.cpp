// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/statistics.h"

#include <gtest/gtest.h>
#include <linux/perf_event.h>
#include <sys/mman.h>

#include <thread>

#include "core/hardware_counters.h"

namespace farop {
namespace {

constexpr std::size_t k_pages = 64, k_page = 4096;

/// At least one page fault each.
void touch_new_pages() {
  auto* const fresh = static_cast<volatile char*>(
      ::mmap(nullptr, k_pages * k_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  ::madvise(const_cast<char*>(fresh), k_pages * k_page, MADV_NOHUGEPAGE);
  for (std::size_t i = 0; i < k_pages; ++i) fresh[i * k_page] = 1;
  ::munmap(const_cast<char*>(fresh), k_pages * k_page);
}

/// Page faults are counted by the kernel itself, so virtual machines have them as well.
TEST(PerfCounter, CountsThisThreadAndThoseItStarts) {
  const PerfCounter faults(PERF_TYPE_SOFTWARE, PERF_COUNT_SW_PAGE_FAULTS);
  if (faults.error() != 0) GTEST_SKIP() << "perf_event_open: errno " << faults.error();
  const auto before = faults.read();
  touch_new_pages();
  const auto here = faults.read();
  std::thread(touch_new_pages).join();
  const auto both = faults.read();
  ASSERT_TRUE(before && here && both);
  EXPECT_GE(*here - *before, k_pages);
  EXPECT_LT(*here - *before, k_pages + 32);
  EXPECT_GE(*both - *here, k_pages);
}

TEST(PerfCounter, HasNoValueWhereTheKernelRefuses) {
  const PerfCounter nothing(12345, 0);
  EXPECT_NE(nothing.error(), 0);
  EXPECT_FALSE(nothing.read());
}

TEST(StageTime, AddsWhatWasCounted) {
  StageTime sum;
  sum += {1, 2, 3, std::nullopt, 10};
  EXPECT_FALSE(sum.cycles);
  sum += {1, 2, 3, 7, 5};
  EXPECT_EQ(sum.elapsed, 2);
  EXPECT_EQ(sum.user, 4);
  EXPECT_EQ(sum.system, 6);
  EXPECT_EQ(sum.cycles, 7u);
  EXPECT_EQ(sum.instructions, 15u);
}

TEST(StageTime, IsTheDifferenceOfTwoReadings) {
  const StageTime taken = time_between({10, 1, 2, 100, std::nullopt}, {11.5, 1.25, 2, 350, 7});
  EXPECT_EQ(taken.elapsed, 1.5);
  EXPECT_EQ(taken.user, 0.25);
  EXPECT_EQ(taken.system, 0);
  EXPECT_EQ(taken.cycles, 250u);
  EXPECT_FALSE(taken.instructions);
  EXPECT_EQ(time_between({0, 0, 0, 5, 5}, {0, 0, 0, 4, 4}).cycles, 0u) << "estimates may run backwards";
}

TEST(StageTimer, TakesClocksAndCountersAndTellsTheLog) {
  TraceLog log;
  StageTimer timer;
  timer.trace_to(&log, "polygon", TraceTrack::rasterizer);
  timer.start();
  const StageTime begun = read_clocks();
  volatile unsigned work = 0;
  while (read_clocks().user - begun.user + read_clocks().system - begun.system < 0.03) work = work + 1;
  timer.stop();
  const StageTime& t = timer.total();
  EXPECT_GE(t.user + t.system, 0.03);
  EXPECT_GT(t.elapsed, 0);
  const bool counts = HardwareCounters::of_process().cycles.error() == 0;
  EXPECT_EQ(t.cycles.has_value(), counts);
  if (counts) {
    EXPECT_GT(*t.cycles, 1'000'000u);
    EXPECT_GT(*t.instructions, 1'000'000u);
  }
  ASSERT_EQ(log.slices().size(), 1u);
  EXPECT_EQ(log.slices()[0].track, TraceTrack::rasterizer);
  EXPECT_DOUBLE_EQ(log.slices()[0].end - log.slices()[0].begin, t.elapsed);
}

}  // namespace
}  // namespace farop
