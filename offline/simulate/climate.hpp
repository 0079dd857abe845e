// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "simulate/arm.hpp"
#include "simulate/random.hpp"

namespace plumb::offline::sim {

/// Temperatures above 20 degC during a session, as functions of time. The air temperature
/// oscillates with the heating of the hall and drifts. The drives heat the column and every link,
/// each zone with its own first-order lag, and pause for a while in the middle of the session.
///   T_zone' = (T_air + rise_zone work(t) - T_zone) / lag_zone, T_zone(0) = T_air(0)
class Climate {
 public:
  /// `spread` is the variation between the zones; 0 makes them all equal. `session_s` decides only
  /// when the pause is and how long the table is.
  Climate(int joints, double session_s, double spread, Random random);

  double air(double time_s) const;
  /// The temperatures of the zones: [0] is the column, [i] the link behind joint i.
  VectorXd zones(double time_s) const;
  double period_s() const { return period_s_; }
  const VectorXd& rises() const { return rise_; }
  const VectorXd& lags() const { return lag_; }

 private:
  double work(double time_s) const;

  double period_s_, phase_, swing_K_, drift_K_per_hour_;
  double pause_begin_s_, pause_end_s_;
  double step_s_;
  VectorXd rise_, lag_;
  std::vector<VectorXd> table_;
};

}  // namespace plumb::offline::sim
