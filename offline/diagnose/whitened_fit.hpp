// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"
#include "observe/line_table.hpp"
#include "observe/reading.hpp"
#include "plumb/runtime/detail/effect.hpp"
#include "solve/orthonormal.hpp"

namespace plumb::offline {

/// How well one measured coordinate is known, in units of its stated sigma.
struct NoiseScale {
  double variance = 1.0;  // of a whitened coordinate
  double dof = 0.0;       // behind that number
  bool known = false;     // false: nothing is known of the noise but the residuals themselves
};

/// Consecutive rows that are held out together; the last segment holds the poses held out for good.
struct Segment {
  Eigen::Index begin = 0, end = 0;
  Eigen::Index size() const { return end - begin; }
};

/// Lower triangular factor of the covariance of the lines of one pose.
using PoseRoot = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

/// A fitted model as a diagnosis looks at it: its whitened residuals, orthogonal to the columns of
/// its own parameters. Rows are sorted by fold; every whitened coordinate of a point, and of an
/// orientation that the fit uses, is one line, pose by pose. Memory: about (lines of a pose *
/// parameters + 300) numbers a pose.
struct WhitenedFit {
  const Cell* cell = nullptr;
  const Measurements* measured = nullptr;
  std::vector<int> row;        // of the measurements
  std::vector<Segment> folds;  // of the fit poses
  Segment held;                // may be empty
  /// Errors of the poses that the others contradict [m]: no model was fitted to them, so with folds
  /// they count as held out. What a missing effect changes of them is little beside them.
  std::vector<double> contradicted_m;
  std::vector<Reading> reading;  // what each pose shows
  LineTable table;               // of all poses
  Eigen::Index fit_lines = 0;    // of the fit poses
  Eigen::Index rank = 0;         // of the model's own columns
  NoiseScale noise;
  double sigma_m = 0.0;  // typical 1 sigma of a coordinate of a point
  /// What joint scatter alone explains of the residual without any effect [nats]: every candidate
  /// has to explain that much more before it counts.
  double scatter_nats = 0.0;

  Eigen::VectorXd y;                 // (lines,) residual; held lines keep all of theirs
  Eigen::MatrixXd U;                 // (lines, rank) model columns, orthonormal over the fit lines
  double Q = 0.0;                    // sum of squares of y over the fit lines
  Eigen::MatrixXd half_information;  // H of the parameters, (parameters, rank): H H^T is
                                     // the inverse information, SI, in this whitening
  Eigen::VectorXd correction;        // of the fitted parameters that this whitening asks for, SI

  /// Whitened motion of the reflector, per unit of joint j: shape (lines,) each.
  std::vector<Eigen::VectorXd> joint;
  /// Its products with itself, y and U, summed over the lines of each pose, so that a function of
  /// the pose times a joint costs one line a pose: shapes (poses,), (poses,), (poses, rank).
  std::vector<Eigen::VectorXd> joint_square, joint_y;
  std::vector<Eigen::MatrixXd> joint_U;
  Eigen::MatrixXd base;  // (lines, 6) twist of the base: shifts, turns
  Eigen::MatrixXd tool;  // (lines, 3) shift of the target in the tool frame

  /// What laws of the library look at, pose by pose.
  Chain chain;
  std::vector<ChainFrames> frames;
  std::vector<Loads> loads;
  std::vector<MeasuredContext> context;
  std::vector<double> sigma;     // (lines,) [m], of rotations [rad]
  std::vector<PoseRoot> root;    // of each pose: Cholesky factor, behind sigma; empty: the identity
  std::vector<Transformd> X_MB;  // base in the measurement frame
  std::vector<Vector3> arm_B;    // tip to target
  std::vector<std::string> sensors;

  Eigen::Index poses() const { return static_cast<Eigen::Index>(row.size()); }
  Eigen::Index fit_poses() const { return held.begin; }
  int joints() const { return chain.joints(); }

  /// The lines of the point of a pose, the first ones.
  auto point_lines(Eigen::Index pose) const {
    return Eigen::seqN(table.begin(pose),
                       Eigen::Index{reading[static_cast<std::size_t>(pose)].point_lines()});
  }
  /// Whether orientations are used: all rows have one, or none.
  bool turns() const { return !reading.empty() && reading.front().turn_lines() > 0; }
  /// Where the target of a pose is in the frame of its set-up.
  Vector3 target_M(Eigen::Index pose) const {
    const auto i = static_cast<std::size_t>(pose);
    return X_MB[i] * (frames[i].tip.p + arm_B[i]);
  }
  Eigen::MatrixXd inverse_information() const {
    return half_information * half_information.transpose();
  }
  std::span<const double> q(Eigen::Index pose) const {
    return {measured->q.row(row[pose]).data(), static_cast<std::size_t>(chain.joints())};
  }
};

/// fit: rows the calibration was made from, without its outliers; held: rows it never saw.
WhitenedFit make_whitened_fit(const Cell& cell, const Measurements& measured,
                              const Calibration& calibration, const std::vector<int>& fit,
                              const std::vector<int>& held);

/// Computes joint_square, joint_y and joint_U again.
void fold_joints(WhitenedFit& whitened);

/// Lines of one pose: a motion [m, rad] of the measured coordinates in standard deviations, and
/// back.
void whiten(const WhitenedFit& whitened, Eigen::Index pose, Eigen::Ref<Eigen::VectorXd> lines);
void unwhiten(const WhitenedFit& whitened, Eigen::Index pose, Eigen::Ref<Eigen::VectorXd> lines);

/// Takes out of y what the columns explain; the sizes of the columns that do so, shape (rank,).
Eigen::VectorXd clear_residual(WhitenedFit& whitened);

}  // namespace plumb::offline
