// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// The joint range in which random poses are tried.
using JointBox = std::vector<std::pair<double, double>>;

/// A pose at random, and whether the inverse refused it.
struct PoseTried {
  std::vector<double> q;  // [rad] or [m]
  bool refused = false;
};

/// ", most of all at J3 between -30 and 30 deg (62 %)": the band of a joint, a twelfth of its
/// range, in which the share of refusals is largest, if that is well above the mean; else empty.
std::string worst_band_words(std::span<const PoseTried> all, const JointBox& box,
                             const format::Chain& nominal);

/// Where the inverse refuses, so that the arm is not corrected there.
struct RefusalShare {
  int poses = 0;
  double refused = 0.0;        // share of the poses, 0 .. 1
  double near_singular = 0.0;  // those of them that lie near a singular pose or beyond it
  std::string where;           // of worst_band_words
};

inline constexpr int kRefusalPoses = 4000;

/// Tries kRefusalPoses poses in the box, the same ones every time, each with its own joints as seed
/// and nothing known of the context. Tens of milliseconds.
RefusalShare refusal_share(const format::Model& model, const JointBox& box);

}  // namespace plumb::offline
