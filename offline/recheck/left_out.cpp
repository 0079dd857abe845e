// SPDX-License-Identifier: Apache-2.0
#include "recheck/left_out.hpp"

#include <algorithm>

#include "numbers/gaussian.hpp"

namespace plumb::offline::recheck {
namespace {

/// Estimates the numbers of the changes from all readings but one.
Eigen::VectorXd refitted_without(const Judged& judged, int reading, int axes) {
  if (judged.change.size() == 0) return judged.change;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index line = 0; line < judged.r.size(); ++line)
    if (line / axes != reading) kept.push_back(line);
  const Cholesky S(judged.S(kept, kept));
  return posterior(S, judged.B(kept, Eigen::all), judged.prior).gain * judged.r(kept);
}

}  // namespace

Rows3 errors_of(const Readings& readings, const Eigen::VectorXd& lines) {
  Rows3 out = Rows3::Zero(readings.rows.size(), 3);
  Eigen::Index line = 0;
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (int k = 0; k < 3; ++k)
      if (readings.rows.has_axis[static_cast<std::size_t>(k)]) out(i, k) = lines(line++);
  return out;
}

Rows3 left_out_errors(const Readings& readings, const std::vector<Change>& changes,
                      const Judged& judged) {
  const int axes = readings.axes;
  Eigen::VectorXd errors = judged.r + judged.mean;
  for (int i = 0; i < readings.rows.size(); ++i) {
    Eigen::VectorXd x = refitted_without(judged, i, axes);
    for (std::size_t c = 0; c < changes.size(); ++c)
      if (changes[c].part == Part::kReading) x.segment(judged.begin[c], axes).setZero();
    errors.segment(i * axes, axes) -= judged.B.middleRows(i * axes, axes) * x;
  }
  return errors_of(readings, errors);
}

ErrorStats stats_of(const Rows3& errors, const std::vector<int>& leave_out) {
  std::vector<double> norms;
  for (int i = 0; i < errors.rows(); ++i)
    if (std::find(leave_out.begin(), leave_out.end(), i) == leave_out.end())
      norms.push_back(errors.row(i).norm());
  return summarise(std::move(norms));
}

}  // namespace plumb::offline::recheck
