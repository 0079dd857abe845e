// SPDX-License-Identifier: Apache-2.0
// No system call in the cycle: a child runs a million of them under a filter that kills it at any
// call but exit.
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>

#include "tests/rt/gate_arms.hpp"
#include "tests/rt/whole_cycle.hpp"

namespace plumb {
namespace {

constexpr int kNoFilter = 77;  // exit code of a child that could not install it
constexpr long kWarmUp = 1000;

/// Allows exit and exit_group, kills at everything else.
bool install_filter() {
  constexpr auto kNumber = static_cast<std::uint32_t>(offsetof(seccomp_data, nr));
  sock_filter code[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kNumber),
                        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 2, 0),
                        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 1, 0),
                        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
                        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog filter{.len = std::size(code), .filter = code};
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// How a child ends that runs `body`, which gives its exit code, under the filter.
template <class F>
int end_of_filtered_child(F body) {
  const pid_t child = fork();
  if (child == 0) {
    if (!install_filter()) _exit(kNoFilter);
    _exit(body());
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

bool filter_is_missing(int status) { return WIFEXITED(status) && WEXITSTATUS(status) == kNoFilter; }

bool killed_by_filter(int status) { return WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS; }

void expect_none_in(const format::Model& model, long cycles) {
  tests::WholeCycle cycle(model);
  cycle.run(kWarmUp);
  const int status = end_of_filtered_child([&] {
    cycle.run(cycles);
    return cycle.valid() > 0 ? 0 : 1;
  });
  if (filter_is_missing(status)) GTEST_SKIP() << "no seccomp filter can be installed here";
  EXPECT_FALSE(killed_by_filter(status)) << "a cycle called the system";
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(SystemCalls, NeverHappenInAMillionCycles) { expect_none_in(tests::one_arm(), 1'000'000); }

TEST(SystemCalls, NeverHappenWithEveryLawAFormulaAndBlendedTrees) {
  expect_none_in(tests::every_law_arm(), 50'000);
}

TEST(SystemCalls, NeverHappenWithSixEffectsAndThreeHundredLeaves) {
  expect_none_in(tests::cycle_model(), 50'000);
}

TEST(SystemCalls, AreCaughtWhenPlanted) {
  const auto writes = [] { return static_cast<int>(write(STDERR_FILENO, "", 0)); };
  const auto asks = [] { return static_cast<int>(syscall(SYS_getpid)); };
  const auto sleeps = [] {
    const timespec short_time{0, 1};
    return nanosleep(&short_time, nullptr);
  };
  const int status = end_of_filtered_child(writes);
  if (filter_is_missing(status)) GTEST_SKIP() << "no seccomp filter can be installed here";
  EXPECT_TRUE(killed_by_filter(status));
  EXPECT_TRUE(killed_by_filter(end_of_filtered_child(asks)));
  EXPECT_TRUE(killed_by_filter(end_of_filtered_child(sleeps)));
}

}  // namespace
}  // namespace plumb
