// SPDX-License-Identifier: Apache-2.0
#include "check/displaced_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "arm/predicted_points.hpp"
#include "check/constants.hpp"
#include "check/row_lines.hpp"
#include "check/tool_errors.hpp"

namespace plumb::offline {
namespace {

/// Groups the rows of the outliers into runs of neighbours, in ascending order, and drops short
/// runs.
std::vector<std::vector<int>> neighbours(const std::vector<Outlier>& outliers) {
  std::vector<int> rows;
  for (const Outlier& outlier : outliers) rows.push_back(outlier.row);
  std::sort(rows.begin(), rows.end());
  std::vector<std::vector<int>> out;
  for (const int row : rows) {
    if (out.empty() || row - out.back().back() > check::kNextOfRun) out.emplace_back();
    out.back().push_back(row);
  }
  std::erase_if(out, [](const auto& run) { return run.size() < check::kFewestOfRun; });
  return out;
}

struct CommonVector {
  Vector3 mean;
  double scatter = 0.0;  // RMS distance from the mean, as a share of its length
};

CommonVector common_vector(const Rows3& errors) {
  const Eigen::RowVector3d mean = errors.colwise().mean();
  const double rms =
      std::sqrt((errors.rowwise() - mean).squaredNorm() / static_cast<double>(errors.rows()));
  return {mean.transpose(), rms / std::max(mean.norm(), 1e-12)};
}

}  // namespace

std::vector<DisplacedRun> displaced_runs(const ArmState& state, const MeasurementFiles& measured,
                                         const std::vector<Outlier>& outliers) {
  std::vector<DisplacedRun> out;
  const auto& axis = measured.has_axis;
  for (const auto& rows : neighbours(outliers)) {
    const Measurements some = pick(measured, rows);
    const Rows3 errors = residuals(some, predict_points(state, some));
    const CommonVector base = common_vector(errors);
    std::optional<CommonVector> tool;
    if (axis[0] && axis[1] && axis[2]) tool = common_vector(errors_in_tool(state, some, errors));
    const bool of_tool = tool && tool->scatter < base.scatter;
    const CommonVector& one = of_tool ? *tool : base;
    if (one.scatter <= check::kOneVector)
      out.push_back({rows.front(), rows.back(), one.mean, of_tool});
  }
  return out;
}

std::string in_words(const MeasurementFiles& measured, const DisplacedRun& run) {
  const bool small = run.by.norm() < 1e-3;
  const auto mm = [&](int k) {
    const double unit = small ? 1e3 : 10.0;  // of the last digit, per millimetre
    const double shown = std::round(run.by(k) * 1e3 * unit) / unit + 0.0;  // never "-0.0"
    return fmt::format("{:.{}f}", shown, small ? 3 : 1);
  };
  const bool read = !measured.tables.empty();
  return fmt::format("{} {} to {} are all off by some ({}, {}, {}) mm, seen from the {}",
                     read ? "lines" : "rows",
                     read ? line_of_row(measured, run.first) : run.first + 1,
                     read ? line_of_row(measured, run.last) : run.last + 1, mm(0), mm(1), mm(2),
                     run.of_tool ? "tool: the reflector probably sat in another place"
                                 : "tracker: it, or the base, probably stood in another place");
}

}  // namespace plumb::offline
