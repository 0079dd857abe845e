// SPDX-License-Identifier: Apache-2.0
#include "tree/growth.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "tree/rows.hpp"
#include "tree/scan.hpp"
#include "tree/walls.hpp"

namespace plumb::offline {
namespace {

constexpr double kRounding = 1e-12;  // share of the largest |y|; smaller residuals are rounding

/// Lists of the rows, one sorted by each column. A cell is a range of all of them [Breiman 1984,
/// presorting].
class SortedLists {
 public:
  explicit SortedLists(const TrainingRows& rows) : low_(rows.rows), spare_(rows.rows) {
    lists_.resize(rows.inputs, std::vector<int>(rows.rows));
    for (int c = 0; c < rows.inputs; ++c) {
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
  Grower(const TrainingRows& rows, const GrowthSettings& settings, GrownTree& tree)
      : rows_(rows), lists_(rows), settings_(settings), tree_(tree) {
    for (int row = 0; row < rows.rows; ++row)
      for (int k = rows.term_count(); k < rows.stride; ++k)
        y_max_ = std::max(y_max_, std::abs(rows.value(row, k)));
  }

  void run() {
    add_cell(0, rows_.rows, 0, {});
    while (!waiting_.empty() && tree_.leaves() < settings_.max_leaves) {
      const int cell = waiting_.top().cell;
      waiting_.pop();
      split(cell);
    }
  }

 private:
  struct Range {
    int begin, end;
    Walls walls;
    SplitCandidate candidate;
  };

  struct Waiting {
    double gain;
    int cell;
    bool operator<(const Waiting& other) const {
      return gain != other.gain ? gain < other.gain : cell > other.cell;
    }
  };

  std::vector<Admissible> admissible(const Walls& walls) const {
    std::vector<Admissible> out(rows_.inputs);
    for (int c = 0; c < rows_.inputs && settings_.min_side > 0.0; ++c) {
      const double low = walls.low[c], kept = settings_.min_side * (walls.high[c] - low);
      out[c] = {low + kept, std::max(low + kept, walls.high[c] - kept)};
    }
    return out;
  }

  void add_cell(int begin, int end, int depth, const Walls& walls) {
    const auto sorted = lists_.range(begin, end);
    const int cell = static_cast<int>(tree_.cells.size());
    const int terms = static_cast<int>(format::leaf_terms(tree_.inputs, tree_.degree));
    tree_.cells.push_back({.model = fit_cell_model(rows_, sorted[0], terms), .depth = depth});
    ranges_.push_back({begin, end, walls, {}});
    const double noise = kRounding * y_max_, rss = tree_.cells[cell].model.rss;
    if (depth >= settings_.max_depth || rss <= noise * noise * (end - begin)) return;
    const SplitCandidate best = best_split(rows_, sorted, admissible(walls), settings_.min_samples);
    const double gain = rss - best.rss;
    if (best.found() && gain > 0.0) {
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
    parent.input = rows_.terms[range.candidate.column] - 1;
    parent.threshold = range.candidate.threshold;
    parent.low = static_cast<int>(tree_.cells.size());
    parent.high = parent.low + 1;
    tree_.split_order.push_back(cell);
    Walls low = range.walls, high = range.walls;
    const SplitCandidate& at = range.candidate;
    low.high[at.column] = high.low[at.column] = at.threshold;
    add_cell(range.begin, middle, depth, low);
    add_cell(middle, range.end, depth, high);
  }

  const TrainingRows& rows_;
  SortedLists lists_;
  GrowthSettings settings_;
  GrownTree& tree_;
  std::vector<Range> ranges_;
  std::priority_queue<Waiting> waiting_;
  double y_max_ = 0.0;
};

}  // namespace

GrownTree grow(const Samples& u, const Samples& y, const GrowthSettings& settings) {
  GrownTree tree;
  tree.inputs = static_cast<int>(u.cols());
  tree.degree = settings.degree;
  tree.outputs = static_cast<int>(y.cols());
  GrowthSettings used = settings;
  if (used.min_samples == 0)
    used.min_samples = 3 * static_cast<int>(format::leaf_terms(u.cols(), settings.degree));
  used.max_leaves = std::min(used.max_leaves, format::kMaxTreeLeaves);
  if (y.rows() < used.min_samples || used.max_leaves < 1) return tree;
  const TrainingRows rows = training_rows(u, y, settings.degree);
  if (rows.inputs > 0) Grower(rows, used, tree).run();
  return tree;
}

}  // namespace plumb::offline
