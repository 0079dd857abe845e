// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// If `best` are waves of a joint to which the selection has added waves before: those were found
/// while other effects were missing, so they are taken out, and all waves of the joint are searched
/// for again together. Returns what is to be added then; any other `best` unchanged.
Found with_fresh_waves(Selection& selection, Found best);

}  // namespace plumb::offline
