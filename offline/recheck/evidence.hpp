// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "recheck/change.hpp"
#include "recheck/readings.hpp"

namespace plumb::offline::recheck {

/// What a run knows of its numbers.
struct KnownNumbers {
  std::vector<Parameter> parameters;
  Eigen::MatrixXd covariance;  // SI
};

/// A set of changes, judged together. With r the readings less what the run predicts, J the
/// derivatives of the run's numbers with covariance C, E what is expected of readings if nothing
/// has changed, and B the derivatives of the numbers that changed by x ~ N(0, T),
///
///   r ~ N(B x, S),  S = E + J C J^T
///
/// so that the uncertainty of the whole calibration is in the judgement of a few readings. The
/// size of all variances together is known only roughly, so the evidence is that of Student's t.
struct Judged {
  double ln_evidence = 0.0;         // averaged over the scales of T and the views of E [nats]
  Eigen::VectorXd change;           // x, change by change, SI
  std::vector<Eigen::Index> begin;  // where the numbers of each change begin in it
  Eigen::MatrixXd x_covariance;     // of x
  ArmState state;                   // with that change
  Eigen::MatrixXd B;                // (lines, numbers) at `state` [m/SI]
  Eigen::MatrixXd J;                // (lines, numbers of the run) at `state`
  Eigen::VectorXd r;                // (lines,) [m], linearised at `state`, less the expected mean
  Eigen::VectorXd mean;             // (lines,) [m], expected, of the likelier view
  Eigen::MatrixXd S;                // (lines, lines) [m^2], of the likelier view
  Eigen::MatrixXd E;                // the same without the uncertainty of the run
  Eigen::VectorXd prior;            // 1 sigma of each number beforehand, SI
  Eigen::MatrixXd gain;             // (numbers, lines): x = gain r
  bool lacks_elsewhere = false;     // of the likelier view, see ExpectedError
  double chi2 = 0.0;                // of what is left, (r - B x)^T S^-1 (r - B x), prior counted
};

/// Whether even a broken arm may have every effect that change `k` of these altered, in the size
/// that was judged. Poses that hardly move with an effect would explain an error by any size of it.
bool sizes_plausible(const std::vector<Change>& changes, std::size_t k, const Judged& judged);

/// Judges changes against readings. Keeps references to what it is given.
class Judge {
 public:
  /// extended: the run's model with room for every change.
  Judge(const Readings& readings, const ArmState& extended, const KnownNumbers& known);

  /// Solved by at most a few Gauss-Newton steps, because a tool may be another one altogether.
  /// Cost: lines^3 + lines * numbers^2, a millisecond for 12 poses.
  Judged judge(const std::vector<Change>& changes) const;

 private:
  struct Start;
  Start start_of(const std::vector<Change>& changes) const;
  void linearise(const ArmState& state, const std::vector<Change>& changes,
                 const Eigen::VectorXd& in_state, Judged& out) const;
  Eigen::VectorXd residual_at(const ArmState& state) const;
  Eigen::MatrixXd columns_at(const ArmState& state, const std::vector<Change>& changes) const;

  Eigen::MatrixXd learnt_derivatives(const ExpectedError& view) const;

  const Readings& readings_;
  const ArmState& extended_;
  const KnownNumbers& known_;
  std::vector<Eigen::MatrixXd> learnt_;  // view by view
};

}  // namespace plumb::offline::recheck
