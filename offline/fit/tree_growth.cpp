// SPDX-License-Identifier: Apache-2.0
#include "fit/tree_growth.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "fit/tree_rows.hpp"
#include "fit/tree_scan.hpp"

namespace plumb::offline {
namespace {

constexpr double kRounding = 1e-12;  // of the largest |y|: residuals below it are arithmetic

/// Row lists sorted by every column, each cell a range of them [Breiman 1984, presorting].
class SortedLists {
 public:
  explicit SortedLists(const TrainingRows& rows) : low_(rows.rows), spare_(rows.rows) {
    lists_.resize(rows.stride - 1, std::vector<int>(rows.rows));
    for (int c = 0; c < rows.stride - 1; ++c) {
      std::iota(lists_[c].begin(), lists_[c].end(), 0);
      std::stable_sort(lists_[c].begin(), lists_[c].end(),
                       [&](int a, int b) { return rows.value(a, c) < rows.value(b, c); });
    }
  }

  std::vector<std::span<const int>> range(int begin, int end) const {
    std::vector<std::span<const int>> out;
    for (const auto& list : lists_) out.emplace_back(&list[begin], end - begin);
    return out;
  }

  /// Splits every list of the range in place, keeping the order; returns where high begins.
  int partition(int begin, int end, const TrainingRows& rows, const SplitCandidate& at) {
    for (int i = begin; i < end; ++i)
      low_[lists_[0][i]] = rows.value(lists_[0][i], at.column) <= at.threshold;
    int middle = begin;
    for (auto& list : lists_) {
      middle = begin;
      int high = 0;
      for (int i = begin; i < end; ++i) (low_[list[i]] ? list[middle++] : spare_[high++]) = list[i];
      std::copy_n(spare_.begin(), high, list.begin() + middle);
    }
    return middle;
  }

 private:
  std::vector<std::vector<int>> lists_;
  std::vector<char> low_;
  std::vector<int> spare_;
};

class Grower {
 public:
  Grower(const TrainingRows& rows, const GrowthLimits& limits, GrownTree& tree)
      : rows_(rows), lists_(rows), limits_(limits), tree_(tree) {
    for (int row = 0; row < rows.rows; ++row)
      y_max_ = std::max(y_max_, std::abs(rows.value(row, rows.stride - 1)));
  }

  void run() {
    add_cell(0, rows_.rows, 0);
    while (!waiting_.empty() && tree_.leaves() < limits_.max_leaves) {
      const int cell = waiting_.top().cell;
      waiting_.pop();
      split(cell);
    }
  }

 private:
  struct Range {
    int begin, end;
    SplitCandidate candidate;
  };

  struct Waiting {
    double gain;
    int cell;
    bool operator<(const Waiting& other) const {
      return gain != other.gain ? gain < other.gain : cell > other.cell;
    }
  };

  void add_cell(int begin, int end, int depth) {
    const auto sorted = lists_.range(begin, end);
    const LocalModel model = fit_cell_model(rows_, sorted[0]);
    const int cell = static_cast<int>(tree_.cells.size());
    tree_.cells.push_back({.model = model, .depth = depth});
    ranges_.push_back({begin, end, {}});
    const double noise = kRounding * y_max_;
    if (depth == format::kMaxTreeDepth || model.rss <= noise * noise * model.samples) return;
    const SplitCandidate best = best_split(rows_, sorted, limits_.min_samples);
    const double gain = model.rss - best.rss;
    if (best.column >= 0 && gain > 0.0) {
      ranges_[cell].candidate = best;
      waiting_.push({gain, cell});
    }
  }

  void split(int cell) {
    const Range range = ranges_[cell];
    const int middle = lists_.partition(range.begin, range.end, rows_, range.candidate);
    const int depth = tree_.cells[cell].depth + 1;
    TreeCell& parent = tree_.cells[cell];
    parent.split_at = tree_.leaves();
    parent.input = rows_.inputs[range.candidate.column];
    parent.threshold = range.candidate.threshold;
    parent.low = static_cast<int>(tree_.cells.size());
    parent.high = parent.low + 1;
    tree_.split_order.push_back(cell);
    add_cell(range.begin, middle, depth);
    add_cell(middle, range.end, depth);
  }

  const TrainingRows& rows_;
  SortedLists lists_;
  GrowthLimits limits_;
  GrownTree& tree_;
  std::vector<Range> ranges_;
  std::priority_queue<Waiting> waiting_;
  double y_max_ = 0.0;
};

}  // namespace

GrownTree grow(const Samples& u, const Eigen::VectorXd& y, const GrowthLimits& limits) {
  GrownTree tree;
  tree.inputs = static_cast<int>(u.cols());
  GrowthLimits used = limits;
  if (used.min_samples == 0) used.min_samples = 3 * (tree.inputs + 1);
  used.max_leaves = std::min(used.max_leaves, format::kMaxTreeLeaves);
  if (y.size() < used.min_samples || used.max_leaves < 1) return tree;
  const TrainingRows rows = training_rows(u, y);
  if (!rows.inputs.empty()) Grower(rows, used, tree).run();
  return tree;
}

}  // namespace plumb::offline
