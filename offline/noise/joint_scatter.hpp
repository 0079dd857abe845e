// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "observe/line_table.hpp"

namespace plumb::offline {

/// Lines of a linear model y = U b + noise + scatter, pose by pose, all
/// divided by the stated sigma of the reading.
///
/// The scatter of a joint is a random angle (or shift) that is another one at every stop. It moves
/// all coordinates of the point together. Repeats that are read while the arm stands still do not
/// show it.
struct ScatterLines {
  Eigen::VectorXd y;                   // (lines,)
  Eigen::MatrixXd U;                   // (lines, rank) columns of the model, independent
  std::vector<Eigen::VectorXd> joint;  // (lines,) motion per rad or m of each joint
  LineTable table;                     // of the poses
  double noise_variance = 1.0;         // prior of the variance of a line
  double noise_dof = 0.0;              // degrees of freedom of that prior; 0: there is none

  Eigen::Index poses() const { return table.readings(); }
};

/// Variances of one model of the noise.
struct JointScatter {
  Eigen::VectorXd variance;     // of each joint [rad^2 or m^2]
  double noise_variance = 1.0;  // of a line
  bool none() const { return variance.size() == 0 || !(variance.maxCoeff() > 0.0); }
};

/// Sums over lines under one model of the noise, which are enough for its likelihood. Lines of
/// different stops are independent, so that they may be added a part at a time.
struct ScatterSums {
  Eigen::MatrixXd information;   // U^T V^-1 U
  Eigen::VectorXd gradient;      // U^T V^-1 y
  double squares = 0.0;          // y^T V^-1 y
  double ln_determinants = 0.0;  // of V
  double lines = 0.0;

  void add(const ScatterLines& lines, const JointScatter& at);
  /// Converts sums under noise of variance 1 without scatter to noise of another variance.
  ScatterSums with_noise(double variance) const;
};

/// Restricted log-likelihood of the ratios of the variances: the coefficients of the model are
/// integrated out, and so is a common factor of all variances, which has a prior of `noise_dof`
/// degrees of freedom about 1. The difference for the same y and U is the evidence [nats] for one
/// model of the noise over another. Cost: lines * rank^2. [Patterson & Thompson 1971]
double ln_likelihood_of_ratios(const ScatterSums& sums, double noise_dof);
double ln_likelihood_of_ratios(const ScatterLines& lines, const JointScatter& at);

/// The variances that maximise this likelihood, none negative. A variance that is 0 in `start`
/// stays 0. Monotone iterations [Zhou, Hu, Zhou & Lange 2019], at most `iterations` of lines * rank
/// * (rank + joints).
JointScatter estimated_scatter(const ScatterLines& lines, const JointScatter& start,
                               int iterations);

/// Noise without scatter, its variance estimated from the lines; or from their sums under noise of
/// variance 1, where `some` only gives the prior of the variance.
JointScatter noise_alone(const ScatterLines& lines);
JointScatter noise_alone(const ScatterSums& sums, const ScatterLines& some);

/// No scatter, and noise of variance 1.
JointScatter unit_noise(const ScatterLines& lines);

/// Noise and scatter of all joints, estimated first from some of the poses and then from more.
JointScatter noise_and_scatter(const ScatterLines& lines);

/// The scatter is estimated from at most so many poses, which bounds the time. `is_among` says
/// whether a pose is one of `most` that are picked evenly from all.
inline constexpr Eigen::Index kPosesOfScatter = 2500;
inline bool is_among(Eigen::Index pose, Eigen::Index poses, Eigen::Index most) {
  return poses <= most || pose * most / poses != (pose + 1) * most / poses;
}

}  // namespace plumb::offline
