// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// What was chosen first was chosen while the others were still missing. Each effect is taken out
/// once and looked for again; true if another one does its work better, and now stands there.
bool exchange(Selection& selection);

}  // namespace plumb::offline
