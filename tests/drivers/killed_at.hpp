// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace plumb::tests {

/// True for a system call that changes what is on the disk, or waits for it.
inline bool changes_files(const __ptrace_syscall_info& at) {
  static const std::set<std::uint64_t> kChanging{
#ifdef SYS_rename
      SYS_rename,    SYS_unlink,   SYS_mkdir,     SYS_rmdir,    SYS_symlink,   SYS_chmod,
#endif
      SYS_renameat2, SYS_unlinkat, SYS_mkdirat,   SYS_fchmodat, SYS_symlinkat, SYS_fchmod,
      SYS_write,     SYS_fsync,    SYS_fdatasync, SYS_ftruncate};
  if (at.entry.nr == SYS_openat) return (at.entry.args[2] & O_CREAT) != 0;
  return kChanging.contains(at.entry.nr);
}

enum class KilledAt { kKilled, kEnded, kImpossible };

/// Runs plumb-rt with these words and kills it before call number `number`, counted from 0, of
/// those that change files. kEnded: it made fewer.
inline KilledAt run_killed_at(std::vector<std::string> words, int number,
                              const std::filesystem::path& scratch) {
  words.insert(words.begin(), PLUMB_RT_PROGRAM);
  const std::string said = (scratch / "killed.out").string();
  const pid_t child = ::fork();
  if (child == 0) {
    const int out = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) ::_exit(126);
    ::raise(SIGSTOP);
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(argv.front(), argv.data());
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFSTOPPED(status)) return KilledAt::kImpossible;
  ::ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
  for (int seen = 0;;) {
    if (::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr) != 0) return KilledAt::kImpossible;
    ::waitpid(child, &status, 0);
    if (WIFEXITED(status) || WIFSIGNALED(status)) return KilledAt::kEnded;
    if (!WIFSTOPPED(status) || WSTOPSIG(status) != (SIGTRAP | 0x80)) continue;
    __ptrace_syscall_info at{};
    if (::ptrace(PTRACE_GET_SYSCALL_INFO, child, sizeof(at), &at) <= 0) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return KilledAt::kImpossible;
    }
    if (at.op != PTRACE_SYSCALL_INFO_ENTRY || !changes_files(at) || seen++ < number) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return KilledAt::kKilled;
  }
}

}  // namespace plumb::tests
