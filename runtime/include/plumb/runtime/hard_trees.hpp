// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "plumb/runtime/tree.hpp"

namespace plumb {
namespace internal {

/// A walk down a crisp tree. Nothing is chosen, as compilers make branches of choices, and these
/// cannot be foreseen: a place counts children, eight a node, so that the high child stands one
/// behind the low one and is reached by an addition. Leaf k is the place of node ~k, which is none.
class HardWalk {
 public:
  HardWalk() = default;

  /// At the root, or in the leaf that is the whole tree.
  HardWalk(const format::TreeNode* nodes, int leaves) noexcept
      : nodes_(reinterpret_cast<const std::byte*>(nodes)), at_(leaves > 1 ? 0 : -kStride) {}

  /// One compare, where there is no leaf yet.
  void step_down(const double* u) noexcept { at_ = below(at_, u); }

  /// One compare. In a leaf the walk stands still: the root is read again and its answer dropped.
  void step(const double* u) noexcept {
    const std::int64_t stays = at_ >> 63;
    const std::int64_t next = below(at_ & ~stays, u);
    at_ = next + ((at_ - next) & stays);
  }

  std::int64_t leaf() const noexcept { return ~(at_ >> kShift); }

  /// Where the leaf's row is, `width` numbers a leaf from `begin` on. Of the place, which is minus
  /// eight times the leaf's number and one more, nothing but multiples is needed.
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

  /// "Not at most" is "greater" unless there is NaN, and what a processor's carry says.
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

/// Three hard trees over the same inputs, walked side by side: every compare waits for the one
/// before, so three walks take little longer than one. Refers to the model's memory.
///
/// Cost: of each as many compares as the deepest needs, and one leaf. Wait-free; any thread.
class HardTrees {
 public:
  /// One an axis, and a number that means nothing.
  using Values = std::array<double, 4>;

  HardTrees() = default;
  explicit HardTrees(const std::array<TreeView, format::kTreeAxes>& trees) noexcept;

  /// What each says, as TreeView::evaluate [m]. u: as TrainedDomain normalises, so never NaN.
  void evaluate(std::span<const double> u, Values& out) const noexcept;

  /// Six inputs, leaves that are affine and have no regions.
  bool usual() const noexcept { return usual_; }

  /// The same of such trees, for the library alone. u: also in memory, to look up.
  void evaluate(const internal::SixJoints& u, const double* looked_up, Values& out) const noexcept;

 private:
  using Leaves = std::array<internal::HardWalk, format::kTreeAxes>;

  Leaves leaves(const double* u) const noexcept;
  void unusual(std::span<const double> u, Values& out) const noexcept;

  std::array<TreeView, format::kTreeAxes> trees_;
  std::array<internal::HardWalk, format::kTreeAxes> at_root_;
  int sure_depth_ = 0;  // compares that every walk needs
  int more_depth_ = 0;  // those that the deepest needs besides
  bool usual_ = false;
};

}  // namespace plumb
