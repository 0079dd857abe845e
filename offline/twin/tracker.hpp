// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "program/json.hpp"
#include "program/verdict.hpp"
#include "twin/controller.hpp"
#include "twin/twin_file.hpp"

namespace plumb::offline::twin {

/// Errors of the tool centre point in the base frame [m]: distances in three dimensions.
struct ErrorFigures {
  int n = 0;
  double mean_m = 0.0, rms_m = 0.0, p95_m = 0.0, max_m = 0.0;
};
ErrorFigures figures_of(std::vector<double> errors_m);

/// The errors of the true arm at the stops of a path: the true ones, which only the simulation
/// knows, and those that the tracker measured. A path that was not driven to its end has fewer
/// stops than stations.
struct TrueErrors {
  ErrorFigures truth;
  ErrorFigures measured;       // including the noise of the tracker
  std::vector<double> each_m;  // true, in the order of the stops
};

/// Throws Failure (kInput) if the cell does not state where tracker and reflector are, because then
/// there is no frame in which the error could be stated.
TrueErrors true_errors(const Cell& cell, const Hidden& hidden, const HiddenTruth& truth,
                       int stations, const std::vector<Stop>& stops);

/// The error that noise alone would show: mean sigma sqrt(8/pi), RMS sigma sqrt(3).
struct NoiseFloor {
  double mean_m = 0.0, rms_m = 0.0;
};
NoiseFloor floor_of(double sigma_m);

/// The chain of the true arm, without its effects.
format::Chain true_chain(const Cell& cell, const HiddenTruth& truth);

/// A path driven without corrections and with them. Either may be missing (n = 0).
struct Comparison {
  TrueErrors off, on;
  NoiseFloor floor;
  int unsettled = 0;  // stops at which the correction still moved

  double ratio() const;  // ratio of the mean true errors
  /// True if the correction makes the arm at least five times better and the measured error is
  /// below 1.3 times the noise.
  bool reached() const;
};
inline constexpr double kLeastRatio = 5.0;
inline constexpr double kMostOverFloor = 1.3;

Json to_json(const Comparison& comparison);
Verdict verdict(const Comparison& comparison);
std::string to_text(const Comparison& comparison);  // begins with the verdict

}  // namespace plumb::offline::twin
