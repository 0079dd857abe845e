// SPDX-License-Identifier: Apache-2.0
#include "recheck/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "numbers/gaussian.hpp"
#include "recheck/constants.hpp"

namespace plumb::offline::recheck {
namespace {

const double kFound = -std::log(kFalseAlarm);  // least gain of ln evidence [nats]

bool is_reading(const Change& change) { return change.part == Part::kReading; }

std::vector<Change> with(std::vector<Change> all, const Change& more) {
  all.push_back(more);
  return all;
}

std::vector<Change> without(std::vector<Change> all, std::size_t k) {
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(k));
  return all;
}

bool is_among(const std::vector<std::vector<Change>>& all, const std::vector<Change>& changes) {
  return std::any_of(all.begin(), all.end(), [&](const std::vector<Change>& one) {
    return std::equal(one.begin(), one.end(), changes.begin(), changes.end(), same);
  });
}

}  // namespace

Search::Search(const Judge& judge, const Readings& readings, std::vector<Change> possible,
               std::vector<Change> assumed)
    : judge_(judge),
      possible_(std::move(possible)),
      found_(std::move(assumed)),
      assumed_(found_.size()) {
  // With three poses no single reading can be identified as wrong.
  if (readings.poses < kFewestForOddOnes) return;
  for (int i = 0; i < readings.rows.size(); ++i)
    possible_.push_back(odd_reading(i, readings.rows.size(), readings.sigma_m()));
  most_odd_ = std::clamp(static_cast<int>(kOddShare * readings.rows.size()), 1, kMostOdd);
}

void Search::run() {
  last_ = nothing_ = judge_.judge(found_);
  // Each round depends on the set of changes alone, so a set that was there before would repeat for
  // ever.
  std::vector<std::vector<Change>> before;
  while (changes() < kMostChanges && !is_among(before, found_)) {
    before.push_back(found_);
    if (!add_best()) return;
    exchange();
    drop_needless();
  }
}

void Search::replace(std::size_t k, const Change& change) {
  found_[k] = change;
  last_ = judge_.judge(found_);
}

bool Search::holds(const Change& change) const {
  return std::any_of(found_.begin(), found_.end(),
                     [&](const Change& other) { return same(other, change); });
}

int Search::changes() const {
  return static_cast<int>(std::count_if(found_.begin() + static_cast<std::ptrdiff_t>(assumed_),
                                        found_.end(),
                                        [](const Change& change) { return !is_reading(change); }));
}

bool Search::may_be_odd() const {
  return std::count_if(found_.begin(), found_.end(), is_reading) < most_odd_;
}

bool Search::add_best() {
  std::vector<double> ln;
  std::optional<Judged> best;
  const Change* which = nullptr;
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& change : possible_) {
    if (holds(change) || (is_reading(change) && !may_be_odd())) continue;
    const std::vector<Change> changes = with(found_, change);
    Judged judged = judge_.judge(changes);
    if (!sizes_plausible(changes, found_.size(), judged)) continue;
    ln.push_back(judged.ln_evidence - last_.ln_evidence + std::log(change.chance));
    if (ln.back() <= most) continue;
    most = ln.back();
    best = std::move(judged);
    which = &change;
  }
  if (which == nullptr || ln_sum(ln) < kFound) return false;
  found_.push_back(*which);
  last_ = std::move(*best);
  return true;
}

/// Replaces each change by another one that explains the readings better beside the rest: a change
/// that was found first may only have imitated the true one.
void Search::exchange() {
  for (std::size_t k = assumed_; k < found_.size(); ++k)
    for (const auto& change : possible_) {
      const bool one_odd_more = is_reading(change) && !is_reading(found_[k]);
      if (holds(change) || (one_odd_more && !may_be_odd())) continue;
      std::vector<Change> other = found_;
      other[k] = change;
      Judged judged = judge_.judge(other);
      if (!sizes_plausible(other, k, judged) || judged.ln_evidence + std::log(change.chance) <=
                                                    last_.ln_evidence + std::log(found_[k].chance))
        continue;
      found_ = std::move(other);
      last_ = std::move(judged);
    }
}

void Search::drop_needless() {
  for (std::size_t k = found_.size(); k-- > assumed_;) {
    if (found_.size() - assumed_ < 2) return;
    Judged judged = judge_.judge(without(found_, k));
    if (last_.ln_evidence - judged.ln_evidence + std::log(found_[k].chance) >= kFound) continue;
    found_ = without(found_, k);
    last_ = std::move(judged);
  }
}

}  // namespace plumb::offline::recheck
