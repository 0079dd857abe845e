// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace plumb::drivers::rt {

/// From now on the first SIGTERM or SIGINT sets `stop`. The second ends the program at once with
/// exit code 130: the correction is not ramped out, unwritten lines of the record are lost, and the
/// control socket remains until the next run replaces it. May be active only once at a time; `stop`
/// must live as long as the program.
void stop_on_signal(std::atomic<bool>& stop);

}  // namespace plumb::drivers::rt
