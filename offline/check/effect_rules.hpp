// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "check/data_sense.hpp"

namespace plumb::offline {

/// Whether data can show an effect, why, and what to measure if not.
struct Testable {
  enum class Answer { kNo, kWeakly, kYes } answer = Answer::kYes;
  std::string effect;
  std::string why;
  std::string measure;  // empty if there is nothing to add
};

/// One answer for each effect of the library, in its order. "No" means not testable with this
/// data, never absent.
std::vector<Testable> testable_effects(const Cell& cell, const DataSense& sense);

}  // namespace plumb::offline
