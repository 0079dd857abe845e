// SPDX-License-Identifier: Apache-2.0
#include "plan/contrasts.hpp"

namespace plumb::offline {

std::string contrast_words(Contrast contrast) {
  switch (contrast) {
    case Contrast::kBothSides:
      return "poses approached from + and from -";
    case Contrast::kShortAndLong:
      return "poses reached from + and from -, by short and by long moves of each joint";
    case Contrast::kColdAndWarm:
      return "poses cold and warm, at least 5 K apart";
    case Contrast::kEndAgain:
      return "poses at once and an hour later, the first ones again at the end";
    case Contrast::kTwoPayloads:
      return "poses with and without payload";
    case Contrast::kNone:
      break;
  }
  return "poses alone";
}

const char* contrast_name(Contrast contrast) {
  switch (contrast) {
    case Contrast::kBothSides:
      return "both_sides";
    case Contrast::kShortAndLong:
      return "short_and_long";
    case Contrast::kColdAndWarm:
      return "cold_and_warm";
    case Contrast::kEndAgain:
      return "end_again";
    case Contrast::kTwoPayloads:
      return "two_payloads";
    case Contrast::kNone:
      break;
  }
  return "none";
}

}  // namespace plumb::offline
