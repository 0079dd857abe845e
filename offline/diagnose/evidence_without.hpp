// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/judged_model.hpp"

namespace plumb::offline {

/// The evidence of an effect in the model without it, with the waves or moves that it has.
double evidence_as_it_is(const JudgedModel& without, const Found& found);

/// The same, or that of what the scan there lists in its place, if this is larger. The scan may not
/// list it: it may have been banned since, or stand there at fewer joints.
double evidence_without(const JudgedModel& without, const Found& found);

}  // namespace plumb::offline
