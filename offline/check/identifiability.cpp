// SPDX-License-Identifier: Apache-2.0
#include "check/identifiability.hpp"

#include <algorithm>

#include "check/constants.hpp"
#include "check/spectrum.hpp"
#include "fit/calibrate.hpp"
#include "noise/weights.hpp"
#include "solve/evaluation.hpp"
#include "solve/imagined_poses.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// The scale of the observability indices, by definition: mm of the point for each 0.5 mm or 0.5
/// mrad of a parameter, the errors of an arm as it is built.
constexpr double kTypical_m = 0.5e-3, kTypical_rad = 0.5e-3, kMillimetre = 1e-3;

FitData data_of(const Cell& cell, const Measurements& measured, const std::vector<int>& rows) {
  FitData data;
  data.measured = &measured;
  data.rows = rows;
  data.sigma_m = stated_sigma(cell, measured);
  if (measured.has_orientation()) data.sigma_rad = cell.measurement.sigma_rad.value_or(0.0);
  return data;
}

/// The parameters of `all` that are not in `some`.
std::vector<Parameter> others(const std::vector<Parameter>& all,
                              const std::vector<Parameter>& some) {
  std::vector<Parameter> out;
  for (const auto& p : all)
    if (std::none_of(some.begin(), some.end(),
                     [&](const Parameter& one) { return one.name == p.name; }))
      out.push_back(p);
  return out;
}

std::vector<Parameter> without_effects(std::vector<Parameter> parameters) {
  std::erase_if(parameters, [](const Parameter& p) { return p.of_effect(); });
  return parameters;
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
  const std::vector<int> thin = thinned(measured, rows, check::kIdentifiabilityRows);
  IdentifiabilityReport out;
  out.calibration = calibrate(cell, measured, thin);
  const FitData data = data_of(cell, measured, thin);
  const ArmState& state = out.calibration.state;
  const auto& kept = out.calibration.parameters;
  const auto candidates = calibration_candidates(cell, measured, state);
  const auto geometry = without_effects(candidates);
  out.candidates = static_cast<int>(candidates.size());
  out.rank = spectrum(evaluate(data, state, candidates).jacobian).rank;
  out.rank_anywhere = spectrum(at_imagined_poses(cell, data, state, geometry)).rank;
  out.scaled_condition = spectrum(evaluate(data, state, kept).jacobian).condition;
  out.observability = typical_observability(data, state, without_effects(kept));
  out.separations =
      separations(cell, data, state, kept, others(candidates, kept), out.calibration.covariance);
  return out;
}

}  // namespace plumb::offline
