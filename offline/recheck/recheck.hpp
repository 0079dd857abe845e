// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "recheck/search.hpp"
#include "recheck/turned.hpp"
#include "recheck/visible.hpp"

namespace plumb::offline::recheck {

/// Parts of the measurement that were replaced on purpose: they are fitted anew and do not count as
/// a change of the arm.
struct Assumed {
  bool new_frame = false;   // the tracker stands elsewhere
  bool new_target = false;  // another reflector, or another place of it on the tool
};

/// Something that explains the readings nearly as well as what was found in its place.
struct Alternative {
  Change change;
  double behind_nats = 0.0;
  bool matters = false;  // the two move the measured point differently over the arm's poses
};

/// A change that was found.
struct FoundChange {
  Change change;
  double ln_bayes = 0.0;  // for it over its absence, the other changes being there
  std::vector<Estimate> before = {}, after = {};  // its numbers
  double motion_m = 0.0;  // RMS motion of the measured point over the poses of the calibration
  std::vector<Alternative> alternatives = {};  // at most 10 nats behind it
};

/// Whether another explanation is not ruled out and differs from this one.
bool undecided(const FoundChange& found);

struct Recheck {
  enum class Verdict { kTrue, kChanged, kUndecidable } verdict = Verdict::kUndecidable;
  std::vector<FoundChange> found;  // the strongest first; single readings are not among them
  std::vector<int> odd_readings;   // rows that contradict all others and were not used
  bool something_else = false;     // the readings are missed by more than the changes explain
  TurnCheck turns;                 // of orientations, where they are fitted and measured again
  int elsewhere = 0;               // readings at poses where the calibration had none nearby
  bool only_elsewhere = false;     // what they miss may be what the model has always missed there
  double excess = 1.0;             // RMS of what is left, over the RMS that is expected
  std::vector<Visibility> blind;   // what these poses would not have shown within `limit_m`
  double limit_m = 0.0;
  int readings = 0, poses = 0;  // readings that were used, and different poses among them
  ErrorStats then;              // held-out error of the run that is rechecked
  ErrorStats before;            // its error at the readings; frame and target as assumed
  ErrorStats after;             // each reading predicted by a refit without it
  ErrorStats fitted;            // of the readings by the refit itself: never accuracy
  double expected_m = 0.0;      // mean error that the run promises at these readings
  double control_m = 0.0;       // three standard deviations of that mean above it
  Rows3 predicted_M;            // of the readings, each by a refit without it [m]
  bool keeps = true;            // a run is worth keeping: the verdict or one of `found` is decided
  Calibration calibration;      // of the run, with what has changed refitted
};

/// Rows of a file of `size` readings that are judged: all, or of many kMostReadings, evenly spread.
std::vector<int> judged_rows(int size);

/// "true", "changed", "undecidable"
const char* name_of(Recheck::Verdict verdict);

/// Judges few readings of an arm against a run: is it still true, and if not, which part has
/// changed? Only that part is refitted. The numbers of the run enter with their covariance.
///
/// @param calibrated  The calibration that `run` goes back to, which may be `run` itself.
/// @param own         The cell's measurements, on the base of the run.
/// @param rows        The new readings, with contexts; at most kMostReadings.
/// Throws Failure (kInput, E-RECHECK-RUN) if the numbers of the run are not known any more.
/// Cost: some 40 judgements a change found (Judge::judge), 0.1 s for 12 readings.
Recheck recheck_run(const Cell& cell, const Run& calibrated, const Run& run,
                    const Measurements& own, Measurements rows, const Assumed& assumed);

}  // namespace plumb::offline::recheck
