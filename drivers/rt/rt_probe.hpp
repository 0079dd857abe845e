// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/drivers/rt_process.hpp"

namespace plumb::drivers::rt {

/// The steps of an RtProcess with this request, tried in a child process so that this process is
/// not changed. Empty if the child could not be created or ended early.
std::vector<RtStep> try_rt_process(const RtRequest& request);

}  // namespace plumb::drivers::rt
