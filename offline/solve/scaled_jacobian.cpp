// SPDX-License-Identifier: Apache-2.0
#include "solve/scaled_jacobian.hpp"

#include <cmath>
#include <map>

#include "solve/evaluation.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {

Eigen::MatrixXd jacobian_for_all(const FitData& all, const FitData& some, const ArmState& state,
                                 const std::vector<Parameter>& parameters) {
  Eigen::MatrixXd J = evaluate(some, state, parameters).jacobian;
  std::map<int, int> of_all = rows_by_setup(*all.measured, all.rows),
                     of_some = rows_by_setup(*some.measured, some.rows);
  const LineTable table = some.line_table();
  for (std::size_t i = 0; i < some.rows.size(); ++i) {
    const int setup = setup_of(*some.measured, some.rows[i]);
    const double times = static_cast<double>(of_all[setup]) / of_some[setup];
    const auto reading = static_cast<Eigen::Index>(i);
    J.middleRows(table.begin(reading), table.count(reading)) *= std::sqrt(times);
  }
  return J;
}

}  // namespace plumb::offline
