// SPDX-License-Identifier: Apache-2.0
#include "noise/noise_floor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "arm/predicted_points.hpp"
#include "cell/group_rows.hpp"
#include "noise/constants.hpp"
#include "noise/repeat_groups.hpp"
#include "noise/stated_touch.hpp"
#include "numbers/quantile.hpp"
#include "solve/constants.hpp"

namespace plumb::offline {

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

namespace {

using Readings = std::vector<Eigen::RowVector3d>;

/// Keeps one of the readings that are equal to the last digit: they are copies.
void take_copies_once(const Rows3& p_M, std::vector<int>& rows) {
  const auto number = [&](int row) { return std::array{p_M(row, 0), p_M(row, 1), p_M(row, 2)}; };
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return number(a) < number(b); });
  const auto same = [&](int a, int b) { return number(a) == number(b); };
  rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
}

/// Rows of each group of repeats. A group is cut where more than `far` rows lie between two
/// repeats, because a drift or a step in between is no noise.
std::vector<std::vector<int>> near_rows(const Measurements& m, const std::vector<int>& group,
                                        double far) {
  std::vector<int> used;
  for (int i = 0; i < m.size(); ++i)
    if (m.set.empty() || m.set[i] != SetMark::kIgnore) used.push_back(i);
  std::vector<std::vector<int>> out;
  visit_groups(group, std::move(used), [&](std::span<const int> rows) {
    for (std::size_t i = 0, end = 0; i < rows.size(); i = end) {
      for (end = i + 1; end < rows.size() && rows[end] - rows[end - 1] <= far;) ++end;
      if (end - i > 1) out.emplace_back(rows.begin() + i, rows.begin() + end);
    }
  });
  return out;
}

/// The rows of left_M of every repeated pose.
std::vector<Readings> repeated(const Measurements& m, const std::vector<int>& group,
                               const Rows3& left_M, double far) {
  std::vector<Readings> out;
  for (auto& rows : near_rows(m, group, far)) {
    take_copies_once(m.p_M, rows);
    if (rows.size() < 2) continue;
    Readings readings;
    for (const int row : rows) readings.push_back(left_M.row(row));
    out.push_back(std::move(readings));
  }
  return out;
}

Eigen::RowVector3d mean_of(const Readings& readings) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const auto& p : readings) sum += p;
  return sum / static_cast<double>(readings.size());
}

/// The median of each coordinate; the mean if there are only two or three readings.
Eigen::RowVector3d centre_of(const Readings& readings) {
  if (readings.size() < 4) return mean_of(readings);
  Eigen::RowVector3d out;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const auto& p : readings) values.push_back(p(k));
    out(k) = median(std::move(values));
  }
  return out;
}

/// Factor that corrects distances from the mean of n readings for the lost degree of freedom.
double unbiased(const Readings& readings) {
  const auto n = static_cast<double>(readings.size());
  return std::sqrt(n / (n - 1.0));
}

/// Robust standard deviation per axis, from the median [m].
double usual_sigma(const std::vector<Readings>& poses, const std::array<bool, 3>& has_axis) {
  std::vector<double> distances;
  for (const auto& readings : poses) {
    const Eigen::RowVector3d centre = centre_of(readings);
    for (const auto& p : readings)
      for (int k = 0; k < 3; ++k)
        if (has_axis[k]) distances.push_back(std::abs(p(k) - centre(k)) * unbiased(readings));
  }
  return kNormalMedian * median(std::move(distances));
}

/// Removes bad readings, which are no noise. Where two readings of a pose contradict each other,
/// both are removed.
void drop_contradicted(std::vector<Readings>& poses, double far) {
  for (auto& readings : poses) {
    const Eigen::RowVector3d centre = centre_of(readings);
    const double most = far / unbiased(readings);
    std::erase_if(readings, [&](const auto& p) { return (p - centre).norm() > most; });
  }
  std::erase_if(poses, [](const Readings& readings) { return readings.size() < 2; });
}

