// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// A pose at random, and whether the inverse refused it.
struct PoseTried {
  std::vector<double> q;  // [rad] or [m]
  bool refused = false;
};

/// Poses that are refused with a joint near one position. Of a revolute joint every half turn
/// counts: 5 deg stands for 5 deg and -175 deg.
struct RefusedPlace {
  std::size_t joint = 0;
  double at = 0.0;      // [rad], 0 .. pi; of a prismatic joint [m]
  double within = 0.0;  // [rad] or [m]
  double share = 0.0;   // of all poses, 0 .. 1; none counted at two places
};

/// Where poses are refused: at most three places, the one with most refusals first. In a place
/// refusals are at least five times as frequent as on average. Of several widths the narrowest is
/// taken that holds at least 80 % of the refusals of the fullest.
std::vector<RefusedPlace> refused_places(std::span<const PoseTried> all,
                                         const format::Chain& nominal);

/// What the inverse does with poses at random: in the trained range, and between the joint limits.
struct RefusalShare {
  struct Shares {
    double refused = 0.0;  // share of the poses, 0 .. 1
    double partial = 0.0;  // corrected in part
  };
  int poses = 0;  // tried in either
  Shares trained, limits;
  std::vector<RefusedPlace> places;  // of those between the limits
};

inline constexpr int kRefusalPoses = 4000;

/// Tries kRefusalPoses poses in either range, the same ones every time, each with its own joints as
/// seed and nothing known of the context. About 0.2 s.
RefusalShare refusal_share(const format::Model& model);

/// "Of 4000 random poses in the trained range 1.3 % are refused, 7.5 % are corrected in part.
/// Between the joint limits 2.1 % are refused: 1.2 % with J5 within 2 deg of 0 or 180 deg, 0.9 %
/// elsewhere; 3.4 % are corrected in part."
std::string refusal_sentence(const RefusalShare& share, const format::Chain& nominal);

}  // namespace plumb::offline
