// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>

#include "tests/drivers/rights.hpp"

namespace plumb::tests {

/// For a child of a test: from now on a file takes no more bytes than these, as on a disk that is
/// full.
inline void limit_files(rlim_t bytes) {
  ::signal(SIGXFSZ, SIG_IGN);
  set_limit(RLIMIT_FSIZE, bytes);
}

}  // namespace plumb::tests
