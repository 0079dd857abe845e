// SPDX-License-Identifier: Apache-2.0
#include "noise/orientation_floor.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "cell/group_rows.hpp"
#include "noise/constants.hpp"
#include "noise/repeat_groups.hpp"
#include "numbers/quantile.hpp"
#include "plumb/runtime/transform.hpp"
#include "solve/constants.hpp"

namespace plumb::offline {

std::vector<Matrix3> rotations_of(const Rows4& quat) {
  std::vector<Matrix3> out;
  for (Eigen::Index i = 0; i < quat.rows(); ++i)
    out.push_back(from_pose({{}, {quat(i, 0), quat(i, 1), quat(i, 2), quat(i, 3)}}).R);
  return out;
}

double sigma_of_angles(std::vector<double> angles_rad) {
  return median(std::move(angles_rad)) / kMedianChi[3];
}

std::optional<double> orientation_scatter(const Measurements& measured,
                                          const std::vector<int>& group) {
  std::vector<int> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.set.empty() || measured.set[static_cast<std::size_t>(i)] != SetMark::kIgnore)
      rows.push_back(i);
  const std::vector<Matrix3> read = rotations_of(measured.quat_M);
  std::vector<double> off;
  visit_groups(group, std::move(rows), [&](std::span<const int> of_pose) {
    for (std::size_t k = 1; k < of_pose.size(); k += 2) {
      const int a = of_pose[k - 1], b = of_pose[k];
      if (measured.quat_M.row(a) == measured.quat_M.row(b) &&
          measured.p_M.row(a) == measured.p_M.row(b))
        continue;
      off.push_back(rotation_vector(read[static_cast<std::size_t>(b)] *
                                    read[static_cast<std::size_t>(a)].transpose())
                        .norm() /
                    std::sqrt(2.0));
    }
  });
  if (off.size() < kFewestOrientationPairs) return std::nullopt;
  return sigma_of_angles(std::move(off));
}

OrientationFloor orientation_floor(const Cell& cell, const Measurements& measured) {
  OrientationFloor out;
  if (!measured.has_orientation() || !cell.measurement.sigma_rad) return out;
  const auto repeats = orientation_scatter(measured, repeat_groups(measured));
  if (repeats && *repeats > 0.0) {
    out.source = NoiseFloor::Source::kRepeats;
    out.sigma_rad = *repeats;
  } else {
    out.source = NoiseFloor::Source::kSigma;
    out.sigma_rad = *cell.measurement.sigma_rad;
  }
  out.mean_rad = mean_norm(3) * out.sigma_rad;
  return out;
}

std::string angle_words(double rad) {
  return fmt::format("{:.4f} deg", rad * 180.0 / std::numbers::pi);
}

std::string missed_words(double mean_rad, const OrientationFloor& floor) {
  return fmt::format("orientations miss by {}, {:.1f} times their noise floor {}{}",
                     angle_words(mean_rad), mean_rad / floor.mean_rad, angle_words(floor.mean_rad),
                     floor.source == NoiseFloor::Source::kSigma ? " of the stated sigma" : "");
}

}  // namespace plumb::offline
