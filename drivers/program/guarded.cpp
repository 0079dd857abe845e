// SPDX-License-Identifier: Apache-2.0
#include "program/guarded.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "plumb/format/version.hpp"

namespace plumb {
namespace {

void fail(Outcome& outcome, Exit exit, Problem problem) {
  outcome.exit = exit;
  outcome.errors = {std::move(problem)};
}

Problem bug(const std::string& program, const char* what) {
  return {.code = "E-BUG",
          .message = fmt::format("this is a bug in {} {}: {}", program, format::kVersion, what),
          .help = "report it with the command and, if you may, the input files"};
}

}  // namespace

void guarded(const std::string& program, const std::function<void()>& work, Outcome& outcome) {
  try {
    work();
  } catch (const Failure& failure) {
    outcome.exit = failure.exit_code();
    outcome.errors = failure.problems();
  } catch (const std::filesystem::filesystem_error& error) {
    fail(outcome, Exit::kEnvironment,
         {.code = "E-FILES",
          .message = fmt::format("{}: {}", error.path1().string(), error.code().message()),
          .help = "check the path, free space and permissions: df -h"});
  } catch (const std::bad_alloc&) {
    fail(outcome, Exit::kEnvironment,
         {.code = "E-MEMORY", .message = "out of memory", .help = "free -h"});
  } catch (const std::exception& error) {
    fail(outcome, Exit::kBug, bug(program, error.what()));
  } catch (...) {
    fail(outcome, Exit::kBug, bug(program, "an exception of unknown type"));
  }
}

}  // namespace plumb
