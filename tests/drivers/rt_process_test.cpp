// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/rt_process.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/drivers/child.hpp"
#include "tests/drivers/rights.hpp"

namespace plumb::drivers {
namespace {

using tests::drop_rights;
using tests::in_child;

/// 1 if the step is not `grant` with `error`; a child adds such marks up to its exit code.
int wrong(const RtProcess& process, RtStepKind kind, Grant grant, int error) {
  const RtStep& step = process.step(kind);
  return step.kind == kind && step.grant == grant && step.error == error ? 0 : 1;
}

TEST(RtProcess, IsDeniedPriorityWithoutRightsAndGoesOn) {
  EXPECT_EQ(0, in_child([] {
              drop_rights();
              const RtProcess process({});
              return wrong(process, RtStepKind::kPriority, Grant::kDenied, EPERM) +
                     2 * wrong(process, RtStepKind::kStackTouched, Grant::kGranted, 0) +
                     4 * wrong(process, RtStepKind::kTimerSlack, Grant::kGranted, 0) +
                     8 * (process.complete() ? 1 : 0) +
                     16 * (process.step(RtStepKind::kPriority).limit == 0 ? 0 : 1);
            }));
}

TEST(RtProcess, SaysGrantedOnlyOfAPriorityThatItHas) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process({.priority = 42});
              const bool granted = process.step(RtStepKind::kPriority).grant == Grant::kGranted;
              sched_param parameter{};
              ::sched_getparam(0, &parameter);
              const bool has = ::sched_getscheduler(0) == SCHED_FIFO;
              return (granted == has ? 0 : 1) + (!has || parameter.sched_priority == 42 ? 0 : 2);
            }));
}

TEST(RtProcess, IsDeniedAPriorityThatDoesNotExist) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process({.priority = 100});
              return wrong(process, RtStepKind::kPriority, Grant::kDenied, EINVAL);
            }));
}

TEST(RtProcess, SkipsWhatIsNotAskedFor) {
  const RtProcess process({.priority = 0,
                           .heap_bytes = 0,
                           .stack_bytes = 0,
                           .lock = RtRequest::Lock::kNone,
                           .idle_latency_us = -1});
  for (const auto kind : {RtStepKind::kPriority, RtStepKind::kHeapKept, RtStepKind::kHeapTouched,
                          RtStepKind::kStackTouched, RtStepKind::kMemoryLocked,
                          RtStepKind::kIdleStates, RtStepKind::kAffinity})
    EXPECT_EQ(process.step(kind).grant, Grant::kSkipped) << describe(process.step(kind)).what;
  EXPECT_TRUE(process.complete());
}

TEST(RtProcess, StaysOnTheProcessorsAskedForAndRefusesThoseThatAreNotThere) {
  EXPECT_EQ(0, in_child([] {
              cpu_set_t before;
              ::sched_getaffinity(0, sizeof(before), &before);
              int first = 0;
              while (!CPU_ISSET(static_cast<std::size_t>(first), &before)) ++first;
              const int mine[] = {first}, none[] = {-1}, huge[] = {CPU_SETSIZE}, absent[] = {1023};
              const RtProcess one({.processors = mine});
              cpu_set_t after;
              ::sched_getaffinity(0, sizeof(after), &after);
              return wrong(one, RtStepKind::kAffinity, Grant::kGranted, 0) +
                     2 * (CPU_COUNT(&after) == 1 ? 0 : 1) +
                     4 * wrong(RtProcess({.processors = none}), RtStepKind::kAffinity,
                               Grant::kDenied, EINVAL) +
                     8 * wrong(RtProcess({.processors = huge}), RtStepKind::kAffinity,
                               Grant::kDenied, EINVAL) +
                     16 * wrong(RtProcess({.processors = absent}), RtStepKind::kAffinity,
                                Grant::kDenied, EINVAL);
            }));
}

