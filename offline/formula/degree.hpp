// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// How a formula depends on its parameters.
enum class Degree { kNone, kLinear, kCurved };

/// How it depends on one parameter while the others are constant.
Degree degree_of(const format::Formula& formula, int parameter);

/// How it depends on all parameters together: k * (1 + c * tau2) is curved, although it is linear
/// in k and in c.
Degree degree_of(const format::Formula& formula);

}  // namespace plumb::offline
