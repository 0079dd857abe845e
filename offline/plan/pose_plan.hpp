// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "plan/circumstances.hpp"
#include "plan/d_optimal.hpp"
#include "plan/design_space.hpp"
#include "plan/pose_pool.hpp"

namespace plumb::offline {

/// What is asked for.
struct PlanRequest {
  int n = 30;  // measurements
  PoseRules rules;
  std::vector<EffectEntry> separate = {};  // two, or none
  std::vector<double> payloads_kg = {};    // loads that can be mounted; empty: see Circumstances
};

/// 1 sigma of a predicted reflector position, three axes together [m].
struct PredictionSigma {
  double mean = 0.0, worst = 0.0;
};

/// How far two effects can stand in for each other, geometry being free: share of the motion of the
/// one that the other reproduces, 0 .. 1; nothing if the poses hardly show the effect at all.
struct Reproduction {
  std::optional<double> a_by_b, b_by_a;
};

/// 1 sigma of a number of one of the effects to be told apart, SI; both effects and geometry free.
struct EffectSigma {
  std::string name, unit;
  std::optional<double> before;  // nothing if the poses measured do not show it
  double after = 0.0;
};

/// A lead of so many nats decides between two effects: 22,000 to 1.
inline constexpr double kDecided_nats = 10.0;

/// What the readings are expected to say of two effects A and B: by how much the true one is then
/// ahead of the other, as ln of a Bayes factor [nats].
struct ExpectedDecision {
  std::optional<double> today;  // A over B at the poses measured; none if nothing is
  double if_a = 0.0, if_b = 0.0;
  double least() const { return if_a < if_b ? if_a : if_b; }
  bool decided_already() const { return today && std::abs(*today) >= kDecided_nats; }
};

struct PlannedPose {
  std::string name;
  Eigen::VectorXd q;  // [rad] or [m]
  std::string note;
  ReadingOption how = {};  // of a separation
};

/// The poses to measure next, in the order of driving, and what they will bring.
struct PosePlan {
  std::vector<PlannedPose> poses;
  int measured = 0;    // poses that count already
  int parameters = 0;  // of geometry, frame, target and effects
  int pool = 0;        // poses looked at
  double sigma_m = 0.0;
  PredictionSigma before, after;  // over poses within the same rules; not of a separation
  double ln_det = 0.0;            // of the information gained
  double drive = 0.0;             // in ranges of the slowest joint
  Circumstances circumstances;    // of a separation
  ExpectedDecision expected;      // of a separation
  Reproduction apart_before, apart_after;
  std::vector<EffectSigma> numbers;  // of both effects
  std::vector<Problem> remarks;
};

}  // namespace plumb::offline
