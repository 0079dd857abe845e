// SPDX-License-Identifier: Apache-2.0
#include "noise/usual_errors.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "noise/constants.hpp"
#include "noise/weights.hpp"
#include "solve/constants.hpp"
#include "solve/outliers.hpp"

namespace plumb::offline {
StandingOut standing_out(const std::vector<double>& errors_m, Eigen::Index axes, double sigma_m) {
  const double sigma = std::max(sigma_m, kSmallestSigma_m);
  const Eigen::Map<const Eigen::VectorXd> errors(errors_m.data(),
                                                 static_cast<Eigen::Index>(errors_m.size()));
  const double scatter = usual_scatter(errors / sigma, axes);
  StandingOut out;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    out.times.push_back(errors_m[i] / sigma / scatter);
    if (out.times.back() > kOutlierTimes) out.which.push_back(i);
  }
  return out;
}

bool are_single(std::size_t standing_out, std::size_t n) {
  return static_cast<double>(standing_out) <= kMostSingle * static_cast<double>(n);
}

ErrorStats usual_errors(std::vector<double> errors_m, Eigen::Index axes, double sigma_m) {
  auto which = standing_out(errors_m, axes, sigma_m).which;
  if (!are_single(which.size(), errors_m.size())) which.clear();
  for (auto at = which.rbegin(); at != which.rend(); ++at)
    errors_m.erase(errors_m.begin() + static_cast<std::ptrdiff_t>(*at));
  return summarise(std::move(errors_m));
}

}  // namespace plumb::offline
