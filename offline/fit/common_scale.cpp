// SPDX-License-Identifier: Apache-2.0
#include "fit/common_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/constants.hpp"

namespace plumb::offline {
namespace {

/// Mean size of a normal number with sigma 1.
const double kMeanSize = std::sqrt(2.0 / M_PI);

bool is_length_of_arm(const Estimate& e) { return e.of_robot && e.is_length && e.unit.empty(); }

/// 1 sigma by which lengths differ from nominal one by one, the common scale taken off. Their mean
/// size, because a length may hold what belongs to another one. Infinite where they are too few.
double spread_m(const std::vector<Estimate>& estimates, double longer) {
  double sum = 0.0;
  int count = 0;
  for (const Estimate& e : estimates) {
    if (!is_length_of_arm(e)) continue;
    sum += std::abs(e.value - (1.0 + longer) * e.nominal);
    ++count;
  }
  if (count < kFewestLengths) return std::numeric_limits<double>::infinity();
  return sum / (kMeanSize * count);
}

}  // namespace

bool CommonScale::unusual() const {
  return std::abs(longer) > kUnusualScale * std::hypot(usual, sigma);
}

std::optional<CommonScale> common_scale(const Calibration& c, double prior_m) {
  Eigen::VectorXd along = Eigen::VectorXd::Zero(c.covariance.rows());
  double squares = 0.0, change = 0.0;
  for (std::size_t i = 0; i < c.estimates.size(); ++i) {
    const Estimate& e = c.estimates[i];
    const auto k = static_cast<Eigen::Index>(i);
    if (!is_length_of_arm(e) || k >= along.size()) continue;
    along(k) = e.nominal;
    squares += e.nominal * e.nominal;
    change += e.nominal * (e.value - e.nominal);
  }
  if (squares == 0.0) return std::nullopt;
  CommonScale out{.longer = change / squares};
  out.sigma = std::sqrt(std::max(0.0, along.dot(c.covariance * along))) / squares;
  out.usual = std::max(prior_m, spread_m(c.estimates, out.longer)) / std::sqrt(squares);
  return out;
}

Problem scale_remark(const CommonScale& scale) {
  return {.severity = Severity::kWarning,
          .code = "W-FIT-SCALE",
          .message = fmt::format(
              "all lengths of the arm together came out {:.2g} % {} than nominal, {:.0f} times as "
              "much as arms are built wrong: a scale error of what was measured looks just so",
              100.0 * std::abs(scale.longer), scale.longer > 0.0 ? "longer" : "shorter",
              std::abs(scale.longer) / scale.usual),
          .help =
              "check the unit, the temperature and the calibration of the instrument, or of the "
              "lengths that you stated; if the arm is of another size, correct its nominal "
              "lengths"};
}

}  // namespace plumb::offline
