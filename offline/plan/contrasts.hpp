// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/measurements.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb::offline {

/// The same poses measured twice, with one thing changed in between.
enum class Contrast {
  kNone,
  kLongerWait,   // at once, and again after a pause
  kBothSides,    // every joint arriving from below, and from above
  kEndAgain,     // the first poses again at the end
  kTwoPayloads,  // without and with a load
  kColdAndWarm,  // before and after warming up
  kPulled        // free, and pulled by a known force
};

/// Contrasts that change the motion of the effect, but not that of the geometry.
std::vector<Contrast> contrasts_of(const EffectInfo& effect);

/// Those that change one of two effects and not the other, the cheapest first.
std::vector<Contrast> separating_contrasts(const EffectInfo& a, const EffectInfo& b);

/// "the same poses from the + and the - side".
std::string contrast_words(Contrast contrast);

/// Stable name for programs: "both_sides".
const char* contrast_name(Contrast contrast);

/// What to do at the first and the second measurement of a pose.
std::string instruction(Contrast contrast, bool second);

/// Whether the second measurements follow each first one, or all come after all first ones.
bool one_by_one(Contrast contrast);

/// Sizes of what is changed. SI.
struct ContrastSizes {
  double payload_kg = 0.0;  // of the loaded half
  double warmer_K = 10.0;
  double later_s = 3600.0;
  double pull_N = 100.0;
};

/// Changes the contexts of `rows` to those of the first or second measurement.
void apply_contrast(Contrast contrast, bool second, const ContrastSizes& sizes, ContextRows& rows);

}  // namespace plumb::offline