TEST(RtProcess, RefusesMoreStackThanThereIsInsteadOfFalling) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process({.priority = 0, .stack_bytes = SIZE_MAX / 4});
              return wrong(process, RtStepKind::kStackTouched, Grant::kDenied, ENOMEM);
            }));
}

/// A file that stands for /dev/cpu_dma_latency.
class IdleFile {
 public:
  IdleFile() {
    const int file = ::mkstemp(name_.data());
    if (file >= 0) ::close(file);
  }
  ~IdleFile() { std::filesystem::remove(name_); }
  const char* name() const { return name_.c_str(); }
  bool held() const {
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      std::error_code ignored;
      if (std::filesystem::read_symlink(entry.path(), ignored) == name_) return true;
    }
    return false;
  }

 private:
  std::string name_ = (std::filesystem::temp_directory_path() / "plumb-idle-XXXXXX").string();
};

TEST(RtProcess, KeepsTheProcessorsFromDeepIdleStatesWhileItLives) {
  const IdleFile file;
  {
    const RtProcess process({.priority = 0,
                             .lock = RtRequest::Lock::kNone,
                             .idle_latency_us = 3,
                             .idle_latency_file = file.name()});
    EXPECT_EQ(process.step(RtStepKind::kIdleStates).grant, Grant::kGranted);
    EXPECT_TRUE(file.held());
  }
  EXPECT_FALSE(file.held());
  std::ifstream in(file.name(), std::ios::binary);
  std::int32_t written = 0;
  in.read(reinterpret_cast<char*>(&written), sizeof(written));
  EXPECT_EQ(written, 3);
  EXPECT_EQ(std::filesystem::file_size(file.name()), 4U);
}

TEST(RtProcess, SaysWhyIdleStatesCannotBeHeld) {
  EXPECT_EQ(0, in_child([] {
              const RtProcess process({.priority = 0, .idle_latency_file = "/no/such/file"});
              return wrong(process, RtStepKind::kIdleStates, Grant::kDenied, ENOENT);
            }));
  const IdleFile file;
  std::filesystem::permissions(file.name(), std::filesystem::perms::none);
  EXPECT_EQ(0, in_child([&] {
              drop_rights();
              const RtProcess process({.priority = 0, .idle_latency_file = file.name()});
              return wrong(process, RtStepKind::kIdleStates, Grant::kDenied, EACCES);
            }));
}

TEST(RtStep, TellsTheSystemsReasonTheLimitAndARemedyThatCanBePasted) {
  const Finding priority = describe({.kind = RtStepKind::kPriority,
                                     .grant = Grant::kDenied,
                                     .error = EPERM,
                                     .asked = 80,
                                     .limit = 0});
  EXPECT_EQ(priority.why, "SCHED_FIFO 80: Operation not permitted; RLIMIT_RTPRIO is 0");
  EXPECT_EQ(priority.remedy,
            "echo \"$USER - rtprio 99\" | sudo tee -a /etc/security/limits.d/plumb.conf");
  const Finding memory = describe({.kind = RtStepKind::kMemoryLocked,
                                   .grant = Grant::kDenied,
                                   .error = ENOMEM,
                                   .limit = 65536});
  EXPECT_EQ(memory.why,
            "mlockall(MCL_CURRENT | MCL_FUTURE): Cannot allocate memory; RLIMIT_MEMLOCK is 64 kB");
}

TEST(RtStep, EveryStepHasItsWordsAndOnlyDenialsARemedy) {
  const RtProcess process({.priority = 0, .lock = RtRequest::Lock::kNone, .idle_latency_us = -1});
  for (RtStep step : process.steps())
    for (const auto grant : {Grant::kGranted, Grant::kDenied, Grant::kSkipped}) {
      step.grant = grant;
      const Finding words = describe(step);
      EXPECT_FALSE(words.what.empty());
      EXPECT_FALSE(words.why.empty());
      EXPECT_EQ(words.remedy.find('\n'), std::string::npos);
      EXPECT_TRUE(grant == Grant::kDenied || words.remedy.empty()) << words.what;
    }
}

}  // namespace
}  // namespace plumb::drivers
