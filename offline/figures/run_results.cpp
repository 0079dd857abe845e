// SPDX-License-Identifier: Apache-2.0
#include "figures/run_results.hpp"

#include <algorithm>

#include "arm/arm_state.hpp"
#include "arm/predicted_points.hpp"
#include "compare/pose_words.hpp"
#include "fit/calibrate.hpp"
#include "fit/measured_orientations.hpp"
#include "runs/earlier_runs.hpp"

namespace plumb::offline::figures {

RunResults results_of(const Cell& cell, const Measurements& measured, const Run& run) {
  const Split& split = run.fit.split;
  const ArmState nominal = place_nominal(as_judged(cell, measured), measured, fit_rows(split));
  RunResults out{.cell = cell,
                 .measured = measured,
                 .run = run,
                 .before_M = residuals(measured, predict_points(nominal, measured)),
                 .after_M = residuals(measured, run.fit.predicted_M),
                 .held = held_rows(split),
                 .fit = {},
                 .rechecks = rechecks_of(run, cell)};
  std::vector<bool> is_held(split.used.size(), false);
  for (const int row : out.held) is_held[static_cast<std::size_t>(row)] = true;
  for (int row = 0; row < measured.size(); ++row)
    if (split.used[static_cast<std::size_t>(row)] && !is_held[static_cast<std::size_t>(row)])
      out.fit.push_back(row);
  return out;
}

std::vector<int> usual_rows(const RunResults& results, std::vector<int> rows) {
  return compare::usual_rows(results.run.fit, std::move(rows));
}

std::vector<std::optional<Parameter>> fitted_parameters(const Run& run) {
  const Calibration& c = run.fit.calibration;
  const auto known = std::min(c.parameters.size(), static_cast<std::size_t>(c.covariance.rows()));
  std::vector<std::optional<Parameter>> out(known);
  for (std::size_t k = 0; k < known; ++k)
    if (c.parameters[k].of_robot()) out[k] = c.parameters[k];
  return out;
}

}  // namespace plumb::offline::figures
