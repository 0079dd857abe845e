// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "plumb/format/coupling.hpp"
#include "plumb/format/limits.hpp"

namespace plumb {

/// The nominal coupling of an arm's joints: what the controller calls the value of a joint is not
/// the angle that the joint turns its link. The angle of joint i is
///   angle_i = value_i + sum_j ratio_ij value_j
/// over its couplings (i, j). A controller that shows J3 = q3 + q2 has the ratio -1 for (J3, J2).
///
/// Chain, ForwardModel and Corrector know angles only, so that an arm with coupling is an ordinary
/// serial arm to them, in the steps of the inverse too. Values are turned into angles where they
/// come in, and angles into values where they go out. Both are linear: differences and derivatives
/// transform in the same way.
///
/// No heap, no state, any thread. Cost: one multiplication a coupling.
class Coupling {
 public:
  Coupling() = default;

  /// Precondition: no two joints depend on each other (put_in_order); what does is left out.
  explicit Coupling(std::span<const format::JointCoupling> couplings) noexcept
      : size_(std::min(couplings.size(), pairs_.size())) {
    std::copy_n(couplings.begin(), size_, pairs_.begin());
    if (!format::put_in_order(std::span(pairs_).first(size_))) size_ = 0;
  }

  bool empty() const noexcept { return size_ == 0; }

  /// In place: q[i] is the controller's value of joint i before, and its angle afterwards. q is any
  /// container of numbers that reaches to the last coupled joint; it is not checked.
  template <class Q>
  void to_angles(Q&& q) const noexcept {
    for (std::size_t k = size_; k-- > 0;) q[pairs_[k].joint] += pairs_[k].ratio * q[pairs_[k].by];
  }

  /// The inverse of to_angles(), in place.
  template <class Q>
  void to_values(Q&& q) const noexcept {
    for (std::size_t k = 0; k < size_; ++k) q[pairs_[k].joint] -= pairs_[k].ratio * q[pairs_[k].by];
  }

 private:
  std::array<format::JointCoupling, format::kMaxCouplings> pairs_{};
  std::size_t size_ = 0;
};

}  // namespace plumb
