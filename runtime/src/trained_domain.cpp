// SPDX-License-Identifier: Apache-2.0
#include "trained_domain.hpp"

#include <algorithm>

namespace plumb {

TrainedDomain::TrainedDomain(const format::Domain& domain) noexcept
    : joints_(std::min(static_cast<int>(domain.q_min.size()), format::kMaxJoints)),
      fade_inverse_(1.0 / (2.0 * domain.fade)) {
  for (int i = 0; i < joints_; ++i) {
    mid_[i] = 0.5 * (domain.q_min[i] + domain.q_max[i]);
    half_inverse_[i] = 2.0 / (domain.q_max[i] - domain.q_min[i]);
  }
}

double TrainedDomain::normalise(std::span<const double> q, std::span<double> u) const noexcept {
  if (joints_ == 6) {
    internal::SixJoints at;
    const double trusted = normalise(internal::SixJoints(q.data()), at);
    at.store(u.data());
    return trusted;
  }
  const auto n = static_cast<std::size_t>(joints_);
  Packed farthest = packed(1.0);
  for (std::size_t i = 0; i < n; i += kPackedLanes) {
    const Packed at = (load_some(&q[i], n - i) - load(&mid_[i])) * load(&half_inverse_[i]);
    farthest = internal::farther(at, farthest);
    store_some(internal::clamped_to_box(at), &u[i], n - i);
  }
  return internal::trust(farthest, fade_inverse_);
}

}  // namespace plumb
