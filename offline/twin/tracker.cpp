// SPDX-License-Identifier: Apache-2.0
#include "twin/tracker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "twin/surroundings.hpp"

namespace plumb::offline::twin {
namespace {

constexpr std::uint64_t kOtherNoise = 0x7ac4e2;  // so that it differs from the measurements

RowsN joints_of(const std::vector<Stop>& stops) {
  RowsN q(static_cast<Eigen::Index>(stops.size()), stops.front().q.size());
  for (std::size_t k = 0; k < stops.size(); ++k)
    q.row(static_cast<Eigen::Index>(k)) = stops[k].q.transpose();
  return q;
}

/// Distance of each measured point from where the reflector should be.
std::vector<double> misses(const std::vector<Stop>& stops, const Simulation& seen,
                           const Rows3& p_M) {
  const Isometry3d X_BM = sim::to_isometry(seen.X_MB).inverse();
  const Vector3d target_T = sim::to_isometry(seen.X_TG).translation();
  std::vector<double> out;
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const Vector3d p_B = X_BM * Vector3d(p_M.row(static_cast<Eigen::Index>(k)).transpose());
    out.push_back((p_B - stops[k].X_BD * target_T).norm());
  }
  return out;
}

void check_frame(const Cell& cell) {
  if (!cell.measurement.fit_frame && !cell.measurement.fit_target) return;
  throw Failure(Exit::kInput,
                {.code = "E-TWIN-FRAME",
                 .message = "the cell fits where tracker or reflector stand, so the true error has "
                            "no frame to be stated in",
                 .place = Place{.file = cell.file.string()},
                 .help = "state frame = { xyz = ..., rpy = ... } and target = [x, y, z] in "
                         "[measurement], or make a cell with: plumb-twin new DIR"});
}

}  // namespace

ErrorFigures figures_of(std::vector<double> errors_m) {
  if (errors_m.empty()) return {};
  std::sort(errors_m.begin(), errors_m.end());
  const auto n = errors_m.size();
  const double sum = std::accumulate(errors_m.begin(), errors_m.end(), 0.0);
  const double squares =
      std::inner_product(errors_m.begin(), errors_m.end(), errors_m.begin(), 0.0);
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(n)));
  return {.n = static_cast<int>(n),
          .mean_m = sum / static_cast<double>(n),
          .rms_m = std::sqrt(squares / static_cast<double>(n)),
          .p95_m = errors_m[rank - 1],
          .max_m = errors_m.back()};
}

TrueErrors true_errors(const Cell& cell, const Hidden& hidden, const HiddenTruth& truth,
                       int stations, const std::vector<Stop>& stops) {
  check_frame(cell);
  if (stops.empty()) return {};
  SimulationPlan plan = visits_of(truth, joints_of(stops), stations);
  const Simulation arm = simulate(cell, plan);
  plan.noise_m = hidden.noise_m;
  plan.seed = hidden.seed ^ kOtherNoise;
  const Simulation seen = simulate(cell, plan);
  const auto each_m = misses(stops, arm, arm.true_p_M);
  return {figures_of(each_m), figures_of(misses(stops, seen, seen.measured.p_M)), each_m};
}

NoiseFloor floor_of(double sigma_m) {
  return {sigma_m * std::sqrt(8.0 / std::numbers::pi), sigma_m * std::sqrt(3.0)};
}

format::Chain true_chain(const Cell& cell, const HiddenTruth& truth) {
  RowsN q = RowsN::Zero(1, cell.joints());
  HiddenTruth bare = truth;
  bare.sized.clear();
  bare.effects.clear();
  return simulate(cell, visits_of(bare, q, 1)).true_chain;
}

double Comparison::ratio() const {
  return on.truth.n > 0 && off.truth.n > 0 ? off.truth.mean_m / on.truth.mean_m : 0.0;
}

bool Comparison::reached() const {
  return ratio() >= kLeastRatio && on.measured.mean_m < kMostOverFloor * floor.mean_m &&
         on.measured.rms_m < kMostOverFloor * floor.rms_m;
}

}  // namespace plumb::offline::twin
