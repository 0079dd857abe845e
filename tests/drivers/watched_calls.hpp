// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "tests/heap_calls.hpp"

/// What a thread calls that a real-time one must not, counted in a child process.
///
/// Heap and locks are counted where heap_calls.hpp and watched_locks.hpp stand in for the C
/// library. System calls: a seccomp filter on that thread alone ends the child at any but those
/// allowed; so no futex passes, whoever calls it and how. Not seen: what the C library locks within
/// itself without a system call.
namespace plumb::tests {

struct WatchedCalls {
  std::atomic<long> heap{0}, locks{0};
  std::atomic<int> system_call{-1};  // number of the first that was not allowed
  std::atomic<long> cycles{0}, answered{0};
};

inline thread_local WatchedCalls* watching = nullptr;

inline void note_lock() noexcept {
  if (watching != nullptr) ++watching->locks;
}

inline void stop_at_system_call(int, siginfo_t* info, void*) {
  if (watching != nullptr) watching->system_call = info->si_syscall;
  ::_exit(0);
}

/// From now on this thread is watched; it may do these system calls and end. False: no filter can
/// be installed here.
inline bool watch_this_thread(WatchedCalls& calls, std::span<const int> allowed) {
  constexpr auto kNumber = static_cast<std::uint32_t>(offsetof(seccomp_data, nr));
  std::vector<sock_filter> code{BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kNumber)};
  for (const int number : allowed) {
    code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(number), 0, 1));
    code.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  }
  code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 0, 1));
  code.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  code.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP));
  const sock_fprog filter{.len = static_cast<unsigned short>(code.size()), .filter = code.data()};
  struct sigaction action {};
  action.sa_sigaction = stop_at_system_call;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  static std::vector<sock_filter> kept;  // freeing it would be a heap call
  kept.swap(code);
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) return false;
  watching = &calls;
  heap_calls_here = &calls.heap;
  return true;
}

enum class Ended { kWell, kNoFilter, kBadly };

/// Runs `work` in a child, which shows what it called and whether it could be watched.
inline Ended run_watched(WatchedCalls*& calls, const std::function<bool(WatchedCalls&)>& work) {
  constexpr int kNoFilter = 77;
  void* const shared = ::mmap(nullptr, sizeof(WatchedCalls), PROT_READ | PROT_WRITE,
                              MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return Ended::kBadly;
  calls = new (shared) WatchedCalls;
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work(*calls) ? 0 : kNoFilter);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (!WIFEXITED(status)) return Ended::kBadly;
  return WEXITSTATUS(status) == 0           ? Ended::kWell
         : WEXITSTATUS(status) == kNoFilter ? Ended::kNoFilter
                                            : Ended::kBadly;
}

}  // namespace plumb::tests
