// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/runtime/loaded_model.hpp"

namespace plumb::drivers::rt {

/// By how much two models of one robot correct differently, at the worst of the poses compared.
struct ModelChange {
  double position_m = 0.0;
  double rotation_rad = 0.0;  // 0 for models that correct positions only
  std::vector<double> q;      // where the position changes most, joint positions [rad] or [m]
  int compared = 0;           // poses that both models solve
};

inline constexpr int kComparedPoses = 2000;

/// Compares the corrections of both models, each cut to its own guard's size, at kComparedPoses
/// poses: half of them within the joint limits (one turn at most), half within the trained range of
/// `next`. Every other pose has a known payload, temperatures and direction of travel. The poses
/// are the same ones every time. Poses that a model refuses are not compared: there the correction
/// ramps out. Both must be models of one robot. Pure; tens of milliseconds; any thread.
ModelChange find_change(const LoadedModel& running, const LoadedModel& next);

}  // namespace plumb::drivers::rt
