// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace plumb::offline {

/// The search for the moment at which something moved once. The caller puts the visits (poses with
/// their immediate repeats) in order, walks over the cuts between them, and scores each cut.

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

}  // namespace plumb::offline
