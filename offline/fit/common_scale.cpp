// SPDX-License-Identifier: Apache-2.0
#include "fit/common_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/constants.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline {

bool CommonScale::unusual() const {
  return std::abs(longer) > kUnusualScale * std::hypot(usual, sigma);
}

std::optional<CommonScale> common_scale(const Calibration& c, double prior_m) {
  Eigen::VectorXd along = Eigen::VectorXd::Zero(c.covariance.rows());
  double squares = 0.0, change = 0.0, all = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < c.estimates.size(); ++i) {
    const Estimate& e = c.estimates[i];
    const auto k = static_cast<Eigen::Index>(i);
    if (!e.of_robot || !e.is_length || !e.unit.empty() || k >= along.size()) continue;
    along(k) = e.nominal;
    squares += e.nominal * e.nominal;
    change += e.nominal * (e.value - e.nominal);
    all += std::pow(e.value - e.nominal, 2);
    ++count;
  }
  if (squares == 0.0) return std::nullopt;
  // Lengths that differ from nominal one by one, by more than arms do, have a common part, too.
  // Of few lengths their spread is hardly known, which Student's t takes into account.
  const int free = std::max(1, count - 1);
  const double single_m = std::sqrt((all - change * change / squares) / free);
  const double times = student_quantile(kUsualShare, free) / kUnusualScale;
  const double built_m = std::max(prior_m, times * single_m);
  return CommonScale{.longer = change / squares,
                     .sigma = std::sqrt(std::max(0.0, along.dot(c.covariance * along))) / squares,
                     .usual = built_m / std::sqrt(squares)};
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
