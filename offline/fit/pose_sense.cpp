// SPDX-License-Identifier: Apache-2.0
#include "fit/pose_sense.hpp"
#include "fit/constants.hpp"
#include "program/counted_words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::offline {
namespace {

double range_of(const Measurements& measured, const std::vector<int>& rows, Eigen::Index joint) {
  const auto [low, high] = std::minmax_element(rows.begin(), rows.end(), [&](int a, int b) {
    return measured.q(a, joint) < measured.q(b, joint);
  });
  return measured.q(*high, joint) - measured.q(*low, joint);
}

double largest_range(const Measurements& measured, const std::vector<int>& rows) {
  double out = 0.0;
  for (Eigen::Index j = 0; j < measured.q.cols(); ++j)
    out = std::max(out, range_of(measured, rows, j));
  return out;
}

/// Diagonal of the box around the measured points [m].
double spread_of_points(const Measurements& measured, const std::vector<int>& rows) {
  Eigen::RowVector3d low = measured.p_M.row(rows.front()), high = low;
  for (const int row : rows) {
    low = low.cwiseMin(measured.p_M.row(row));
    high = high.cwiseMax(measured.p_M.row(row));
  }
  return (high - low).norm();
}

Problem one_pose(const Measurements& measured, const std::vector<int>& rows) {
  const double spread = spread_of_points(measured, rows);
  if (spread > kArmMoved_m)
    return {
        .code = "E-FIT-ONE-POSE",
        .message = fmt::format(
            "no joint moves by more than {:.2g} rad or m over the {} "
            "to fit, but their points are up to {:.3g} m apart: the joint "
            "columns are in another unit, or not of these points",
            kOnePose, counted_words(static_cast<long long>(rows.size()), "pose", "poses"), spread),
        .help = "correct the units in the headings of the joint columns, or export them again"};
  return {.code = "E-FIT-ONE-POSE",
          .message = fmt::format("the {} poses to fit are nearly all one pose: no joint moves by "
                                 "more than {:.2g} rad or m",
                                 rows.size(), kOnePose),
          .help = "measure poses all over the workspace: plumb plan --n 30"};
}

}  // namespace

void check_poses(const Measurements& measured, const std::vector<int>& rows) {
  if (rows.empty())
    throw Failure(Exit::kNumbersSayNo,
                  {.code = "E-FIT-FEW",
                   .message = fmt::format("every row is held out or ignored: none of {} is left to "
                                          "fit",
                                          measured.size()),
                   .help = "mark some rows fit in column 'set', or: plumb fit --held-out 20%"});
  if (rows.size() > 1 && largest_range(measured, rows) < kOnePose)
    throw Failure(Exit::kNumbersSayNo, one_pose(measured, rows));
}

std::vector<std::string> still_joints(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows) {
  std::vector<std::string> out;
  for (Eigen::Index j = 0; j < measured.q.cols(); ++j)
    if (range_of(measured, rows, j) < kStill)
      out.push_back(cell.nominal.joints[static_cast<std::size_t>(j)].name);
  return out;
}

}  // namespace plumb::offline
