// SPDX-License-Identifier: Apache-2.0
#include "solve/row_sums.hpp"

#include <algorithm>

#include "numbers/jobs.hpp"
#include "solve/prior_lines.hpp"

namespace plumb::offline {
namespace {

/// The rows are always summed in so many parts, so that the result does not depend on the number of
/// threads.
constexpr int kParts = 64;

}  // namespace

RowSums sums_at(const FitData& data, const ArmState& state,
                const std::vector<Parameter>& parameters) {
  const PoseLines poses(data, parameters);
  const PriorLines priors(data, state, parameters);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const GeometryDerivative geometry(state, parameters, Eigen::VectorXd::Zero(count));
  const LineTable table = data.line_table();
  const int rows = static_cast<int>(data.rows.size());
  RowSums none;
  none.information.setZero(count, count);
  none.gradient.setZero(count);
  RowSums out = none;
  out.residual.resize(table.lines() + priors.count());
  std::vector<RowSums> parts(kParts, none);
  const auto sum_part = [&](int part) {
    RowSums& sums = parts[static_cast<std::size_t>(part)];
    const auto begin_of = [&](int p) { return static_cast<int>(std::int64_t{rows} * p / kParts); };
    RowMajorMatrix J(kRowsOfOneThread * table.most(), count);
    for (int first = begin_of(part); first < begin_of(part + 1); first += kRowsOfOneThread) {
      const int last = std::min(begin_of(part + 1), first + kRowsOfOneThread);
      auto r = out.residual.segment(table.begin(first), table.count(first, last));
      sums.undefined = poses.evaluate(geometry, first, last, r.data(), J.data());
      if (sums.undefined.row >= 0) return;
      sums.add(J.topRows(r.size()), r);
    }
  };
  run_jobs(kParts, sum_part);
  for (const auto& part : parts) out.add(part);
  auto known = out.residual.tail(out.residual.size() - table.lines());
  RowMajorMatrix J(known.size(), count);
  priors.evaluate(state, known.data(), J.data());
  out.add(J, known);
  out.information = out.information.selfadjointView<Eigen::Lower>();
  out.cost = 0.5 * out.residual.squaredNorm();
  return out;
}

}  // namespace plumb::offline
