// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plumb::offline {

/// A hidden effect as the user states it: NAME[=SIZE][:JOINT[=SIZE],...][:SIGMA][@KEY=NUMBER,...],
/// for example "drift=100um", "gear_harmonics:J2,J3", "joint_compliance:J2=150urad" or
/// "gear_ripple:J2:5@cycles=20". Units: um, mm, m, urad, mrad, rad, deg; or sigma, see size_sigma.
struct HiddenEffect {
  struct Part {
    int joint = 0;  // zero-based
    std::optional<double> size;
  };
  std::string name;
  std::optional<double> size;  // for the joints without a size of their own; SI
  /// Given instead of a size: the RMS per axis of the motion of the measured points that remains
  /// after geometry was fitted to it, divided by the noise.
  std::optional<double> size_sigma;
  std::vector<Part> joints;               // if empty, the usual joints of the law
  std::map<std::string, double> numbers;  // other numbers of the law, SI
};

}  // namespace plumb::offline
