// SPDX-License-Identifier: Apache-2.0
#include "tree/folds.hpp"

#include <map>
#include <numeric>
#include <set>

#include "cell/random.hpp"
#include "tree/rows.hpp"

namespace plumb::offline {
namespace {

/// Deals folds in rounds, with a new permutation of the folds in every round.
class Dealer {
 public:
  Dealer(int folds, std::uint64_t seed) : random_(seed), hand_(folds) {
    std::iota(hand_.begin(), hand_.end(), 0);
  }

  int next() {
    const int folds = static_cast<int>(hand_.size());
    if (dealt_ % folds == 0)
      for (int k = folds - 1; k > 0; --k) std::swap(hand_[k], hand_[random_.below(k + 1)]);
    return hand_[dealt_++ % folds];
  }

 private:
  Random random_;
  std::vector<int> hand_;
  int dealt_ = 0;
};

}  // namespace

std::vector<int> deal_folds(const Samples& q, const Samples& residual, std::span<const int> group,
                            int folds, std::uint64_t seed) {
  Samples table(q.rows(), q.cols() + residual.cols());
  table << q, residual;
  Dealer dealer(folds, seed);
  std::map<int, int> fold_of_group;
  std::vector<int> out(group.size());
  for (int row : lexicographic(table)) {
    const auto known = fold_of_group.find(group[row]);
    out[row] = known != fold_of_group.end()
                   ? known->second
                   : fold_of_group.emplace(group[row], dealer.next()).first->second;
  }
  return out;
}

int count_groups(std::span<const int> group) {
  return static_cast<int>(std::set<int>(group.begin(), group.end()).size());
}

Samples rows_of(const Samples& all, const std::vector<int>& which) {
  Samples out(which.size(), all.cols());
  for (std::size_t i = 0; i < which.size(); ++i) out.row(i) = all.row(which[i]);
  return out;
}

}  // namespace plumb::offline
