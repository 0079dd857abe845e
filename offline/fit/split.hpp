// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Which poses are fitted and which are held out. Rows refer to the measurements.
///
/// With folds, every used pose is fitted in all folds but its own and held out in that one; the
/// final model then uses them all. Replicates of a pose are never split.
struct Split {
  int folds = 0;            // 0: one held-out set
  std::vector<int> fold;    // per row: its fold (0 …), or -1 if it is in none
  std::vector<bool> held;   // per row: held out from the final model
  std::vector<bool> used;   // per row: false = `set` says ignore, or it repeats a held-out pose
  int repeats_of_held = 0;  // number of rows not used because they repeat a held-out pose
  bool marked = false;      // column `set` has chosen the held-out rows
};

/// What is never split: repeats of a pose alone, or also the rows of one placement of an artefact
/// (cell/artefacts.hpp), if there are at least four placements. Held out with all its rows, a
/// point says how well the arm goes to a place where it was not calibrated.
enum class NeverSplit { kPoses, kPlacements };

/// With "auto", the rows that the files mark as held are held out. Without such marks, up to 500
/// different poses are split into five folds; of more, a fifth is held out. Where all rows touch
/// fixed points there are up to ten folds of placements.
///
/// The choice is stratified in joint space: neighbours in k-d order form a stratum, and the same
/// share of each stratum is held out. Deterministic in the seed. Throws Failure (kInput) if the
/// rule cannot be met.
Split split_poses(const Measurements& measurements, const HeldOutRule& rule, std::uint64_t seed,
                  NeverSplit together = NeverSplit::kPlacements);

/// Group of each row by what is never split: errors within one group are alike.
std::vector<int> held_together(const Measurements& measurements);

std::vector<int> fit_rows(const Split& split);            // of the final model
std::vector<int> fit_rows(const Split& split, int fold);  // of one fold
std::vector<int> held_rows(const Split& split, int fold);
std::vector<int> held_rows(const Split& split);  // every row that has a held-out error

/// Rows of about `most` different poses, chosen evenly in joint space and over the set-ups, with
/// about twice as many readings at most: of a pose with many repeats only some are chosen. All rows
/// are returned if neither number is exceeded. A set-up of few poses keeps all of its poses. The
/// result ascends, as `rows` must; it is deterministic in the seed.
std::vector<int> even_choice(const Measurements& measurements, const std::vector<int>& rows,
                             int most, std::uint64_t seed);

}  // namespace plumb::offline
