// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumb::offline {

/// Lines of a linear model y = U b + noise + scatter, pose by pose, `axes` lines a pose, all
/// divided by the stated sigma of the reading.
///
/// The scatter of a joint is an angle (or a shift) that is drawn anew at every stop. It moves all
/// coordinates of the point together, and repeats that are read in place do not see it.
struct ScatterLines {
  Eigen::VectorXd y;                   // (lines,)
  Eigen::MatrixXd U;                   // (lines, rank) columns of the model, independent
  std::vector<Eigen::VectorXd> joint;  // (lines,) motion per rad or m of each joint
  int axes = 3;
  double noise_variance = 1.0;  // of a line; what is known of it beforehand,
  double noise_dof = 0.0;       // and the degrees of freedom behind it; 0: nothing is known

  Eigen::Index poses() const { return axes == 0 ? 0 : y.size() / axes; }
};

/// Variances of one model of the noise.
struct JointScatter {
  Eigen::VectorXd variance;     // of each joint [rad^2 or m^2]
  double noise_variance = 1.0;  // of a line
  bool none() const { return variance.size() == 0 || !(variance.maxCoeff() > 0.0); }
};

/// What lines add up to under one model of the noise: enough for its likelihood, whatever their
/// number. Lines of different stops are independent, so parts of them may be added one by one.
struct ScatterSums {
  Eigen::MatrixXd information;   // U^T V^-1 U
  Eigen::VectorXd gradient;      // U^T V^-1 y
  double squares = 0.0;          // y^T V^-1 y
  double ln_determinants = 0.0;  // of V
  double lines = 0.0;

  void add(const ScatterLines& lines, const JointScatter& at);
  /// What the sums under noise of variance 1 alone are under another variance.
  ScatterSums with_noise(double variance) const;
};

/// Restricted log-likelihood of the ratios of the variances: the model's columns are integrated
/// out, and so is the size of all variances together, of which `noise_dof` say that it is 1.
/// Differences for the same y and U are nats for one model of the noise over another. Cost: lines *
/// rank^2. [Patterson & Thompson 1971]
double ln_likelihood_of_ratios(const ScatterSums& sums, double noise_dof);
double ln_likelihood_of_ratios(const ScatterLines& lines, const JointScatter& at);

/// The variances that maximise it: none is negative. `start` with a variance of 0 keeps it at 0.
/// Monotone iterations [Zhou, Hu, Zhou & Lange 2019], at most `iterations` of
/// lines * rank * (rank + joints).
JointScatter estimated_scatter(const ScatterLines& lines, const JointScatter& start,
                               int iterations);

/// Noise alone, its variance as the lines tell it, or their sums under noise of variance 1; `some`
/// of the lines then only say what is known beforehand.
JointScatter noise_alone(const ScatterLines& lines);
JointScatter noise_alone(const ScatterSums& sums, const ScatterLines& some);

/// No scatter, and noise of variance 1.
JointScatter unit_noise(const ScatterLines& lines);

/// Noise and scatter of all joints, as the lines tell them: first on some of the poses, then on
/// more.
JointScatter noise_and_scatter(const ScatterLines& lines);

/// The most poses that are looked at for it, and whether it looks at this one of so many.
inline constexpr Eigen::Index kPosesOfScatter = 2500;
inline bool is_among(Eigen::Index pose, Eigen::Index poses, Eigen::Index most) {
  return poses <= most || pose * most / poses != (pose + 1) * most / poses;
}

}  // namespace plumb::offline
