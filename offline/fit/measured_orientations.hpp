// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// What the measured orientations are, as the arm shows them that the points alone give. They come
/// from columns that mean something else more often than points do, and a wrong one pulls the whole
/// fit aside.
struct MeasuredOrientations {
  enum class Kind {
    kNone,         // the files hold none
    kUnjudged,     // the points alone do not give the arm: the orientations are taken as stated
    kGood,         // they scatter as stated; if nothing is stated, they are meant as labelled
    kScattered,    // they scatter by more than is stated
    kMissed,       // their repeats agree as stated, but the fitted arm misses them by more
    kOtherwise,    // they are meant in another way than labelled
    kTurned,       // right but for a constant turn before or behind them
    kConstant,     // the same in all rows: none was measured
    kNominal,      // those of the nominal arm: computed, not measured
    kContradict,   // with them the arm misses its points
    kUnexplained,  // they fit the arm in no way
  };
  Kind kind = Kind::kNone;
  std::vector<int> readings;    // kOtherwise: the readings that fit, equally simple; rarely several
  double labelled_rad = 0.0;    // usual error per axis, as labelled
  double left_rad = 0.0;        // as they are meant: of the best reading, frame, or weight
  bool stated = false;          // the cell says how large their error is
  std::optional<double> times;  // how many times the stated error they scatter, if by more

  /// False: they are left out of a fit.
  bool fit_to_use() const;
};

/// One way to read the columns, for the rows that are judged.
struct OrientationReading {
  Rows4 quat_M;
  double changes = 1.0;  // how much it asks to be changed
};

/// Rows that are enough to judge by.
std::vector<int> rows_to_judge(const Measurements& measured);

/// Judges all rows of `measured`; `others` are ways to read them that differ from the labels. Cost:
/// a fit of the points, and up to four of both where the orientations are not as stated.
MeasuredOrientations judge_orientations(const Cell& cell, const Measurements& measured,
                                        const std::vector<OrientationReading>& others);

/// The same of all rows that are not ignored, read as labelled.
MeasuredOrientations judge_orientations(const Cell& cell, const Measurements& measured);

/// The cell with the weight of orientations that they deserve: as stated, less, or none.
Cell with_orientations_as_judged(const Cell& cell, const MeasuredOrientations& judged);

/// Both in one, for code that only fits.
Cell as_judged(const Cell& cell, const Measurements& measured);

}  // namespace plumb::offline
