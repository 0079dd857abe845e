// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "plumb/format/model.hpp"

namespace plumb {
namespace internal {
struct SixJoints;  // one number per joint, in registers
}

/// The joint domain of the training: normalises the inputs of the trees and weights their output.
class TrainedDomain {
 public:
  TrainedDomain() = default;
  explicit TrainedDomain(const format::Domain& domain) noexcept;

  /// Normalises q to u, u_i in [-1, 1], clamped to the box. Shape (n,) each.
  /// Returns the weight of the trees: 1 inside the box, falling linearly to 0 at `fade` spans
  /// outside it; the joint farthest outside decides.
  double normalise(std::span<const double> q, std::span<double> u) const noexcept;

  /// The same for six joints in registers; used inside the library only.
  double normalise(const internal::SixJoints& q, internal::SixJoints& u) const noexcept;

 private:
  static constexpr std::size_t kRoom = 12;  // kMaxJoints, rounded up to whole registers

  int joints_ = 0;
  double fade_inverse_ = 0.0;
  std::array<double, kRoom> mid_{};
  std::array<double, kRoom> half_inverse_{};
};

}  // namespace plumb
