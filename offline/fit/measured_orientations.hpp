// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// What the measured orientations are, judged by the arm that is fitted to the points alone.
/// Orientation columns are misread more often than those of points, and wrong orientations distort
/// the whole fit.
struct MeasuredOrientations {
  enum class Kind {
    kNone,         // the files hold none
    kUnjudged,     // the points alone do not determine the arm: orientations are used as stated
    kGood,         // they scatter as stated; if no error is stated, they are meant as labelled
    kScattered,    // they scatter by more than is stated
    kMissed,       // repeats agree as stated, but the residuals of the fitted arm are larger
    kOtherwise,    // another interpretation of the columns than that of the labels fits
    kTurned,       // right except for a constant rotation before or after them
    kConstant,     // the same in all rows: none was measured
    kNominal,      // those of the nominal arm: computed, not measured
    kContradict,   // a fit of both misses the points by far more
    kUnexplained,  // no known interpretation of the columns fits the arm
  };
  Kind kind = Kind::kNone;
  std::vector<int> interpretations;  // kOtherwise: indices of the simplest ones that fit
  double labelled_rad = 0.0;         // usual error per axis, as labelled
  double left_rad = 0.0;             // the same with the best interpretation, frame, or weight
  bool stated = false;               // the cell says how large their error is
  std::optional<double> times;       // their scatter over the stated error, if it is clearly larger

  /// Whether a fit uses them.
  bool fit_to_use() const;
};

/// One interpretation of the orientation columns, applied to the rows that are judged.
struct OrientationInterpretation {
  Rows4 quat_M;
  double changes = 1.0;  // how many changes of the labels it needs, weighted by their rarity
};

/// Rows that are not ignored, thinned to as many as a judgement needs.
std::vector<int> rows_to_judge(const Measurements& measured);

/// Judges all rows of `measured`; `others` are interpretations that differ from the labels. Cost:
/// one fit of the points, and a few fits of both if the orientations are not as stated.
MeasuredOrientations judge_orientations(const Cell& cell, const Measurements& measured,
                                        const std::vector<OrientationInterpretation>& others);

/// The same for `rows_to_judge`, read as labelled.
MeasuredOrientations judge_orientations(const Cell& cell, const Measurements& measured);

/// The cell with the sigma of orientations that follows: as stated, larger, or none.
Cell with_orientations_as_judged(const Cell& cell, const MeasuredOrientations& judged);

/// Judges the orientations and returns the cell with the sigma that follows.
Cell as_judged(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
