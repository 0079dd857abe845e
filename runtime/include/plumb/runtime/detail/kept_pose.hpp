// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "plumb/runtime/transform.hpp"

namespace plumb {

/// A pose in a state that is copied byte by byte. Eigen's matrices are not trivially copyable.
class KeptPose {
 public:
  KeptPose() noexcept : KeptPose(Transformd{}) {}
  KeptPose(const Transformd& X) noexcept {
    std::copy_n(X.R.data(), 9, numbers_.begin());
    std::copy_n(X.p.data(), 3, numbers_.begin() + 9);
  }
  operator Transformd() const noexcept {
    return {.R = Matrix3(numbers_.data()), .p = Vector3(numbers_.data() + 9)};
  }

  /// The three axes, then the origin.
  double* numbers() noexcept { return numbers_.data(); }

 private:
  std::array<double, 12> numbers_;
};

static_assert(std::is_trivially_copyable_v<KeptPose>);

}  // namespace plumb
