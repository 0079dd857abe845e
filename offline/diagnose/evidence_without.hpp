// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/judged_model.hpp"

namespace plumb::offline {

/// The evidence of an effect in the model without it. Its scan may not list it: it may have been
/// banned since, or stand there at fewer joints.
double evidence_without(const JudgedModel& without, const Found& found);

}  // namespace plumb::offline
