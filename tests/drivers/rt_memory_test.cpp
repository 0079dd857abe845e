// SPDX-License-Identifier: Apache-2.0
// Memory of a real-time process: locked or denied, and no page fault in heap and stack once
// touched.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "plumb/drivers/rt_process.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/rights.hpp"

namespace plumb::drivers {
namespace {

using tests::in_child;

constexpr std::size_t kHeap = 4 << 20, kStack = 96 << 10;

long faults() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

void fill(volatile char* begin, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) begin[i] = 1;
}

[[gnu::noinline]] void use_stack() {
  char frame[kStack];
  fill(frame, sizeof(frame));
}

void use_heap() {
  char* const block = static_cast<char*>(std::malloc(kHeap));
  fill(block, kHeap);
  std::free(block);
}

int faults_of(void (*work)()) {
  const long before = faults();
  work();
  return static_cast<int>(std::min(200L, faults() - before));
}

const RtRequest kRequest{.priority = 0, .lock = RtRequest::Lock::kNone, .idle_latency_us = -1};

TEST(PageFaults, AreNoneInTheHeapThatWasTouched) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process(kRequest);
              return faults_of(use_heap);
            }));
}

TEST(PageFaults, AreNoneInTheStackThatWasTouched) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process(kRequest);
              return faults_of(use_stack);
            }));
}

TEST(PageFaults, AreSeenWithoutTheSetUp) {
  EXPECT_LT(100, in_child([] { return faults_of(use_heap); }));
  EXPECT_LT(5, in_child([] { return faults_of(use_stack); }));
}

/// VmLck of /proc/self/status.
long locked_kB() {
  std::ifstream in("/proc/self/status");
  for (std::string word; in >> word;)
    if (word == "VmLck:") return in >> word ? std::stol(word) : -1;
  return -1;
}

bool denied(const RtProcess& process, RtStepKind kind, int error) {
  return process.step(kind).grant == Grant::kDenied && process.step(kind).error == error;
}

TEST(LockedMemory, IsGrantedOnlyWhenItIsLocked) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process({.priority = 0});
              const bool granted = process.step(RtStepKind::kMemoryLocked).grant == Grant::kGranted;
              return granted == (locked_kB() > 8192) ? 0 : 1;
            }));
}

TEST(LockedMemory, IsDeniedWithoutRightsAndTheHeapIsTouchedAllTheSame) {
  EXPECT_EQ(0, in_child([] {
              tests::drop_rights();
              const RtProcess process({.priority = 0});
              if (!denied(process, RtStepKind::kMemoryLocked, EPERM)) return 1;
              if (process.step(RtStepKind::kHeapTouched).grant != Grant::kGranted) return 2;
              return process.complete() || locked_kB() != 0 ? 3 : faults_of(use_heap);
            }));
}

TEST(LockedMemory, IsDeniedByALimitThatIsTooSmall) {
  EXPECT_EQ(0, in_child([] {
              tests::set_limit(RLIMIT_MEMLOCK, 65536);
              tests::become_nobody();
              const RtProcess process({.priority = 0});
              if (!denied(process, RtStepKind::kMemoryLocked, ENOMEM)) return 1;
              return process.step(RtStepKind::kMemoryLocked).limit == 65536 ? 0 : 2;
            }));
}

TEST(LockedMemory, IsDeniedWhereLaterAllocationsWouldBe) {
  EXPECT_EQ(0, in_child([] {
              tests::set_limit(RLIMIT_MEMLOCK, 8 << 20);
              tests::become_nobody();
              const RtProcess process({.priority = 0, .heap_bytes = 8 << 20});
              if (!denied(process, RtStepKind::kMemoryLocked, ENOMEM)) return 1;
              void* volatile later = std::malloc(32 << 20);
              return later != nullptr ? 0 : 2;
            }));
}

TEST(LockedMemory, IsNoReasonToFallWhenThereIsLessHeapThanAskedFor) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process({.priority = 0, .heap_bytes = SIZE_MAX / 4});
              return denied(process, RtStepKind::kHeapTouched, ENOMEM) ? 0 : 1;
            }));
}

}  // namespace
}  // namespace plumb::drivers
