// SPDX-License-Identifier: Apache-2.0
#include "finite.hpp"

#include <algorithm>

namespace plumb::internal {
namespace {

/// NaN counts as larger than anything.
std::uint64_t shear_key(const Vector3& x, const Vector3& y, const Vector3& z) noexcept {
  const std::uint64_t lengths =
      std::max({magnitude_key(dot(x, x) - 1.0), magnitude_key(dot(y, y) - 1.0),
                magnitude_key(dot(z, z) - 1.0)});
  const std::uint64_t angles =
      std::max({magnitude_key(dot(x, y)), magnitude_key(dot(y, z)), magnitude_key(dot(z, x))});
  return std::max(lengths, angles);
}

}  // namespace

bool is_pose(const Transformd& X) noexcept {
  const Vector3 x = X.R.col(0), y = X.R.col(1), z = X.R.col(2);
  const bool proper = dot(cross<double>(x, y), z) > 0.0;
  const bool square = shear_key(x, y, z) <= magnitude_key(kMaxShear);
  return square && proper && is_finite(X.p);
}

}  // namespace plumb::internal
