// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Rows that are only computed with, for example a block of a long file: checked as
/// read_measurements does, but nobody looks for repeats or doubles, which matter to a fit alone.
/// `replicate_group` stays empty. Throws Failure (kInput) with all problems.
MeasurementFiles plain_rows(Table table, const JointColumns& joints);

}  // namespace plumb::offline
