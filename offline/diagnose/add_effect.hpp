// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// Adds the effect found and refits all jointly. If the error hardly falls, the effect stays out
/// for good; an earlier effect that loses its evidence to the new one is taken out; an effect that
/// cannot be fitted is set aside.
void add_effect(Selection& selection, const Found& found);

}  // namespace plumb::offline
