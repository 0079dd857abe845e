// SPDX-License-Identifier: Apache-2.0
#include "fit/pose_sense.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::offline {
namespace {

constexpr double kOnePose = 5e-3;  // [rad] or [m]: a joint that uses less does not move

double largest_range(const Measurements& measured, const std::vector<int>& rows) {
  double out = 0.0;
  for (Eigen::Index j = 0; j < measured.q.cols(); ++j) {
    const auto [low, high] = std::minmax_element(rows.begin(), rows.end(), [&](int a, int b) {
      return measured.q(a, j) < measured.q(b, j);
    });
    out = std::max(out, measured.q(*high, j) - measured.q(*low, j));
  }
  return out;
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
    throw Failure(Exit::kNumbersSayNo,
                  {.code = "E-FIT-ONE-POSE",
                   .message = fmt::format("the {} poses to fit are nearly all one pose: no joint "
                                          "moves by more than {:.2g} rad or m",
                                          rows.size(), kOnePose),
                   .help = "measure poses all over the workspace: plumb plan --n 30"});
}

}  // namespace plumb::offline
