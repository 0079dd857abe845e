// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>

#include "program/child.hpp"

namespace plumb::offline::workbench {

/// `Child` of a command. Throws Failure (kEnvironment, E-SERVE-CHILD) if no process can be made.
std::unique_ptr<Child> started(const ChildCommand& command);

/// `run_to_end` of a command. Throws Failure (kEnvironment, E-SERVE-CHILD) if it cannot be started,
/// or does not end in time.
ShortRun finished(const ChildCommand& command, std::chrono::milliseconds longest,
                  const std::atomic<bool>& stop);

/// The path of this very program, which stays valid when the file is replaced, and a program that
/// lies beside it.
std::filesystem::path own_program();
std::filesystem::path beside_own_program(const char* name);

}  // namespace plumb::offline::workbench
