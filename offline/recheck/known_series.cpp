// SPDX-License-Identifier: Apache-2.0
#include "recheck/known_series.hpp"

#include "arm/effect_binding.hpp"
#include "numbers/gaussian.hpp"
#include "solve/series_numbers.hpp"
#include "solve/series_solver.hpp"

namespace plumb::offline::recheck {

KnownNumbers with_series(KnownNumbers known, const ArmState& state, const Run& calibrated,
                         const Measurements& own, double sigma_m) {
  if (!has_series(state)) return known;
  // Where frame and target were makes no difference to what a reading says about a wave.
  Measurements in_one_setup = own;
  in_one_setup.setup.clear();
  FitData data;
  data.measured = &in_one_setup;
  data.rows = fitted_rows(calibrated, own);
  data.sigma_m = Rows3::Constant(own.size(), 3, sigma_m);
  const Eigen::MatrixXd information = series_information(data, state, known.parameters);
  const auto old = static_cast<Eigen::Index>(known.parameters.size());
  const Eigen::Index added = information.rows() - old;

  Eigen::VectorXd prior(added);
  Eigen::Index next = 0;
  for (const auto& series : series_numbers(state.arm)) {
    prior.segment(next, series.count) = series.sigma;
    next += series.count;
    for (int k = series.first; k < series.first + series.count; ++k)
      known.parameters.push_back({Parameter::Kind::kEffect, series.effect, k,
                                  effect_parameter_name(state.arm, series.effect, k)});
  }
  const Cholesky given_numbers(with_prior(information.bottomRightCorner(added, added), prior));
  Eigen::MatrixXd by_numbers(old + added, old);
  by_numbers.topRows(old).setIdentity();
  by_numbers.bottomRows(added) = -given_numbers.solve(information.bottomLeftCorner(added, old));
  known.covariance = (by_numbers * known.covariance * by_numbers.transpose()).eval();
  known.covariance.bottomRightCorner(added, added) +=
      given_numbers.solve(Eigen::MatrixXd::Identity(added, added));
  return known;
}

}  // namespace plumb::offline::recheck
