// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"

namespace plumb::offline {

/// How a formula depends on its parameters.
enum class Degree { kNone, kLinear, kCurved };

/// On one of them, the others being held.
Degree degree_of(const format::Formula& formula, int parameter);

/// On all of them together: k * (1 + c * tau2) is curved, though linear in k and in c.
Degree degree_of(const format::Formula& formula);

}  // namespace plumb::offline
