// SPDX-License-Identifier: Apache-2.0
#include "diagnose/plausible.hpp"

#include <algorithm>
#include <cmath>

#include "fit/fit_judgement.hpp"

namespace plumb::offline {
namespace {

constexpr double kMostTimes = 20.0;  // the usual size
constexpr double kSure = 3.0;        // sigma

}  // namespace

double times_usual(double value, double std, const EffectParameter& info) {
  if (info.typical == 0.0) return 0.0;
  return std::max(0.0, std::abs(value) - kSure * std) / info.typical;
}

bool plausible(double value, double std, const EffectParameter& info) {
  return possible(value, std, info) && times_usual(value, std, info) <= kMostTimes;
}

}  // namespace plumb::offline
