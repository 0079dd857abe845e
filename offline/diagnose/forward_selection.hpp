// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "diagnose/forward_start.hpp"
#include "diagnose/scan.hpp"

namespace plumb::offline {

/// An effect that was added, and the model with it.
struct ForwardStep {
  EffectEntry entry;
  std::vector<double> cycles;  // of a ripple: all its waves
  std::string peaks;           // of a series of waves: its largest ones in words
  std::vector<Move> moves;     // of a part that moved several times
  std::string sizes;           // of a series of all joints: the error of each in words
  double ln_bayes = 0.0;
  std::vector<Alternative> alternatives;  // what it may be instead
  std::vector<EffectEntry> effects;       // the whole list
  Calibration calibration;
};

/// Forward selection from one fitted model: the best supported effect is added, all is refitted
/// jointly, what lost its evidence is dropped, until nothing more is supported. What stays
/// undecided is no step; others are, that were found beside it.
struct ForwardSelection {
  std::vector<ForwardStep> steps;
  bool full = false;  // more is supported, but a model holds no more effects
  std::optional<UnknownStructure>
      unknown;                         // left at the end, or what an oversized effect stands for
  std::optional<Undecided> undecided;  // supported at the end, and not added for that reason
  /// The same before others were found beside it, and after how many steps that was.
  struct AtFirst {
    Undecided undecided;
    std::size_t steps = 0;
  };
  std::optional<AtFirst> at_first;
  std::vector<Oversized> unlikely;      // of the steps: large, but nothing else explains as much
  std::vector<std::string> not_judged;  // models that could not be refitted, in words
};

/// `first` is the scan of `whitened`, the calibration's.
ForwardSelection forward_selection(const ForwardStart& start, const Calibration& calibration,
                                   WhitenedFit whitened, const Scan& first);

}  // namespace plumb::offline
