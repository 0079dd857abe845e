// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/problem.hpp"

namespace plumb::tests {

/// The first problem with which `work` is refused; one without a code if it is not refused.
Problem problem_of(auto work) {
  try {
    work();
  } catch (const Failure& failure) {
    return failure.problems().front();
  }
  return {};
}

}  // namespace plumb::tests
