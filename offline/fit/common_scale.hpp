// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "fit/calibration.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// By how much all lengths of the arm together came out longer than nominal, as a share. A scale
/// error of what was measured does just that, and lengths that are built wrong one by one hardly.
struct CommonScale {
  double longer = 0.0;
  double sigma = 0.0;  // 1 sigma of it, from the covariance of the fit
  double usual = 0.0;  // 1 sigma of it among arms whose lengths differ as much one by one
  /// What it adds to a length.
  double change_m(const Estimate& e) const { return longer * e.nominal; }
  bool unusual() const;
};

/// Of the lengths that the fit determined; nothing if it determined none.
/// prior_m: 1 sigma by which one length of an arm differs from nominal, at least.
std::optional<CommonScale> common_scale(const Calibration& c, double prior_m);

/// W-FIT-SCALE
Problem scale_remark(const CommonScale& scale);

}  // namespace plumb::offline
