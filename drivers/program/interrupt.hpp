// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/problem.hpp"

namespace plumb {

/// From now on SIGINT and SIGTERM end the program with exit code 130, after `last_words` went to
/// stdout; the text is copied. Who does not read within a second misses it. While a `Writing`
/// exists the signals are deferred, so that no temporary file is left behind.
void end_on_interrupt(const std::string& last_words);

/// Ends the program with this code unless it has ended within a second: a reader who takes nothing
/// does not keep it. May be called by the handler of a signal.
void end_within_a_second(Exit exit) noexcept;

class Writing {
 public:
  Writing();
  ~Writing();
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
};

}  // namespace plumb
