// SPDX-License-Identifier: Apache-2.0
#include "cli/cell_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <set>
#include <thread>

#include "cli/progress.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kBetweenLooks = 20ms;

enum class Lock { kTaken, kBusy, kUnknown };

Lock try_lock(int fd) {
  if (::flock(fd, LOCK_EX | LOCK_NB) == 0) return Lock::kTaken;
  return errno == EWOULDBLOCK || errno == EINTR ? Lock::kBusy : Lock::kUnknown;
}

[[noreturn]] void give_up(const fs::path& folder, std::chrono::milliseconds waited) {
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-CELL-BUSY",
       .message = fmt::format("another plumb has been working in {} for {:.0f} s; nothing was "
                              "written",
                              display_name(folder), std::chrono::duration<double>(waited).count()),
       .help = "wait until it has ended, and try again; which one it is: ps -C plumb -o pid,args"});
}

void wait_for_lock(int fd, const fs::path& folder, std::chrono::milliseconds longest) {
  const Progress progress("waiting for another plumb in this cell");
  const auto begin = std::chrono::steady_clock::now();
  while (try_lock(fd) == Lock::kBusy) {
    if (std::chrono::steady_clock::now() - begin > longest) give_up(folder, longest);
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

}  // namespace

void lock_cell(const fs::path& folder, std::chrono::milliseconds longest) {
  static std::set<fs::path> locked;
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(folder, ignored);
  if (locked.contains(whole)) return;
  // Never closed: the lock ends with the process.
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;  // whoever writes there will say why it cannot
  if (try_lock(fd) == Lock::kBusy) {
    try {
      wait_for_lock(fd, folder, longest);
    } catch (...) {
      ::close(fd);
      throw;
    }
  }
  locked.insert(whole);
}

}  // namespace plumb::offline::cli
