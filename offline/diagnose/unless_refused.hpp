// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/problem.hpp"

namespace plumb::offline {

/// Runs what refits models. Returns false if a refit was refused because the numbers say no (too
/// few coordinates, no convergence, another arm); any other failure, of files or of the program, is
/// no answer of a fit and passes through.
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
