// SPDX-License-Identifier: Apache-2.0
#include "check/identifiability.hpp"

#include <algorithm>

#include "check/imagined_poses.hpp"
#include "check/spectrum.hpp"
#include "fit/parameter_subset.hpp"
#include "fit/weights.hpp"

namespace plumb::offline {
namespace {

constexpr int kMostRows = 1500;
constexpr double kTypical_m = 0.5e-3;
constexpr double kTypical_rad = 0.5e-3;
constexpr double kMillimetre = 1e-3;

FitData data_of(const Cell& cell, const Measurements& measured, const std::vector<int>& rows) {
  FitData data;
  data.measured = &measured;
  data.rows = rows;
  data.sigma_m = stated_sigma(cell, measured);
  if (measured.has_orientation()) data.sigma_rad = cell.measurement.sigma_rad.value_or(0.0);
  return data;
}

/// Candidates that were fitted, in covariance order, and the others.
std::pair<std::vector<Parameter>, std::vector<Parameter>> divided(
    const std::vector<Parameter>& candidates, const std::vector<Estimate>& estimates) {
  std::vector<Parameter> kept, held = candidates;
  for (const auto& e : estimates) {
    const auto same = [&](const Parameter& p) { return p.name == e.name; };
    kept.push_back(*std::find_if(candidates.begin(), candidates.end(), same));
    std::erase_if(held, same);
  }
  return {kept, held};
}

Observability typical_observability(FitData data, const ArmState& state,
                                    const std::vector<Parameter>& kept) {
  data.sigma_m.setConstant(kMillimetre);
  data.sigma_rad = 0.0;
  Eigen::VectorXd sizes(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i)
    sizes(static_cast<Eigen::Index>(i)) = kept[i].is_length() ? kTypical_m : kTypical_rad;
  const Eigen::MatrixXd J = evaluate(data, state, kept).jacobian * sizes.asDiagonal();
  return observability(singular_values(J), static_cast<int>(data.rows.size()));
}

}  // namespace

IdentifiabilityReport identifiability(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows) {
  const std::vector<int> thin = thinned(rows, kMostRows);
  IdentifiabilityReport out;
  out.calibration = calibrate(cell, measured, thin);
  const FitData data = data_of(cell, measured, thin);
  const auto candidates =
      candidate_parameters(cell, data.sigma_rad > 0.0 ? Orientation::kUsed : Orientation::kIgnored);
  const auto [kept, held] = divided(candidates, out.calibration.estimates);
  const ArmState& state = out.calibration.state;
  out.candidates = static_cast<int>(candidates.size());
  out.rank = spectrum(evaluate(data, state, candidates).jacobian).rank;
  out.rank_anywhere = spectrum(at_imagined_poses(cell, data, state, candidates)).rank;
  out.scaled_condition = spectrum(evaluate(data, state, kept).jacobian).condition;
  out.observability = typical_observability(data, state, kept);
  out.separations = separations(cell, data, state, kept, held, out.calibration.covariance);
  return out;
}

}  // namespace plumb::offline
