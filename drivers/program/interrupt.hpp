// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb {

/// From now on SIGINT and SIGTERM end the program with exit code 130, after `last_words` went to
/// stdout; the text is copied. While a `Writing` exists the signals are
/// deferred, so that no temporary file is left behind.
void end_on_interrupt(const std::string& last_words);

class Writing {
 public:
  Writing();
  ~Writing();
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
};

}  // namespace plumb
