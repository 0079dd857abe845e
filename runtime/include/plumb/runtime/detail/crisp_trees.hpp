// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "plumb/runtime/detail/tree.hpp"

namespace plumb {
namespace internal {

struct SixJoints;  // one number per joint, in registers

/// A walk down a crisp tree without branches, which a processor could not predict here. A position
/// counts children, eight per node: the high child directly follows the low one and is reached by
/// adding the result of the comparison. Leaf k has the position that node ~k (< 0) would have.
class CrispWalk {
 public:
  CrispWalk() = default;

  /// Starts at the root, or in the only leaf if the tree has no nodes.
  CrispWalk(const format::TreeNode* nodes, int leaves) noexcept
      : nodes_(reinterpret_cast<const std::byte*>(nodes)), at_(leaves > 1 ? 0 : -kStride) {}

  /// One comparison. Precondition: the walk is at a node, not in a leaf.
  void step_down(const double* u) noexcept { at_ = below(at_, u); }

  /// One comparison. In a leaf the walk stands still: it reads the root again and ignores the
  /// result.
  void step(const double* u) noexcept {
    const std::int64_t stays = at_ >> 63;
    const std::int64_t next = below(at_ & ~stays, u);
    at_ = next + ((at_ - next) & stays);
  }

  std::int64_t leaf() const noexcept { return ~(at_ >> kShift); }

  /// The row of the leaf in a table that begins at `begin` and has `width` numbers per leaf. The
  /// position of leaf k is -8 (k + 1), so one multiplication by the width gives the offset in
  /// bytes.
  const double* row(const double* begin, std::int64_t width) const noexcept {
    static_assert(kStride == sizeof(double));
    return reinterpret_cast<const double*>(reinterpret_cast<const std::byte*>(begin) -
                                           at_ * width) -
           width;
  }

 private:
  using Child = std::int16_t;
  static constexpr int kShift = 3;
  static constexpr std::int64_t kStride = 1 << kShift;
  static_assert(sizeof(format::TreeNode) == kStride * sizeof(Child));
  static_assert(offsetof(format::TreeNode, high) ==
                offsetof(format::TreeNode, low) + sizeof(Child));

  template <class Number>
  Number read(std::int64_t at, std::size_t offset) const noexcept {
    Number out;
    std::memcpy(&out, nodes_ + at * std::int64_t{sizeof(Child)} + offset, sizeof out);
    return out;
  }

  /// Position below the node at `at`. !(x <= threshold) is the carry flag of the comparison, and
  /// differs from x > threshold only for NaN.
  std::int64_t below(std::int64_t at, const double* u) const noexcept {
    const double x = u[read<std::uint16_t>(at, offsetof(format::TreeNode, input))];
    const auto threshold = read<double>(at, offsetof(format::TreeNode, threshold));
    at += static_cast<std::int64_t>(!(x <= threshold));
    return kStride * read<Child>(at, offsetof(format::TreeNode, low));
  }

  const std::byte* nodes_ = nullptr;
  std::int64_t at_ = 0;
};

}  // namespace internal

/// Three crisp trees over the same inputs, walked side by side. Within a walk every comparison must
/// wait for the one before, so three walks take little longer than one. Refers to the model's
/// memory.
///
/// Cost: in each tree as many comparisons as the deepest of the three needs, and one leaf.
/// Wait-free; any thread.
class CrispTrees {
 public:
  /// One value per axis, and an arbitrary fourth number.
  using Values = std::array<double, 4>;

  CrispTrees() = default;
  explicit CrispTrees(const std::array<TreeView, format::kTreeAxes>& trees) noexcept;

  /// Evaluates each tree as TreeView::evaluate does [m]. u: inputs normalised by TrainedDomain,
  /// which are never NaN.
  void evaluate(std::span<const double> u, Values& out) const noexcept;

  /// True if the fast path applies: six inputs, affine leaves, no regions.
  bool has_fast_path() const noexcept { return fast_path_; }

  /// The same for trees of the fast path; used inside the library only. looked_up: the numbers of u
  /// in memory, where the walks can index them.
  void evaluate(const internal::SixJoints& u, const double* looked_up, Values& out) const noexcept;

 private:
  using Leaves = std::array<internal::CrispWalk, format::kTreeAxes>;

  Leaves leaves(const double* u) const noexcept;
  void general_path(std::span<const double> u, Values& out) const noexcept;

  std::array<TreeView, format::kTreeAxes> trees_;
  std::array<internal::CrispWalk, format::kTreeAxes> at_root_;
  int sure_depth_ = 0;  // comparisons before the first leaf that any walk can reach
  int more_depth_ = 0;  // further comparisons to the deepest leaf
  bool fast_path_ = false;
};

}  // namespace plumb
