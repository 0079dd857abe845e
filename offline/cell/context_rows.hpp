// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cell/rows.hpp"
#include "effects/measured_context.hpp"

namespace plumb::offline {

/// What measurement files say of each pose beside joints and point, row by row. Matrices with 0
/// rows: no file has the columns; NaN: this row's file has not. SI, temperatures in [degC].
struct ContextRows {
  RowsN direction;  // dir_jN
  RowsN travel;     // travel_jN
  RowsN step;       // last moves (last_moves.hpp), as shares of the largest joint's
  RowsN payload;    // mass [kg], centre of mass x, y, z [m]
  RowsN wrench;     // fx, fy, fz [N], mx, my, mz [N m], on the tool tip, base frame
  RowsN temperature;
  std::vector<std::string> sensors;  // of the temperatures: "temp", "temp_base"
  Eigen::VectorXd time_s;
  Eigen::VectorXd order;  // 0, 1, … in the order of the files

  bool has_direction() const { return direction.rows() > 0; }
};

ContextRows pick(const ContextRows& all, const std::vector<int>& rows);

/// Row `row` as the laws see it, without the position of the tracker. `sensors`: which temperature
/// goes where in the context.
MeasuredContext context_at(const ContextRows& rows, Eigen::Index row,
                           const std::vector<std::string>& sensors);

}  // namespace plumb::offline
