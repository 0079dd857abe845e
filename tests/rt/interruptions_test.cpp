// SPDX-License-Identifier: Apache-2.0
// A warm cycle never faults a page in and never waits: the kernel's own counters of the thread.
// Involuntary switches belong to the machine and its other programs; they are printed.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>

#include "tests/rt/gate_arms.hpp"
#include "tests/rt/whole_cycle.hpp"

namespace plumb {
namespace {

constexpr long kWarmUp = 1000;

struct Interruptions {
  long minor_faults, major_faults, waits, preemptions;
};

Interruptions so_far() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return {usage.ru_minflt, usage.ru_majflt, usage.ru_nvcsw, usage.ru_nivcsw};
}

template <class F>
Interruptions interruptions_of(F body) {
  const Interruptions before = so_far();
  body();
  const Interruptions after = so_far();
  return {after.minor_faults - before.minor_faults, after.major_faults - before.major_faults,
          after.waits - before.waits, after.preemptions - before.preemptions};
}

/// As a real-time process does at its start; the kernel may not take a page back.
class Interrupted : public testing::Test {
 protected:
  void SetUp() override { locked_ = mlockall(MCL_CURRENT | MCL_FUTURE) == 0; }
  void TearDown() override { munlockall(); }
  bool locked_ = false;
};

class Cycle : public Interrupted {
 protected:
  void expect_none_in(const format::Model& model, long cycles) {
    tests::WholeCycle cycle(model);
    cycle.run(kWarmUp);
    const Interruptions seen = interruptions_of([&] { cycle.run(cycles); });
    std::printf(
        "%ld cycles: %ld minor and %ld major faults, %ld waits, %ld preemptions, pages %s\n",
        cycles, seen.minor_faults, seen.major_faults, seen.waits, seen.preemptions,
        locked_ ? "locked" : "not locked");
    EXPECT_EQ(seen.minor_faults, 0);
    EXPECT_EQ(seen.major_faults, 0);
    EXPECT_EQ(seen.waits, 0);
    EXPECT_GT(cycle.valid(), 0);
  }
};

TEST_F(Cycle, NeverFaultsOrWaitsInAMillionTimes) { expect_none_in(tests::one_arm(), 1'000'000); }

TEST_F(Cycle, NeverFaultsOrWaitsWithEveryLawAFormulaAndBlendedTrees) {
  expect_none_in(tests::every_law_arm(), 50'000);
}

TEST_F(Cycle, NeverFaultsOrWaitsWithSixEffectsAndThreeHundredLeaves) {
  expect_none_in(tests::cycle_model(), 50'000);
}

TEST(Planted, FaultOfAFreshPageIsSeen) {
  const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* page = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(page, MAP_FAILED);
  const Interruptions seen = interruptions_of([&] { *static_cast<volatile char*>(page) = 1; });
  EXPECT_GT(seen.minor_faults + seen.major_faults, 0);
  munmap(page, size);
}

TEST(Planted, WaitIsSeen) {
  const Interruptions seen = interruptions_of([] {
    const timespec a_while{0, 1'000'000};
    nanosleep(&a_while, nullptr);
  });
  EXPECT_GT(seen.waits, 0);
}

}  // namespace
}  // namespace plumb
