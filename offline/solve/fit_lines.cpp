// SPDX-License-Identifier: Apache-2.0
#include "solve/fit_lines.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/geometry_derivative.hpp"
#include "numbers/jobs.hpp"

namespace plumb::offline {

FitLines::FitLines(const FitData& data, const ArmState& start,
                   const std::vector<Parameter>& parameters)
    : data_(data),
      start_(start),
      parameters_(parameters),
      table_(data.line_table()),
      poses_(data, parameters),
      priors_(data, start, parameters) {}

bool FitLines::evaluate(const Eigen::VectorXd& change, double* residual, double* jacobian) const {
  const auto columns = static_cast<Eigen::Index>(parameters_.size());
  // Without a Jacobian no derivatives are computed, which saves most of the time.
  const GeometryDerivative geometry =
      jacobian != nullptr ? GeometryDerivative(start_, parameters_, change)
                          : GeometryDerivative(moved(start_, parameters_, change), {}, {});
  const int rows = static_cast<int>(data_.rows.size());
  const int blocks = (rows + kRowsOfOneThread - 1) / kRowsOfOneThread;
  std::vector<PoseLines::Undefined> undefined(static_cast<std::size_t>(blocks));
  const auto evaluate_block = [&](int block) {
    const int first = block * kRowsOfOneThread;
    const Eigen::Index line = table_.begin(first);
    undefined[static_cast<std::size_t>(block)] =
        poses_.evaluate(geometry, first, std::min(rows, first + kRowsOfOneThread), residual + line,
                        jacobian == nullptr ? nullptr : jacobian + line * columns);
  };
  run_jobs(blocks, evaluate_block);
  for (const auto& one : undefined)
    if (one.row >= 0) {
      undefined_ = one;
      return false;
    }
  const Eigen::Index line = table_.lines();
  priors_.evaluate(geometry.state(), residual + line,
                   jacobian == nullptr ? nullptr : jacobian + line * columns);
  return std::all_of(residual, residual + count(), [](double r) { return std::isfinite(r); });
}

}  // namespace plumb::offline
