// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/move.hpp"
#include "diagnose/regressor.hpp"
#include "diagnose/regressor_score.hpp"

namespace plumb::offline {

/// The best moments at which something moved: the tool (a bumped reflector) or the base (a bumped
/// tracker), once or several times, or a joint (a slipped encoder), once. Every cut between two
/// poses was tried.
struct ChangePoint {
  EffectEntry entry;               // `step` with after_row of the first move, of, and the joint
  std::vector<double> after_rows;  // of every move, in order
};

/// The best cuts of each kind at the whitened fit; `tried` counts those of a single move. Further
/// moves of the tool or the base are looked for one after another, beside those already found;
/// after each of them every cut is looked for again beside the others. A further move stays if the
/// evidence of all of them together grows by kSupported and by what its place costs: the logarithm
/// of the number of cuts. [Scott & Knott 1974; Bai & Perron 1998]
/// Cost: one pass over the poses in their order for one move, with running sums; some passes more
/// for every further one of a part whose single move has any evidence.
std::vector<ChangePoint> change_points(const WhitenedFit& whitened, int& tried);

/// All moves of a part as one regressor: the columns of `step` for each of them.
Regressor moves_regressor(const WhitenedFit& whitened, const EffectEntry& step,
                          const std::vector<double>& after_rows);

/// The evidence less what the places of the second and of every later move cost.
RegressorScore score_moves(const Scorer& scorer, const Regressor& regressor, std::size_t moves);

/// Several moves with their sizes; nothing if there is one only.
std::vector<Move> sized_moves(const WhitenedFit& whitened, const Regressor& regressor,
                              const Eigen::VectorXd& theta);

/// Puts every move that was found on some of the poses at the best cut of all of them, at most
/// `poses` earlier or later.
void sharpen(const WhitenedFit& whitened, Eigen::Index poses, ChangePoint& point);

}  // namespace plumb::offline
