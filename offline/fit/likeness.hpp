// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline {

/// How much an arm has in common with one that was calibrated earlier, as its own readings say it.
struct Likeness {
  enum class Kind { kSame, kSister, kUnlike, kUnknown } kind = Kind::kUnknown;
  std::string run;           // folder of the earlier run
  int numbers = 0;           // that both have
  double same_chance = 0.0;  // that their numbers are as good as equal, one perhaps excepted
  double share = 0.0;  // of the earlier arm's differences from nominal that this one has, 0..1
  double spread_m = 0.0, spread_rad = 0.0;  // 1 sigma of the difference between the two arms
  std::string changed;  // the one number in which they differ, or "offsets": of several joints
};

/// "same", "sister", "unlike", "unknown"
const char* name_of(Likeness::Kind kind);

}  // namespace plumb::offline
