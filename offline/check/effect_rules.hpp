// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "effects/data_sense.hpp"
#include "effects/testability.hpp"

namespace plumb::offline {

/// Whether data can show an effect, why, and what to measure if not.
struct Testable {
  using Answer = Testability::Answer;
  Answer answer = Answer::kYes;
  std::string effect;
  std::string why;
  std::string measure;  // empty if there is nothing to add
};

/// One answer for geometry and each effect of the library, in the order of the registry. "No" means
/// not testable with this data, never absent.
std::vector<Testable> testable_effects(const DataSense& sense);

}  // namespace plumb::offline
