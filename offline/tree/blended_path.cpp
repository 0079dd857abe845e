// SPDX-License-Identifier: Apache-2.0
#include "tree/blended_path.hpp"

#include <algorithm>
#include <numeric>

#include "plumb/runtime/detail/tree.hpp"
#include "tree/active_bound.hpp"
#include "tree/blend.hpp"

namespace plumb::offline {
namespace {

constexpr double kNarrower = 0.7;      // factor on the ramps until few enough leaves are active
constexpr double kLeastOverlap = 0.1;  // smallest overlap; less is nearly crisp
constexpr int kStepShare = 3;          // one leaf in three is split in each step
constexpr double kBeyondSeen = 0.25;   // share of the width of the samples of a leaf
constexpr double kAlmostAll = 1e-6;

}  // namespace

std::optional<format::Tree> with_ramps(format::Tree tree, const Samples& u, double overlap) {
  const int inputs = static_cast<int>(u.cols());
  while (overlap > kLeastOverlap) {
    add_ramps(tree, overlap);
    if (tree.leaves() <= format::kMaxActiveLeaves) return tree;
    if (most_active_leaves(tree, inputs) <= format::kMaxActiveLeaves) return tree;
    overlap *= kNarrower;
  }
  return std::nullopt;
}

BlendedPath::BlendedPath(const Samples& u, const Samples& y, const BlendSettings& settings)
    : u_(u), y_(y), settings_(settings) {
  GrowthSettings growth = settings.growth;
  growth.max_leaves = std::min(3 * growth.max_leaves, format::kMaxTreeLeaves);
  grown_ = grow(u, y, growth);
  if (grown_.leaves() == 0) return;
  stand_ = grown_.first_splits(1);
  make_fit();
}

/// Fits the tree of the present splits. Returns false if its ramps would make too many leaves
/// active at one point.
bool BlendedPath::make_fit() {
  const auto tree = with_ramps(grown_.cut(stand_), u_, settings_.overlap);
  if (!tree) return false;
  cells_ = grown_.leaf_cells(stand_);
  leaves_ = static_cast<int>(cells_.size());
  fit_ = std::make_unique<BlendedFit>(*tree, u_);
  return true;
}

std::vector<double> BlendedPath::losses() const {
  const auto trees = solve(settings_.path_ridge);
  std::vector<double> out(leaves_, 0.0);
  std::vector<TreeView> views;
  for (const auto& tree : trees) views.emplace_back(tree, static_cast<int>(u_.cols()));
  ActiveLeaves<double> active;
  for (Eigen::Index i = 0; i < u_.rows(); ++i) {
    const SampleRow row(u_, i);
    views[0].active(row.span(), active);
    double squared = 0.0;
    for (std::size_t k = 0; k < views.size(); ++k) {
      const double e = y_(i, static_cast<Eigen::Index>(k)) - views[k].evaluate(row.span(), active);
      squared += e * e;
    }
    for (int k = 0; k < active.count; ++k) out[active.leaf[k]] += active.weight[k] * squared;
  }
  return out;
}

bool BlendedPath::grow_to(int leaves) {
  while (leaves_ > 0 && leaves_ < leaves) {
    std::vector<int> order;
    for (int k = 0; k < leaves_; ++k)
      if (grown_.cells[cells_[k]].is_split()) order.push_back(k);
    if (order.empty()) return false;
    const auto loss = losses();
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return loss[a] > loss[b]; });
    const int step = std::min(std::max(1, leaves_ / kStepShare), leaves - leaves_);
    order.resize(std::min<std::size_t>(order.size(), step));
    const Splits before = stand_;
    for (int k : order) stand_[cells_[k]] = 1;
    if (make_fit()) continue;
    stand_ = before;
    return false;
  }
  return leaves_ > 0;
}

std::vector<format::Tree> BlendedPath::solve(double ridge) const { return fit_->solve(y_, ridge); }

void add_regions(format::Tree& tree, const Samples& u) {
  const auto p = static_cast<std::size_t>(u.cols());
  const TreeView view(tree, static_cast<int>(p));
  std::vector<double> low(tree.leaves() * p, 2.0), high(tree.leaves() * p, -2.0);
  ActiveLeaves<double> active;
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const SampleRow row(u, i);
    view.active(row.span(), active);
    for (int k = 0; k < active.count; ++k)
      for (std::size_t j = 0; j < p; ++j) {
        const std::size_t at = active.leaf[k] * p + j;
        low[at] = std::min(low[at], row.span()[j]);
        high[at] = std::max(high[at], row.span()[j]);
      }
  }
  bool all_seen = true;
  std::vector<float> region;
  for (std::size_t at = 0; at < low.size(); ++at) {
    const double beyond = std::max(kBeyondSeen * (high[at] - low[at]), kRegionFade);
    const double from = low[at] - beyond, to = high[at] + beyond;
    all_seen = all_seen && from <= -1.0 + kAlmostAll && to >= 1.0 - kAlmostAll;
    region.push_back(static_cast<float>(std::max(from, -1.5)));
    region.push_back(static_cast<float>(std::min(to, 1.5)));
  }
  tree.region.clear();
  if (!all_seen) tree.region = std::move(region);
}

}  // namespace plumb::offline
