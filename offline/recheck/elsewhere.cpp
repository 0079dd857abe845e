// SPDX-License-Identifier: Apache-2.0
#include "recheck/elsewhere.hpp"

#include <algorithm>
#include <cmath>

#include "recheck/constants.hpp"

namespace plumb::offline::recheck {
namespace {

/// Distance of a pose from the nearest one of the calibration that is another pose.
double to_nearest_other(const Measurements& own, const std::vector<int>& known, int row) {
  double out = HUGE_VAL;
  for (const int other : known) {
    const double d = pose_distance(own, row, own, other);
    if (d > 0.0) out = std::min(out, d);
  }
  return out;
}

/// The distance within which nearly all poses of the calibration have a neighbour.
double usual_distance(const Measurements& own, const std::vector<int>& known) {
  std::vector<double> nearest;
  const std::size_t count = std::min(known.size(), kMostNear);
  for (std::size_t k = 0; k < count; ++k)
    nearest.push_back(to_nearest_other(own, known, known[k * known.size() / count]));
  const auto at = static_cast<std::size_t>(kNearlyAll * static_cast<double>(nearest.size() - 1));
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(at),
                   nearest.end());
  return nearest[at];
}

}  // namespace

double pose_distance(const Measurements& a, int i, const Measurements& b, int j) {
  const double d = (a.q.row(i) - b.q.row(j)).norm();
  return d < kSamePose ? 0.0 : d;
}

std::vector<bool> elsewhere(const Measurements& own, const std::vector<int>& known,
                            const Measurements& rows) {
  std::vector<bool> out(static_cast<std::size_t>(rows.size()), false);
  if (known.empty()) return out;
  const double usual = usual_distance(own, known);
  for (int i = 0; i < rows.size(); ++i)
    out[static_cast<std::size_t>(i)] = std::none_of(known.begin(), known.end(), [&](int row) {
      return pose_distance(rows, i, own, row) <= usual;
    });
  return out;
}

}  // namespace plumb::offline::recheck
