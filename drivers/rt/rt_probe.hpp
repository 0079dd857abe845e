// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/drivers/rt_process.hpp"

namespace plumb::drivers::rt {

/// What an RtProcess made with this request is granted, tried in a child so that nothing stays.
/// Empty if there could be no child, or it did not live to tell.
std::vector<RtStep> try_rt_process(const RtRequest& request);

}  // namespace plumb::drivers::rt
