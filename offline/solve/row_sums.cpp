// SPDX-License-Identifier: Apache-2.0
#include "solve/row_sums.hpp"

#include <algorithm>

#include "numbers/jobs.hpp"
#include "solve/prior_lines.hpp"

namespace plumb::offline {
namespace {

constexpr int kParts = 64;         // of the rows, whatever the threads
constexpr int kRowsInOneGo = 256;  // rows evaluated in one go

}  // namespace

Sums sums_at(const FitData& data, const ArmState& state, const std::vector<Parameter>& parameters) {
  const PoseLines poses(data, parameters);
  const PriorLines priors(data, state, parameters);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const GeometryDerivative geometry(state, parameters, Eigen::VectorXd::Zero(count));
  const int rows = static_cast<int>(data.rows.size()), lines = data.per_pose();
  Sums none;
  none.information.setZero(count, count);
  none.gradient.setZero(count);
  Sums out = none;
  out.residual.resize(data.residual_count() + priors.count());
  std::vector<Sums> parts(kParts, none);
  const auto sum_part = [&](int part) {
    Sums& sums = parts[static_cast<std::size_t>(part)];
    const auto begin_of = [&](int p) { return static_cast<int>(std::int64_t{rows} * p / kParts); };
    RowMajorMatrix J(kRowsInOneGo * lines, count);
    for (int first = begin_of(part); first < begin_of(part + 1); first += kRowsInOneGo) {
      const int last = std::min(begin_of(part + 1), first + kRowsInOneGo);
      auto r =
          out.residual.segment(Eigen::Index{first} * lines, Eigen::Index{last - first} * lines);
      sums.undefined = poses.evaluate(geometry, first, last, r.data(), J.data());
      if (sums.undefined.row >= 0) return;
      sums.add(J.topRows(r.size()), r);
    }
  };
  run_jobs(kParts, sum_part);
  for (const auto& part : parts) out.add(part);
  auto known = out.residual.tail(out.residual.size() - Eigen::Index{rows} * lines);
  RowMajorMatrix J(known.size(), count);
  priors.evaluate(state, known.data(), J.data());
  out.add(J, known);
  out.information = out.information.selfadjointView<Eigen::Lower>();
  out.cost = 0.5 * out.residual.squaredNorm();
  return out;
}

}  // namespace plumb::offline
