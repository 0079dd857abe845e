// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cell/joint_columns.hpp"
#include "cell/measurements.hpp"
#include "cell/needed_columns.hpp"

namespace plumb::offline {

/// Reads measurement files of an arm with these joints and joins them.
/// Throws Failure with all problems of all files (exit 3): missing q1 … qn, quaternions not of unit
/// length, no measured axis, no rows, too many joints.
MeasurementFiles read_measurements(const std::vector<std::filesystem::path>& files,
                                   const JointColumns& joints, Needs needs);

/// Rows that are only computed with, for example a block of a long file: checked as
/// read_measurements does, but nobody looks for repeats or doubles, which matter to a fit alone.
/// `replicate_group` stays empty. Throws Failure (kInput) with all problems.
MeasurementFiles plain_rows(Table table, const JointColumns& joints);

}  // namespace plumb::offline
