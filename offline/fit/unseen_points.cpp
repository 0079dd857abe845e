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

Rows3 predict_held_out(const MeasurementSettings& settings, const Measurements& measured,
                       const std::vector<int>& fitted, const std::vector<int>& held,
                       ArmState state) {
  place_unseen_points(settings, measured, fitted, state);
  Rows3 out = predict_points(state, pick(measured, held));
  const auto unseen = rows_of_unseen(settings, measured, fitted);
  for (std::size_t i = 0; i < held.size(); ++i) {
    const auto at = unseen.find(setup_of(measured, held[i]));
    if (at == unseen.end() || at->second.size() < 2) continue;
    const auto n = static_cast<double>(at->second.size());
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::RowVector3d point = measured.p_M.row(held[i]);
    out.row(row) = point + std::sqrt(n / (n - 1.0)) * (out.row(row) - point);
  }
  return out;
}

}  // namespace plumb::offline
