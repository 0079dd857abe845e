// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// What is clearly wrong, but too small to be an effect beside the strongest one, may be the trace
/// of two others that the strongest one stands for; true if those leave only noise, and now stand
/// there.
bool doubt_strongest(Selection& selection);

}  // namespace plumb::offline
