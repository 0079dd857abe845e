// SPDX-License-Identifier: Apache-2.0
#include "solve/fit_data.hpp"

namespace plumb::offline {

int FitData::residual_count() const { return reading().lines() * static_cast<int>(rows.size()); }

LineTable FitData::line_table() const {
  return LineTable(std::vector<int>(rows.size(), reading().lines()));
}

}  // namespace plumb::offline
