// SPDX-License-Identifier: Apache-2.0
#include "check/effect_sense.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/parameter.hpp"
#include "arm/predicted_points.hpp"
#include "cell/effect_option.hpp"
#include "check/constants.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {

std::vector<Problem> option_findings(const Cell& cell) {
  std::vector<Problem> out;
  for (const EffectEntry& entry : cell.effects)
    for (const EffectOption& option : options_of(entry.name)) {
      const double value = number_option(entry, option.key, option.credible_least);
      if (value >= option.credible_least && value <= option.credible_most) continue;
      out.push_back({Severity::kWarning, "W-CHECK-EFFECT",
                     fmt::format("{} of effect {} is {:g}: no arm is like that", option.name(),
                                 entry.name, value),
                     entry.place, option.credible_help});
    }
  return out;
}

std::vector<Problem> effect_size_findings(const Cell& cell, const Measurements& measured,
                                          const std::vector<int>& rows, const ArmState& fitted) {
  std::vector<Problem> out;
  const Measurements some = pick(measured, thinned(measured, rows, check::kPredictedRows));
  const double most = check::kLargestEffect * reach(cell.nominal);
  const Rows3 with = predict_points(fitted, some);
  for (std::size_t k = 0; k < fitted.arm.effects.size(); ++k) {
    ArmState without = fitted;
    without.arm.effects.erase(without.arm.effects.begin() + static_cast<std::ptrdiff_t>(k));
    const double size = (with - predict_points(without, some)).rowwise().norm().maxCoeff();
    if (size <= most) continue;
    out.push_back(
        {Severity::kWarning, "W-CHECK-EFFECT",
         fmt::format("effect {} moves the measured point by up to {:.3g} mm: no arm errs so much "
                     "and works",
                     fitted.arm.effects[k].name, size * 1e3),
         std::nullopt,
         "drop it, and look for wrong joint readings or units: plumb drop " +
             fitted.arm.effects[k].name});
  }
  return out;
}

}  // namespace plumb::offline
