// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/selection.hpp"

namespace plumb::offline {

/// Chooses the prior of a series anew, once all else is in the model: until then its waves had to
/// explain more than uneven gears do. Of the priors that predict as well the narrowest is taken
/// (see SeriesPriorSearch). Once a series; false if nothing changed.
bool narrow_series(Selection& selection);

}  // namespace plumb::offline
