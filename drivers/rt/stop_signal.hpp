// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace plumb::drivers::rt {

/// From now on the first SIGTERM or SIGINT sets `stop`, and the second ends the program at once
/// as before this call, with exit code 130: nothing is ramped out or sent any more, the record
/// lacks what was not written yet, and the control socket stays for the next run to replace. One at
/// a time; `stop` must live as long as the program.
void stop_on_signal(std::atomic<bool>& stop);

}  // namespace plumb::drivers::rt
