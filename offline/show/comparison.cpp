// SPDX-License-Identifier: Apache-2.0
#include "show/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr int kMostBins = 6;
constexpr int kPosesPerBin = 8;  // fewer poses make wider bins

std::vector<int> rows_of(const Split& split, Comparison::Set set) {
  return set == Comparison::Set::kHeldOut ? held_rows(split) : fit_rows(split);
}

std::vector<PoseError> pose_errors(const Measurements& measured, const Fit& fit,
                                   Comparison::Set set) {
  const Rows3 error = residuals(measured, fit.predicted_M);
  std::vector<PoseError> out;
  for (int row : rows_of(fit.split, set))
    out.push_back({.row = row,
                   .pose = measured.pose[row],
                   .error_M = error.row(row),
                   .held = set == Comparison::Set::kHeldOut});
  return out;
}

/// Equal steps of `value` between its extremes.
ErrorProfile profile(ErrorProfile out, const std::vector<PoseError>& poses,
                     const std::vector<double>& value) {
  if (poses.empty()) return out;
  const auto [low, high] = std::minmax_element(value.begin(), value.end());
  const int count = std::clamp(static_cast<int>(poses.size()) / kPosesPerBin, 1, kMostBins);
  const double step = (*high - *low) / count;
  for (int k = 0; k < count; ++k) {
    const bool last = k + 1 == count;
    out.bins.push_back({.from = *low + k * step, .to = last ? *high : *low + (k + 1) * step});
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const int k = step > 0 ? static_cast<int>((value[i] - *low) / step) : 0;
    auto& bin = out.bins[std::clamp(k, 0, count - 1)];
    bin.mean_m += poses[i].error_M.norm();
    ++bin.n;
  }
  for (auto& bin : out.bins)
    if (bin.n > 0) bin.mean_m /= bin.n;
  return out;
}

std::vector<double> each(const std::vector<PoseError>& poses, const auto& value_of_row) {
  std::vector<double> out;
  out.reserve(poses.size());
  for (const auto& pose : poses) out.push_back(value_of_row(pose.row));
  return out;
}

void add_joints(const Cell& cell, const Measurements& measured, Comparison& out) {
  using Unit = ErrorProfile::Unit;
  for (int j = 0; j < cell.joints(); ++j) {
    const auto& joint = cell.nominal.joints[j];
    out.profiles.push_back(profile({.kind = ErrorProfile::Kind::kJoint,
                                    .name = joint.name,
                                    .unit = slides(joint) ? Unit::kLength : Unit::kAngle,
                                    .bins = {}},
                                   out.poses,
                                   each(out.poses, [&](int row) { return measured.q(row, j); })));
  }
}

/// Where in the workspace, seen from the base: distance from its z axis, height and direction.
void add_regions(const Measurements& measured, const Fit& fit, Comparison& out) {
  const Transformd X_BM = from_pose(fit.calibration.state.X_MB).inverse();
  const auto point = [&](int row) -> Vector3 {
    return X_BM * Vector3(measured.p_M.row(row).transpose());
  };
  const auto add = [&](const char* name, ErrorProfile::Unit unit, const auto& value) {
    out.profiles.push_back(
        profile({.kind = ErrorProfile::Kind::kRegion, .name = name, .unit = unit, .bins = {}},
                out.poses, each(out.poses, [&](int row) { return value(point(row)); })));
  };
  using Unit = ErrorProfile::Unit;
  add("reach", Unit::kLength, [](const Vector3& p) { return std::hypot(p(0), p(1)); });
  add("height", Unit::kLength, [](const Vector3& p) { return p(2); });
  add("azimuth", Unit::kAngle, [](const Vector3& p) { return std::atan2(p(1), p(0)); });
}

}  // namespace

double ErrorProfile::contrast() const {
  double low = std::numeric_limits<double>::max(), high = 0.0;
  for (const auto& bin : bins) {
    if (bin.n == 0) continue;
    low = std::min(low, bin.mean_m);
    high = std::max(high, bin.mean_m);
  }
  return low > 0.0 && high > low ? high / low : 1.0;
}

Comparison compare(const Cell& cell, const Measurements& measured, const Fit& fit) {
  Comparison out;
  out.set = fit.held.n > 0 ? Comparison::Set::kHeldOut : Comparison::Set::kFit;
  out.poses = pose_errors(measured, fit, out.set);
  std::vector<double> errors;
  for (const auto& pose : out.poses) errors.push_back(pose.error_M.norm());
  const auto within =
      std::count_if(errors.begin(), errors.end(), [&](double e) { return e <= cell.tolerance_m; });
  if (!errors.empty())
    out.within_tolerance = static_cast<double>(within) / static_cast<double>(errors.size());
  out.stats = summarise(std::move(errors));
  add_joints(cell, measured, out);
  add_regions(measured, fit, out);
  out.profiles.push_back(profile({.kind = ErrorProfile::Kind::kOrder,
                                  .name = "order",
                                  .unit = ErrorProfile::Unit::kRow,
                                  .bins = {}},
                                 out.poses, each(out.poses, [](int row) { return row + 1.0; })));
  std::stable_sort(out.poses.begin(), out.poses.end(), [](const auto& a, const auto& b) {
    return a.error_M.norm() > b.error_M.norm();
  });
  return out;
}

}  // namespace plumb::offline::show
