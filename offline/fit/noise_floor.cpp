// SPDX-License-Identifier: Apache-2.0
#include "fit/noise_floor.hpp"

#include <cmath>
#include <map>

namespace plumb::offline {
namespace {

constexpr int kEnoughRepeats = 5;  // degrees of freedom per axis

/// Mean of the chi distribution: E|x| of an isotropic normal vector with unit sigma.
double mean_norm(int axes) {
  switch (axes) {
    case 1:
      return std::sqrt(2.0 / M_PI);
    case 2:
      return std::sqrt(M_PI / 2.0);
    default:
      return 2.0 * std::sqrt(2.0 / M_PI);
  }
}

struct Pooled {
  double squares = 0.0;
  int dof = 0;  // poses, not coordinates
};

Pooled pooled_repeats(const Measurements& m) {
  std::map<int, std::vector<int>> groups;
  for (int i = 0; i < m.size(); ++i) groups[m.replicate_group[i]].push_back(i);
  Pooled out;
  for (const auto& [group, rows] : groups) {
    if (rows.size() < 2) continue;
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (int i : rows) mean += m.p_M.row(i) / static_cast<double>(rows.size());
    for (int i : rows) out.squares += (m.p_M.row(i) - mean).squaredNorm();
    out.dof += static_cast<int>(rows.size()) - 1;
  }
  return out;
}

}  // namespace

NoiseFloor noise_floor(const Cell& cell, const Measurements& measured) {
  int axes = 0;
  for (bool has : measured.has_axis) axes += has ? 1 : 0;
  NoiseFloor out;
  const Pooled repeats = pooled_repeats(measured);
  if (repeats.dof >= kEnoughRepeats) {
    out.sigma_m = std::sqrt(repeats.squares / (repeats.dof * axes));
    out.source = NoiseFloor::Source::kRepeats;
    out.dof = repeats.dof * axes;
  } else if (measured.sigma_m.rows() > 0) {
    // Columns of axes that were not measured hold zeros.
    out.sigma_m = std::sqrt(measured.sigma_m.squaredNorm() /
                            (static_cast<double>(measured.sigma_m.rows()) * axes));
    out.source = NoiseFloor::Source::kSigma;
  } else if (cell.measurement.sigma_m) {
    out.sigma_m = *cell.measurement.sigma_m;
    out.source = NoiseFloor::Source::kSigma;
  }
  out.mean_m = mean_norm(axes) * out.sigma_m;
  out.rms_m = std::sqrt(static_cast<double>(axes)) * out.sigma_m;
  return out;
}

}  // namespace plumb::offline
