// SPDX-License-Identifier: Apache-2.0
#include "noise/weights.hpp"

#include <algorithm>
#include <cmath>

#include "noise/noise_floor.hpp"
#include "noise/stated_touch.hpp"

namespace plumb::offline {

Rows3 stated_sigma(const Cell& cell, const Measurements& measured) {
  if (measured.sigma_m.rows() > 0) return measured.sigma_m.cwiseMax(kSmallestSigma_m);
  const double sigma = cell.measurement.sigma_m.value_or(kUnstatedSigma_m);
  Rows3 out = Rows3::Constant(measured.size(), 3, std::max(sigma, kSmallestSigma_m));
  const double touch = sigma_of_touches(cell, measured).value_or(kUnstatedTouch_m);
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    if (measured.of_artefact(i)) out.row(i).setConstant(std::max(touch, kSmallestSigma_m));
  return out;
}

double reading_sigma(const Cell& cell, const Measurements& used) {
  const double sigma = used.size() > 0 ? noise_floor(cell, used).sigma_m : 0.0;
  return sigma > 0.0 ? sigma : cell.measurement.sigma_m.value_or(kUnstatedSigma_m);
}

double excess_sigma(const Measurements& measured, const Rows3& residual, const Rows3& sigma,
                    int parameters) {
  // What a row does not read is 0 among the residuals.
  const double used = measured.mean_axes() * static_cast<double>(measured.size());
  const double largest = residual.cwiseAbs().maxCoeff();
  const double dof = std::max(1.0, used - parameters);
  const auto chi2 = [&](double tau) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += (residual.col(k).array().square() / (sigma.col(k).array().square() + tau * tau)).sum();
    return sum;
  };
  if (chi2(0.0) <= dof) return 0.0;
  // chi2 falls with tau, and at tau = sqrt(used / dof) times the largest residual it is below dof.
  double low = 0.0, high = largest * std::sqrt(used / dof);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (chi2(middle) > dof ? low : high) = middle;
  }
  return high;
}

}  // namespace plumb::offline
