// SPDX-License-Identifier: Apache-2.0
#include "workbench/child.hpp"

#include <fmt/format.h>

#include <system_error>

#include "program/problem.hpp"

namespace plumb::offline::workbench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void no_child(const ChildCommand& command, const std::system_error& error) {
  const std::string why = error.code() == std::errc::timed_out ? "it did not end in time"
                          : error.code() == std::errc::no_such_file_or_directory
                              ? "it is not there"
                              : error.code().message();
  throw Failure(Exit::kEnvironment,
                {.code = "E-SERVE-CHILD",
                 .message = fmt::format("{} cannot be run: {}", command.words.front(), why),
                 .help = "check that it is installed beside plumb, and the limits: ulimit -a"});
}

}  // namespace

std::unique_ptr<Child> started(const ChildCommand& command) {
  try {
    return std::make_unique<Child>(command);
  } catch (const std::system_error& error) {
    no_child(command, error);
  }
}

ShortRun finished(const ChildCommand& command, std::chrono::milliseconds longest,
                  const std::atomic<bool>& stop) {
  try {
    return run_to_end(command, longest, stop);
  } catch (const std::system_error& error) {
    no_child(command, error);
  }
}

fs::path own_program() { return "/proc/self/exe"; }

fs::path beside_own_program(const char* name) {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path() / name;
}

}  // namespace plumb::offline::workbench
