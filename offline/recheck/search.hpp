// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "recheck/evidence.hpp"

namespace plumb::offline::recheck {

/// Finds the changes that explain some readings best, one by one. The best change is added if all
/// possible ones together are 50 times as likely as no further one. Then each found one is
/// exchanged if another explains the readings better in its place, and dropped if it is not needed
/// any more.
class Search {
 public:
  /// Keeps references to `judge` and `readings`. assumed: there from the beginning, and kept.
  Search(const Judge& judge, const Readings& readings, std::vector<Change> possible,
         std::vector<Change> assumed);

  void run();

  /// Puts another change in the place of a found one.
  void replace(std::size_t k, const Change& change);

  const std::vector<Change>& found() const { return found_; }  // assumed ones first
  std::size_t assumed() const { return assumed_; }
  const std::vector<Change>& possible() const { return possible_; }  // single readings, too
  bool holds(const Change& change) const;
  const Judged& last() const { return last_; }        // with what was found
  const Judged& nothing() const { return nothing_; }  // with what was assumed alone

 private:
  int changes() const;
  bool may_be_odd() const;
  bool add_best();
  void exchange();
  void drop_needless();

  const Judge& judge_;
  std::vector<Change> possible_, found_;
  std::size_t assumed_ = 0;
  Judged last_, nothing_;
  int most_odd_ = 0;
};

}  // namespace plumb::offline::recheck
