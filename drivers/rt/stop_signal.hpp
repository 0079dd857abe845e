// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace plumb::drivers::rt {

/// From now on the first SIGTERM or SIGINT sets `stop`, and the second ends the program at once
/// with exit code 130. One at a time; `stop` must live as long as the program.
void stop_on_signal(std::atomic<bool>& stop);

}  // namespace plumb::drivers::rt
