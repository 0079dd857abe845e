// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "recheck/evidence.hpp"
#include "runs/run_store.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline::recheck {

/// A standard normal number.
double normal(tests::Random& random);

/// An arm of three joints J1, J2, J3, on a base that is turned in the measurement frame.
struct SmallArm {
  SmallArm();

  Cell cell;
  ArmState state;

  /// Random poses, each read once without error.
  Measurements poses(int count, std::uint64_t seed) const;
  /// A run that fitted J2.theta and J3.theta to all of `own`, which it leaves `own` less predicted.
  Run run(const Measurements& own) const;
  /// J2.theta and J3.theta, known to `std_rad`, correlated by one half.
  KnownNumbers known(double std_rad) const;

  Change tool() const;             // by a millimetre, give or take
  Change offset(int joint) const;  // by a milliradian, give or take
};

/// The readings with independent noise of `sigma_m` and nothing else expected.
Readings readings_of(Measurements rows, double sigma_m);

void add_noise(Measurements& rows, double sigma_m, tests::Random& random);

/// Measured less predicted, line by line, and by central differences how the predicted points move
/// with each number.
Eigen::VectorXd missed_lines(const Measurements& rows, const ArmState& state);
Eigen::MatrixXd slopes(const Measurements& rows, const ArmState& state,
                       const std::vector<Parameter>& parameters);

/// A symmetric, positive definite matrix with diagonal `variance` and correlations up to a half.
Eigen::MatrixXd correlated(Eigen::Index size, double variance, tests::Random& random);

}  // namespace plumb::offline::recheck
