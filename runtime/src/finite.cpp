// SPDX-License-Identifier: Apache-2.0
#include "finite.hpp"

namespace plumb::internal {

bool is_finite(double x) noexcept { return x - x == 0.0; }

bool is_finite(const Vector3& v) noexcept {
  return is_finite(v(0)) && is_finite(v(1)) && is_finite(v(2));
}

bool is_joint_state(std::span<const double> q) noexcept {
  bool good = true;
  for (const double x : q) good &= (x >= -kMaxJointPosition) & (x <= kMaxJointPosition);
  return good;
}

bool is_pose(const Transformd& X) noexcept {
  const Vector3 x = X.R.col(0), y = X.R.col(1), z = X.R.col(2);
  const auto near = [](double value, double wanted) {
    return value - wanted >= -kMaxShear && value - wanted <= kMaxShear;
  };
  return is_finite(X.p) && near(dot(x, x), 1.0) && near(dot(y, y), 1.0) && near(dot(z, z), 1.0) &&
         near(dot(x, y), 0.0) && near(dot(y, z), 0.0) && near(dot(z, x), 0.0) &&
         dot(cross<double>(x, y), z) > 0.0;
}

}  // namespace plumb::internal
