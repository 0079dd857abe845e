// SPDX-License-Identifier: Apache-2.0
#include "fit/error_by_poses.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "arm/predicted_points.hpp"
#include "cell/random.hpp"
#include "fit/calibrate.hpp"
#include "fit/constants.hpp"
#include "fit/measured_orientations.hpp"

namespace plumb::offline {
namespace {

constexpr int kSizes[] = {8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512};
Cell without_others(Cell cell) {
  cell.fit.earlier.reset();
  std::erase_if(cell.fit.priors, [](const Prior& prior) { return prior.of_fleet; });
  return cell;
}

/// The rows of each pose with its repeats, which must not be split.
std::vector<std::vector<int>> poses_of(const Measurements& measured, const std::vector<int>& rows) {
  std::map<int, std::vector<int>> groups;
  for (const int row : rows)
    groups[measured.replicate_group[static_cast<std::size_t>(row)]].push_back(row);
  std::vector<std::vector<int>> out;
  for (auto& [group, its_rows] : groups) out.push_back(std::move(its_rows));
  return out;
}

struct PoseChoice {
  std::vector<int> fitted, judged;  // rows
};

PoseChoice chosen(std::vector<std::vector<int>> poses, int count, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < count; ++i)
    std::swap(
        poses[static_cast<std::size_t>(i)],
        poses[static_cast<std::size_t>(i + random.below(static_cast<int>(poses.size()) - i))]);
  PoseChoice out;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto& rows = static_cast<int>(i) < count ? out.fitted : out.judged;
    rows.insert(rows.end(), poses[i].begin(), poses[i].end());
  }
  std::sort(out.fitted.begin(), out.fitted.end());
  std::sort(out.judged.begin(), out.judged.end());
  return out;
}

/// Mean error at the judged readings; nothing if the fitted poses are too few or the fit fails.
std::optional<double> error_of(const Cell& cell, const Measurements& measured,
                               const PoseChoice& choice) {
  try {
    const Calibration found = calibrate(cell, measured, choice.fitted);
    const Measurements others = pick(measured, choice.judged);
    return residuals(others, predict_points(found.state, others)).rowwise().norm().mean();
  } catch (const Failure& failure) {
    if (failure.exit_code() != Exit::kNumbersSayNo) throw;
    return std::nullopt;
  }
}

/// Mean over all choices; nothing unless more than half of them could be fitted.
std::optional<double> mean_of(const std::vector<double>& errors) {
  if (static_cast<int>(errors.size()) <= kDraws / 2) return std::nullopt;
  double sum = 0.0;
  for (const double e : errors) sum += e;
  return sum / static_cast<double>(errors.size());
}

}  // namespace

bool takes_over(const Cell& cell) {
  return cell.fit.earlier != nullptr ||
         std::any_of(cell.fit.priors.begin(), cell.fit.priors.end(),
                     [](const Prior& prior) { return prior.of_fleet; });
}

std::vector<PosesAndError> error_by_poses(const Cell& stated, const Measurements& measured,
                                          const std::vector<int>& rows) {
  const Cell cell = as_judged(stated, measured);
  const auto poses = poses_of(measured, rows);
  const Cell alone = without_others(cell);
  const bool both = takes_over(cell);
  std::vector<PosesAndError> out;
  for (const int size : kSizes) {
    if (size > kMostFittedShare * static_cast<double>(poses.size())) break;
    std::vector<double> of_alone, of_both;
    for (int draw = 0; draw < kDraws; ++draw) {
      const PoseChoice choice =
          chosen(poses, size, cell.measurement.seed + static_cast<std::uint64_t>(draw));
      if (const auto e = error_of(alone, measured, choice)) of_alone.push_back(*e);
      if (!both) continue;
      if (const auto e = error_of(cell, measured, choice)) of_both.push_back(*e);
    }
    out.push_back({size, mean_of(of_alone), mean_of(of_both)});
  }
  return out;
}

std::optional<double> poses_alone(const std::vector<PosesAndError>& curve, double with_m) {
  const PosesAndError* before = nullptr;
  for (const auto& point : curve) {
    if (!point.alone_m) continue;
    if (*point.alone_m <= with_m) {
      if (before == nullptr) return point.poses;
      const double share =
          std::log(*before->alone_m / with_m) / std::log(*before->alone_m / *point.alone_m);
      return before->poses * std::pow(static_cast<double>(point.poses) / before->poses, share);
    }
    before = &point;
  }
  return std::nullopt;
}

}  // namespace plumb::offline
