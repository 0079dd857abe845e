// SPDX-License-Identifier: Apache-2.0
#include "cell/replicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace plumb::offline {
namespace {

/// Joints of repeats of one pose agree to this [rad] or [m] and, where two files use one name for
/// the pose, to the second number: encoder readings of one commanded pose differ by as much.
constexpr double kSameJoints = 1e-9, kSamePoseElsewhere = 1e-3;

constexpr std::array<double, 9> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23};

class Groups {
 public:
  explicit Groups(int rows) : parent_(rows) { std::iota(parent_.begin(), parent_.end(), 0); }

  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

bool near(const RowsN& q, int a, int b, double tolerance) {
  return q.cols() == 0 || (q.row(a) - q.row(b)).cwiseAbs().maxCoeff() < tolerance;
}

/// Joins row i to the first row of its name in each file; `firsts` holds those of one hash.
void join_to_first(const std::vector<std::string_view>& names, const std::vector<int>& file,
                   const RowsN& q, int i, std::vector<int>& firsts, Groups& groups) {
  bool is_first = true;
  for (const int row : firsts) {
    if (names[row] != names[i]) continue;
    if (file[row] == file[i]) is_first = false;
    if (file[row] == file[i] || near(q, row, i, kSamePoseElsewhere)) groups.join(row, i);
  }
  if (is_first) firsts.push_back(i);
}

// Sorted hashes instead of a hash table: a million rows in a tenth of a second.
void join_by_name(const std::vector<std::string_view>& names, const std::vector<int>& file,
                  const RowsN& q, Groups& groups) {
  std::vector<std::pair<std::size_t, int>> hashes;
  hashes.reserve(names.size());
  for (int i = 0; i < static_cast<int>(names.size()); ++i)
    if (!names[i].empty()) hashes.emplace_back(std::hash<std::string_view>{}(names[i]), i);
  std::sort(hashes.begin(), hashes.end());
  std::vector<int> firsts;
  for (std::size_t k = 0; k < hashes.size(); ++k) {
    if (k > 0 && hashes[k].first != hashes[k - 1].first) firsts.clear();
    join_to_first(names, file, q, hashes[k].second, firsts, groups);
  }
}

// Rows whose joints agree have nearly the same weighted sum of joints: sort by it, look at
// neighbours. Irrational weights keep the sums of different poses on a grid apart.
void join_by_joints(const RowsN& q, Groups& groups) {
  const auto n = static_cast<int>(q.rows());
  std::vector<std::pair<double, int>> sums(n);
  double window = 0.0;
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    const double weight = std::sqrt(kPrimes[k % kPrimes.size()]);
    window += weight * kSameJoints;
    for (int i = 0; i < n; ++i) sums[i].first += weight * q(i, k);
  }
  for (int i = 0; i < n; ++i) sums[i].second = i;
  std::sort(sums.begin(), sums.end());
  window += 1e-12;
  for (int i = 1; i < n; ++i)
    for (int j = i - 1; j >= 0 && sums[i].first - sums[j].first <= window; --j) {
      if (!near(q, sums[i].second, sums[j].second, kSameJoints)) continue;
      groups.join(sums[i].second, sums[j].second);
      break;
    }
}

}  // namespace

std::vector<int> replicate_groups(const std::vector<std::string_view>& names,
                                  const std::vector<int>& file, const RowsN& q) {
  const auto n = static_cast<int>(q.rows());
  Groups groups(n);
  join_by_name(names, file, q, groups);
  join_by_joints(q, groups);
  std::vector<int> number(n, -1), out(n);
  int next = 0;
  for (int i = 0; i < n; ++i) {
    int& group = number[groups.root(i)];
    if (group < 0) group = next++;
    out[i] = group;
  }
  return out;
}

std::vector<int> pose_groups(const Measurements& measured) {
  if (measured.setup.empty()) return measured.replicate_group;
  return replicate_groups({measured.pose.begin(), measured.pose.end()}, measured.replicate_group,
                          measured.q);
}

}  // namespace plumb::offline
