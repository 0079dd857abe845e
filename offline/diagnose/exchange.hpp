// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// The first effects were chosen while the others were still missing. Each effect is therefore
/// taken out once and searched for again; true if a better one has replaced it.
bool exchange(Selection& selection);

}  // namespace plumb::offline
