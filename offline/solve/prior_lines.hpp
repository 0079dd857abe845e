// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// What is known of the parameters of a fit beforehand, as lines of its least squares behind those
/// of the poses: the priors of the cell, the typical sizes of effects, what an earlier calibration
/// found, the distances between touched points that are known, and the weak directions.
class PriorLines {
 public:
  /// Keeps references to `data` and `parameters`.
  PriorLines(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters);

  int count() const;

  /// residual: shape (count,); jacobian, unless null: how they change, shape (count, parameters),
  /// line by line.
  void evaluate(const ArmState& state, double* residual, double* jacobian) const;

  /// How far the arm is from its sisters: the mean square of its distances from what a fleet
  /// taught, in their standard deviations, large ones counted less. About 1 or less of a sister, 0
  /// without a fleet.
  double distance_from_sisters(const ArmState& state) const;

 private:
  /// A parameter of which something is known beforehand.
  struct KnownParameter {
    enum class Tail { kNormal, kHeavy };
    enum class Source { kCell, kFleet };
    Eigen::Index index;  // among those fitted
    double mean, sigma;
    Tail tail;
    Source source = Source::kCell;
  };

  /// Columns of the weak directions' numbers among those fitted, and where these are nominally.
  /// Empty where not all of them are fitted.
  struct WeakColumns {
    std::vector<Eigen::Index> index;
    Eigen::VectorXd nominal;
  };

  /// Numbers of an earlier calibration among those fitted: whitening * (mean - value) is how far
  /// they are from it, in standard deviations.
  struct EarlierNumbers {
    std::vector<Eigen::Index> index;
    Eigen::VectorXd mean;
    Eigen::MatrixXd whitening;  // inverse of the Cholesky factor of their covariance
  };

  static EarlierNumbers earlier_numbers(const FitData& data,
                                        const std::vector<Parameter>& parameters);
  static std::vector<KnownParameter> known(const FitData& data, const ArmState& start,
                                           const std::vector<Parameter>& parameters);
  /// A known distance between two points, and the columns of their x, y and z.
  struct KnownDistance {
    KnownLength length;
    Eigen::Index from = 0, to = 0;
    double sigma_m = 0.0;
  };
  static std::vector<KnownDistance> distances(const FitData& data,
                                              const std::vector<Parameter>& parameters);
  static WeakColumns weak_columns(const FitData& data, const std::vector<Parameter>& parameters);
  struct Pull;
  static Pull pull_of(double u, KnownParameter::Tail tail);
  Pull pull_of(const KnownParameter& known, const ArmState& state) const;
  void doubt_sisters(double* residual, double* jacobian) const;
  void add_earlier(const ArmState& state, double* residual, double* jacobian) const;
  void add_distances(const ArmState& state, double* residual, double* jacobian) const;
  void add_weak(const ArmState& state, double* residual, double* jacobian) const;

  const FitData& data_;
  const std::vector<Parameter>& parameters_;
  std::vector<KnownParameter> known_;
  EarlierNumbers earlier_;
  std::vector<KnownDistance> distances_;
  WeakColumns weak_;
};

}  // namespace plumb::offline
