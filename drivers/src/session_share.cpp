// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_share.hpp"

#include <algorithm>

namespace plumb::drivers {
namespace {

/// Smaller corrections count as zero; they are less than one count of any layout.
constexpr double kZero_m = 1e-9, kZero_rad = 1e-9;

double towards(double from, double to, double step) noexcept {
  return to > from ? std::min(to, from + step) : std::max(to, from - step);
}

/// `from` moved towards `to` by at most `most`. On arrival the result is exactly `to`.
/// Moves `at` by at most `most`. True if it has arrived.
bool slew(const Vector3& to, double most, std::array<double, 3>& at) noexcept {
  const Vector3 from(at.data()), way = to - from;
  const double length = way.norm();
  Eigen::Map<Vector3>(at.data()) = length <= most ? to : Vector3(from + way * (most / length));
  return Eigen::Map<Vector3>(at.data()) == to;
}

}  // namespace

bool CorrectionShare::at_zero() const noexcept {
  return translation_m() <= kZero_m && rotation_rad() <= kZero_rad;
}

void CorrectionShare::move_share(CorrectionMode mode, double step) noexcept {
  const double scale = mode == CorrectionMode::kShadow    ? 0.0
                       : mode == CorrectionMode::kLimited ? settings_.limited_scale
                                                          : 1.0;
  scale_ = towards(scale_, scale, step);
  cap_ = towards(cap_, mode == CorrectionMode::kFull ? 1.0 : 0.0, step);
}

CorrectionShare::Goal CorrectionShare::goal(const Transformd& X_BD,
                                            const Transformd& X_BG) const noexcept {
  Goal out{.translation = X_BG.p - X_BD.p,
           .rotation = rotation_vector(times_transposed<double>(X_BG.R, X_BD.R))};
  double factor = scale_;
  const double length = out.translation.norm() * factor;
  if (cap_ < 1.0 && length > settings_.limited_m)
    factor *= cap_ + (1.0 - cap_) * settings_.limited_m / length;
  out.translation *= factor;
  out.rotation *= factor;
  return out;
}

Transformd CorrectionShare::step(const Transformd& X_BD, const Transformd& X_BG,
                                 CorrectionMode mode, const format::GuardLimits& limits,
                                 double dt_s) noexcept {
  move_share(mode, limits.ramp_s > 0.0 ? dt_s / limits.ramp_s : 1.0);
  const Goal to = goal(X_BD, X_BG);
  const bool shifted = slew(to.translation, limits.slew_m_per_s * dt_s, applied_.d);
  const bool turned = slew(to.rotation, limits.slew_rad_per_s * dt_s, applied_.e);
  if (scale_ == 1.0 && cap_ == 1.0 && shifted && turned) return X_BG;
  Transformd X_BC = exp(format::Twist{.d = {}, .e = applied_.e});
  X_BC.R = (X_BC * Transformd{.R = X_BD.R, .p = Vector3::Zero()}).R;
  X_BC.p = X_BD.p + Vector3(applied_.d.data());
  return X_BC;
}

}  // namespace plumb::drivers
