// SPDX-License-Identifier: Apache-2.0
#include "fit/plausible.hpp"

#include <algorithm>
#include <cmath>

#include "fit/constants.hpp"
#include "fit/fit_judgement.hpp"

namespace plumb::offline {

double times_usual(double value, double std, const EffectParameter& info) {
  if (info.typical == 0.0) return 0.0;
  return std::max(0.0, std::abs(value) - kSureSigma * std) / info.typical;
}

bool plausible(double value, double std, const EffectParameter& info) {
  return std::isfinite(value) && std::isfinite(std) && possible(value, std, info) &&
         times_usual(value, std, info) <= kMostTimesUsual;
}

}  // namespace plumb::offline
