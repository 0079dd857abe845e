// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "answers/answers.hpp"
#include "figures/run_results.hpp"
#include "program/json.hpp"

namespace plumb::offline::workbench {

/// Every pose of a run as columns, for a page that draws them: joints in [deg] or [mm], measured
/// points and errors (measured - predicted) in the base frame [mm], known context, where
/// it fails. Cost: poses; 12,000 poses of six axes are 2 MB of text.
Json pose_columns(const figures::RunResults& results, const Answers& answers);

/// The arm at the pose of a row, as the run knows it: origins [mm] of the base, every joint frame,
/// the tool and the measured point, and the axes of each as unit vectors x, y, z in the base frame.
/// Throws Failure (kUsage) if there is no such row.
Json arm_frames(const figures::RunResults& results, int row);

/// The names of the contexts that some pose has: "temp_degC", "payload_kg".
std::vector<std::string> context_names(const ContextRows& rows);

}  // namespace plumb::offline::workbench
