// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/detail/effect.hpp"

namespace plumb::offline {

/// How many times its usual size a fitted number is for certain (3 sigma); 0 if it has none.
double times_usual(double value, double std, const EffectParameter& info);

/// Whether an arm may well have it: a number, not clearly outside its bounds, not 20 times its
/// usual size.
bool plausible(double value, double std, const EffectParameter& info);

}  // namespace plumb::offline
