// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline {

/// How similar an arm is to one that was calibrated earlier, according to its own readings.
struct Likeness {
  enum class Kind { kSame, kSister, kUnlike, kUnknown } kind = Kind::kUnknown;
  std::string run;           // folder of the earlier run
  int numbers = 0;           // that both models have
  double same_chance = 0.0;  // probability that they are the same, apart from one change at most
  double share = 0.0;        // correlation r of their differences from nominal, 0 to 1
  double spread_m = 0.0, spread_rad = 0.0;  // 1 sigma of the difference between the two arms
  std::string changed;  // the number that has changed, or "offsets": those of several joints
};

/// "same", "sister", "unlike", "unknown"
const char* name_of(Likeness::Kind kind);

}  // namespace plumb::offline
