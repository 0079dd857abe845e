// SPDX-License-Identifier: Apache-2.0
#include "fit/unseen_points.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "arm/predicted_points.hpp"
#include "cell/artefacts.hpp"
#include "noise/weights.hpp"
#include "numbers/quantile.hpp"
#include "solve/artefact_start.hpp"
#include "solve/solver.hpp"

namespace plumb::offline {
namespace {

/// So many times the median of the readings of an artefact: chosen as 10 standard deviations, for a
/// bad reading pulls the artefact towards itself and makes all others larger.
constexpr double kFarReading = 15.0;

/// Rows of each artefact of which `fitted` has none.
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
    if (used && of_artefact(settings, setup) && !seen.contains(setup)) out[setup].push_back(i);
  }
  return out;
}

/// The reading that lies farthest from an artefact fitted to `numbers` numbers, if it is far
/// outside the scatter of the others and these are enough without it.
std::optional<Eigen::Index> far_reading(const Solution& solution, std::size_t numbers) {
  const Eigen::VectorXd size = solution.residual.cwiseAbs();
  if (size.size() < 2 * static_cast<Eigen::Index>(numbers + 1)) return std::nullopt;
  Eigen::Index worst = 0;
  const double largest = size.maxCoeff(&worst);
  const double usual = median({size.data(), size.data() + size.size()});
  return largest > kFarReading * usual ? std::optional(worst) : std::nullopt;
}

/// Fits where the artefact is to its own rows, with the arm and the target as they are.
void place_artefact(const MeasurementSettings& settings, const Measurements& measured,
                    const std::vector<int>& rows, int setup, ArmState& state) {
  FitData data;
  data.measured = &measured;
  data.rows = rows;
  data.sigma_m = Rows3::Constant(measured.size(), 3, kUnstatedSigma_m);
  const std::vector<Parameter> own = artefact_parameters(settings, setup);
  Solution best = placed_artefact(data, state, setup,
                                  settings.setups[static_cast<std::size_t>(setup)].fit_length,
                                  [&](const ArmState& start) { return solve(data, start, own); });
  // A bad reading counts as an error of its own, and not as one of all others of its artefact.
  while (const auto worst = far_reading(best, own.size())) {
    data.rows.erase(data.rows.begin() + *worst);
    best = solve(data, best.state, own);
  }
  state.frame(setup) = best.state.frame(setup);
  state.length(setup) = best.state.length(setup);
}

}  // namespace

void place_unseen_points(const MeasurementSettings& settings, const Measurements& measured,
                         const std::vector<int>& fitted, ArmState& state) {
  for (const auto& [setup, rows] : rows_of_unseen(settings, measured, fitted)) {
    if (settings.setups[static_cast<std::size_t>(setup)].reads != ReadingKind::kPoint) {
      place_artefact(settings, measured, rows, setup, state);
      continue;
    }
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
    if (at == unseen.end()) continue;
    const auto lines = static_cast<double>(at->second.size()) * measured.axes(held[i]);
    const auto numbers =
        static_cast<double>(artefact_parameters(settings, setup_of(measured, held[i])).size());
    if (lines <= numbers) continue;
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::RowVector3d point = measured.p_M.row(held[i]);
    out.row(row) = point + std::sqrt(lines / (lines - numbers)) * (out.row(row) - point);
  }
  return out;
}

}  // namespace plumb::offline
