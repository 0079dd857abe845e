// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "noise/error_stats.hpp"
#include "plumb/format/model.hpp"
#include "program/json.hpp"

/// What programs read: units in key names, mm and deg, never NaN.
namespace plumb::offline::show {

using plumb::Json;
using plumb::put;
using plumb::put_null;
using plumb::to_text;

/// {n, mean_mm, rms_mm, p95_mm, max_mm}; null with reason if n == 0.
Json stats_json(const ErrorStats& stats);

/// {xyz_mm, quat_wxyz}
Json pose_json(const format::Pose& pose);

/// [{joint, by, ratio}], joints from 1
Json coupling_json(const std::vector<format::JointCoupling>& coupling);

}  // namespace plumb::offline::show
