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
  std::vector<int> fold;    // per row: its fold (0 …), or -1 = always fitted
  std::vector<bool> held;   // per row: held out from the final model
  std::vector<bool> used;   // per row: false = `set` says ignore, or it repeats a held-out pose
  int repeats_of_held = 0;  // so many rows that would have been fitted
  bool marked = false;      // the marks of column `set` chose the held-out rows
};

/// With "auto", rows that the files mark as held are the held-out set; without such marks the
/// program makes five folds of up to 500 different poses, and holds out a fifth of more.
///
/// Stratified in joint space: neighbours along a k-d order share a stratum, and each stratum gives
/// its share. Deterministic in the seed. Throws Failure (kInput) if the rule cannot be met.
Split split_poses(const Measurements& measurements, const HeldOutRule& rule, std::uint64_t seed);

std::vector<int> fit_rows(const Split& split);            // of the final model
std::vector<int> fit_rows(const Split& split, int fold);  // of one fold
std::vector<int> held_rows(const Split& split, int fold);
std::vector<int> held_rows(const Split& split);  // every row that has a held-out error

/// An even choice of the rows, in joint space and over the set-ups: of `most` different poses, and
/// about twice as many readings at most, so that a pose that was read very often is there less
/// often. All rows where there are not more of either. A set-up of few poses keeps all of them.
/// Ascending, as `rows` are; deterministic in the seed.
std::vector<int> even_choice(const Measurements& measurements, const std::vector<int>& rows,
                             int most, std::uint64_t seed);

}  // namespace plumb::offline
