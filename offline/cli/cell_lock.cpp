// SPDX-License-Identifier: Apache-2.0
#include "cli/cell_lock.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "cli/progress.hpp"
#include "program/file.hpp"
#include "program/folder_lock.hpp"
#include "program/problem.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void give_up(const fs::path& folder, std::chrono::milliseconds waited) {
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-CELL-BUSY",
       .message = fmt::format("another plumb has been working in {} for {:.0f} s; nothing was "
                              "written",
                              display_name(folder), std::chrono::duration<double>(waited).count()),
       .help = "wait until it has ended, and try again; which one it is: ps -C plumb -o pid,args"});
}

}  // namespace

void lock_cell(const fs::path& folder, std::chrono::milliseconds longest) {
  static std::map<fs::path, FolderLock> locked;  // until the process ends
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(folder, ignored);
  if (locked.contains(whole)) return;
  FolderLock lock(folder);
  if (lock.state() == FolderLock::State::kBusy) {
    const Progress progress("waiting for another plumb in this cell");
    if (lock.wait(longest) == FolderLock::State::kBusy) give_up(folder, longest);
  }
  // A folder that does not exist cannot be locked; whoever writes into it reports that.
  if (lock.state() == FolderLock::State::kHeld) locked.emplace(whole, std::move(lock));
}

}  // namespace plumb::offline::cli
