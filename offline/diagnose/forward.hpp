// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/diagnosis.hpp"
#include "diagnose/scan.hpp"

namespace plumb::offline {

/// An effect that was added, and the model with it.
struct ForwardStep {
  EffectEntry entry;
  std::vector<double> cycles;  // of a ripple: all its waves
  double ln_bayes = 0.0;
  std::vector<EffectEntry> effects;  // the whole list
  Calibration calibration;
};

/// Forward selection from one fitted model: the best supported effect is added, all is refitted
/// jointly, what lost its evidence is dropped, until nothing more is supported.
struct Forward {
  std::vector<ForwardStep> steps;
  bool full = false;  // more is supported, but a model holds no more effects
  std::optional<UnknownStructure>
      unknown;                      // left at the end, or what an oversized effect stands for
  std::vector<Oversized> unlikely;  // of the steps: large, but nothing else explains as much
};

/// What a selection works on; the cell's own effects are the start.
struct ForwardStart {
  const Cell& cell;
  const Measurements& measured;
  std::vector<int> fit;  // rows
  const std::vector<std::string>& not_testable;
  std::function<void(const std::string&)> tell;  // progress; may be empty
};

/// `first` is the scan of `stage`, the calibration's.
Forward forward(const ForwardStart& start, const Calibration& calibration, Stage stage,
                const Scan& first);

}  // namespace plumb::offline
