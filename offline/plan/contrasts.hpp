// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline {

/// What is changed between readings, beside the pose, so that two effects move the point
/// differently.
enum class Contrast {
  kNone,          // poses alone
  kBothSides,     // every joint arriving from below, and from above
  kShortAndLong,  // by short and by long last moves
  kColdAndWarm,   // before and after warming up
  kEndAgain,      // at once and later, some poses again
  kTwoPayloads    // without and with a load, or with two
};

/// "poses approached from + and from -".
std::string contrast_words(Contrast contrast);

/// Stable name for programs: "both_sides".
const char* contrast_name(Contrast contrast);

}  // namespace plumb::offline