struct PooledScatter {
  double squares = 0.0;
  int dof = 0;  // poses, not coordinates
};

PooledScatter pooled(const Measurements& m, const std::vector<int>& group, const Rows3& left_M,
                     int axes, double far) {
  std::vector<Readings> poses = repeated(m, group, left_M, far);
  if (poses.empty()) return {};
  const double usual = usual_sigma(poses, m.has_axis);
  if (usual > 0.0) drop_contradicted(poses, kOutlierTimes * std::sqrt(axes) * usual);
  PooledScatter out;
  for (const auto& readings : poses) {
    const Eigen::RowVector3d mean = mean_of(readings);
    for (const auto& p : readings) out.squares += (p - mean).squaredNorm();
    out.dof += static_cast<int>(readings.size()) - 1;
  }
  return out;
}

/// Scatter of repeats that lie near to each other in the file: as near as possible with enough of
/// them, else of all repeats.
PooledScatter pooled_repeats(const Measurements& m, const Rows3& left_M, int axes) {
  const std::vector<int> group = repeat_groups(m);
  PooledScatter out;
  for (const double share : kNearShares) {
    out = pooled(m, group, left_M, axes, std::max(kNextTo, share * static_cast<double>(m.size())));
    if (out.dof >= kEnoughRepeats) break;
  }
  return out;
}

/// What the cell states of one coordinate; of readings about artefacts alone, what it states of
/// them.
std::optional<double> stated_floor(const Cell& cell, const Measurements& measured) {
  const bool artefacts =
      !measured.kind.empty() &&
      std::all_of(measured.kind.begin(), measured.kind.end(),
                  [](ReadingKind kind) { return kind != ReadingKind::kPosition; });
  return artefacts ? sigma_of_touches(cell, measured) : cell.measurement.sigma_m;
}

/// left_M: the readings, or their residuals from a model.
NoiseFloor floor_of(const Cell& cell, const Measurements& measured, const Rows3& left_M) {
  const int axes = measured.usual_axes();
  NoiseFloor out;
  const PooledScatter repeats = pooled_repeats(measured, left_M, axes);
  if (repeats.dof >= kEnoughRepeats) {
    out.sigma_m = std::sqrt(repeats.squares / (repeats.dof * axes));
    out.source = NoiseFloor::Source::kRepeats;
    out.dof = repeats.dof * axes;
  } else if (measured.sigma_m.rows() > 0) {
    // The columns of axes that were not measured hold zeros, so the sum is over `axes` columns.
    out.sigma_m = std::sqrt(measured.sigma_m.squaredNorm() /
                            (static_cast<double>(measured.sigma_m.rows()) * axes));
    out.source = NoiseFloor::Source::kSigma;
  } else if (const auto stated = stated_floor(cell, measured)) {
    out.sigma_m = *stated;
    out.source = NoiseFloor::Source::kSigma;
  }
  out.mean_m = mean_norm(axes) * out.sigma_m;
  out.rms_m = std::sqrt(static_cast<double>(axes)) * out.sigma_m;
  return out;
}

}  // namespace

std::string floor_words(const NoiseFloor& floor) {
  if (floor.source == NoiseFloor::Source::kNone) return "noise floor unknown";
  return fmt::format("noise floor {:.3f} mm{}", floor.mean_m * 1e3,
                     floor.source == NoiseFloor::Source::kSigma ? " of the stated sigma" : "");
}

double trusted_dof(const NoiseFloor& floor) {
  if (floor.source == NoiseFloor::Source::kNone) return 0.0;
  return floor.dof > 0 ? static_cast<double>(floor.dof) : kStatedDof;
}

NoiseFloor noise_floor(const Cell& cell, const Measurements& measured) {
  return floor_of(cell, measured, measured.p_M);
}

NoiseFloor noise_floor(const Cell& cell, const Measurements& measured, const ArmState& model) {
  return floor_of(cell, measured, residuals(measured, predict_points(model, measured)));
}

}  // namespace plumb::offline
