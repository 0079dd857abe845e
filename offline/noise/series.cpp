// SPDX-License-Identifier: Apache-2.0
#include "noise/series.hpp"

#include <algorithm>

#include "noise/cut_search.hpp"

namespace plumb::offline {

Series series(const Measurements& measured, const Rows3& error_M, std::vector<int> rows) {
  const Eigen::VectorXd& time = measured.context.time_s;
  const bool timed = time.size() == measured.size() && time.allFinite();
  std::sort(rows.begin(), rows.end());
  if (timed) put_in_order(rows, [&](int row) { return time(row); });
  Series out;
  out.has_axis = measured.has_axis;
  out.error_M.resize(static_cast<Eigen::Index>(rows.size()), 3);
  Eigen::Index visits = 0;
  for (std::size_t i = 0; i < rows.size();) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    std::size_t k = i;
    for (;
         k < rows.size() && measured.replicate_group[rows[k]] == measured.replicate_group[rows[i]];
         ++k)
      sum += error_M.row(rows[k]);
    out.first_row.push_back(rows[i]);
    out.last_row.push_back(rows[k - 1]);
    out.error_M.row(visits++) = sum / static_cast<double>(k - i);
    i = k;
  }
  out.error_M.conservativeResize(visits, 3);
  return out;
}

}  // namespace plumb::offline
