// SPDX-License-Identifier: Apache-2.0
#include "fit/unseen_points.hpp"

#include <cmath>
#include <map>
#include <set>

#include "arm/predicted_points.hpp"
#include "cell/touched_points.hpp"

namespace plumb::offline {
namespace {

/// Rows of each touched point of which `fitted` has none.
std::map<int, std::vector<int>> rows_of_unseen(const MeasurementSettings& settings,
                                               const Measurements& measured,
                                               const std::vector<int>& fitted) {
  std::map<int, std::vector<int>> out;
  if (measured.placement.empty()) return out;
  std::set<int> seen;
  for (const int row : fitted) seen.insert(setup_of(measured, row));
  for (int i = 0; i < measured.size(); ++i) {
    const int setup = setup_of(measured, i);
    const bool used = measured.set.empty() || measured.set[i] != SetMark::kIgnore;
    if (used && touches_point(settings, setup) && !seen.contains(setup)) out[setup].push_back(i);
  }
  return out;
}

}  // namespace

void place_unseen_points(const MeasurementSettings& settings, const Measurements& measured,
                         const std::vector<int>& fitted, ArmState& state) {
  for (const auto& [setup, rows] : rows_of_unseen(settings, measured, fitted)) {
    const Measurements some = pick(measured, rows);
    const Eigen::RowVector3d missed = residuals(some, predict_points(state, some)).colwise().mean();
    for (int k = 0; k < 3; ++k) state.frame(setup).p[static_cast<std::size_t>(k)] += missed(k);
  }
}

void widen_about_unseen_points(const MeasurementSettings& settings, const Measurements& measured,
                               const std::vector<int>& fitted, const std::vector<int>& held,
                               Rows3& predicted_M) {
  const auto unseen = rows_of_unseen(settings, measured, fitted);
  for (const int row : held) {
    const auto at = unseen.find(setup_of(measured, row));
    if (at == unseen.end() || at->second.size() < 2) continue;
    const auto n = static_cast<double>(at->second.size());
    const Eigen::RowVector3d from_point = predicted_M.row(row) - measured.p_M.row(row);
    predicted_M.row(row) = measured.p_M.row(row) + std::sqrt(n / (n - 1.0)) * from_point;
  }
}

}  // namespace plumb::offline
