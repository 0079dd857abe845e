// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace plumb::offline {

/// The search for the moments at which something moved, one cut at a time. Whoever searches puts
/// the visits (poses with their immediate repeats) in order and says what a cut is worth:
/// noise/change_points by F tests of a segment, diagnose/change_points by the evidence beside a
/// model. The order, the cuts that may be tried, the walk over them, the running sums
/// (noise/running_sums.hpp), the parts that may have moved (noise/moving_part.hpp) and the repeated
/// search of every cut beside the others are the same for both.

/// Sorts items by their keys, for example times; items with equal keys keep their order.
template <class Item, class Key>
void put_in_order(std::vector<Item>& items, const Key& key_of) {
  std::stable_sort(items.begin(), items.end(),
                   [&](const Item& a, const Item& b) { return key_of(a) < key_of(b); });
}

/// Visits [first, last), in order.
struct VisitRun {
  int first, last;
  int size() const { return last - first; }
};

/// Cuts from `first` to `last`, both included. A cut is numbered by the first visit behind it.
struct CutRange {
  int first, last;
  int count() const { return std::max(0, last - first + 1); }
};

/// The cuts of a run that leave at least `fewest` visits on either side.
inline CutRange cuts_of(const VisitRun& run, int fewest) {
  return {run.first + fewest, run.last - fewest};
}

/// Those of `cuts` that are at most `visits` visits away from `cut`.
inline CutRange cuts_near(const CutRange& cuts, int cut, int visits) {
  return {std::max(cuts.first, cut - visits), std::min(cuts.last, cut + visits)};
}

struct BestCut {
  int cut = 0;
  double score = 0.0;
};

/// The cut with the highest score; of equal scores, the last cut. Nothing if no cut was tried.
///
/// Walks from the visit before `end` to the front. `pass(visit)` is called for each visit as it
/// comes to lie behind the cut, so that the caller can keep running sums. `score_of(cut)` returns a
/// std::optional<double>: nothing if the cut is not to be tried.
template <class Pass, class ScoreOf>
std::optional<BestCut> best_cut(int end, const CutRange& cuts, const Pass& pass,
                                const ScoreOf& score_of) {
  std::optional<BestCut> best;
  for (int cut = end - 1; cut >= cuts.first; --cut) {
    pass(cut);
    if (cut > cuts.last) continue;
    const std::optional<double> score = score_of(cut);
    if (score && (!best || *score > best->score)) best = BestCut{cut, *score};
  }
  return best;
}

/// Backfitting: searches every move again beside all the others, since in the first search some of
/// these were not yet known; until a round changes none, and at most so many rounds. `again(move)`
/// searches one, and returns whether it changed.
template <class Move, class Again>
void settle(std::vector<Move>& moves, int rounds, const Again& again) {
  bool changed = true;
  for (int round = 0; round < rounds && changed; ++round) {
    changed = false;
    for (Move& move : moves) changed = again(move) || changed;
  }
}

}  // namespace plumb::offline
