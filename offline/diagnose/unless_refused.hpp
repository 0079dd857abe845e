// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/problem.hpp"

namespace plumb::offline {

/// Runs `refits`, which refits models. Returns false if a refit failed because of the numbers (too
/// few coordinates, no convergence, another arm); all other failures pass through.
template <class Refits>
bool unless_refused(Refits&& refits) {
  try {
    refits();
    return true;
  } catch (const Failure& failure) {
    if (failure.exit_code() != Exit::kNumbersSayNo) throw;
    return false;
  }
}

}  // namespace plumb::offline
