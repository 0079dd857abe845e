// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "figures/run_results.hpp"

namespace plumb::offline::figures {

/// What a joint would have to turn (or slide) by to explain the error of a pose, over its own
/// angle. r = m.e / m.m with m the motion of the measured point per unit of the joint, [rad] or
/// [m]; the weight m.m is large where the pose shows the joint well.
struct JointResidual {
  int joint = 0;
  std::string name = {};  // "J2"
  bool turns = true;      // false: it slides
  struct Pose {
    int row = 0;
    double q = 0.0, value = 0.0, weight = 0.0;
    int side = 0;  // from which it came: -1, +1, 0 unknown
    bool held = false;
  };
  std::vector<Pose> poses = {};  // by q
  /// Local mean, weighted with m.m and with a Gaussian in q, and half the width of its 95 %
  /// interval. The width of the Gaussian, an eighth to a sixty-fourth of the range, is that which
  /// predicts poses best that are left out of the mean one by one.
  struct Mean {
    double q = 0.0, value = 0.0, half = 0.0;
  };
  std::vector<Mean> curve = {};
  double rms = 0.0, rms_without_curve = 0.0;  // weighted
};

/// The residuals of every joint that moves, in the order of the arm. Cost: joints * (poses log
/// poses + 100 poses).
std::vector<JointResidual> joint_residuals(const RunResults& results);

/// Weighted scatter of values about their mean.
struct Scatter {
  double w = 0.0, sum = 0.0, squares = 0.0;
  void add(double weight, double value) {
    w += weight, sum += weight * value, squares += weight * value * value;
  }
  double about_mean() const { return w > 0.0 ? squares - sum * sum / w : 0.0; }

  /// The share (0 .. 1) of the scatter `before` that is gone.
  double explained_of(const Scatter& before) const {
    const double all = before.about_mean();
    return all > 0.0 && about_mean() < all ? 1.0 - about_mean() / all : 0.0;
  }
};

/// The names of the axes of a joint: "deg" or "mm" of its position, "µrad" or "µm" of a deviation,
/// and how many of the former a radian or metre has.
const char* position_unit(const JointResidual& joint);
const char* deviation_unit(const JointResidual& joint);
double position_per(const JointResidual& joint);

/// One joint, large, with the law that the run fitted for it or else the local mean; and all joints
/// as small panels on one locked scale.
std::string joint_figure(const RunResults& results, const JointResidual& joint, double width);
std::string joints_figure(const RunResults& results, double width);

}  // namespace plumb::offline::figures
