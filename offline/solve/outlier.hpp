// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline {

/// A measured pose that the others contradict.
struct Outlier {
  int row = 0;           // in the measurements
  double error_m = 0.0;  // distance from where the fit without it predicts the point
  double times = 0.0;    // that distance over the usual scatter
  std::string pose{};    // name of the pose; empty: it has none
};

/// `rows` without those of the outliers.
std::vector<int> without_outliers(std::vector<int> rows, const std::vector<Outlier>& outliers);

}  // namespace plumb::offline
