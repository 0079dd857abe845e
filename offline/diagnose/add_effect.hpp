// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// Adds what was found and refits jointly. What brings no real fall stays out for good; what loses
/// its evidence to the new effect is taken out; what cannot be fitted is set aside.
void add_effect(Selection& selection, const Found& found);

}  // namespace plumb::offline
