// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline {

/// A measured pose that the others contradict.
struct Outlier {
  int row = 0;           // of the measurements
  double error_m = 0.0;  // from where the fit without it predicts the point
  double times = 0.0;    // the usual scatter
  std::string pose{};    // its name; empty: it has none
};

/// `rows` without these.
std::vector<int> without_outliers(std::vector<int> rows, const std::vector<Outlier>& outliers);

}  // namespace plumb::offline
