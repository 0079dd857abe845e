// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/guard.hpp"

#include <algorithm>

#include "finite.hpp"

namespace plumb {
namespace {

/// A limit that is no number allows nothing.
double sound(double limit) noexcept { return limit > 0.0 && limit < 1e300 ? limit : 0.0; }

format::GuardLimits sound(format::GuardLimits limits) noexcept {
  for (double* limit : {&limits.max_correction_m, &limits.max_rotation_rad, &limits.slew_m_per_s,
                        &limits.slew_rad_per_s, &limits.ramp_s, &limits.cycle_s})
    *limit = sound(*limit);
  return limits;
}

/// Length of v without overflow.
double norm(const Vector3& v) noexcept {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) largest = std::max({largest, v(i), -v(i)});
  if (largest < 1e-150) return largest;
  const Vector3 u(v(0) / largest, v(1) / largest, v(2) / largest);
  return largest * portable::sqrt(dot(u, u));
}

/// v, shortened to `limit`; `cut` becomes true if it was longer.
Vector3 shortened(const Vector3& v, double limit, bool& cut) noexcept {
  const double length = norm(v);
  if (length <= limit) return v;
  cut = true;
  return v * (limit / length);
}

/// 0 .. 1 without a corner at either end.
double smooth_step(double x) noexcept { return x * x * (3.0 - 2.0 * x); }

}  // namespace

Guard::Guard(const format::GuardLimits& limits) noexcept : limits_(sound(limits)) {}

void Guard::swap(const format::GuardLimits& limits) noexcept {
  limits_ = sound(limits);
  ++counters_.swaps;
}

double Guard::elapsed(double dt_s) const noexcept {
  return dt_s > 0.0 ? std::min(dt_s, 2.0 * limits_.cycle_s) : 0.0;
}

Guard::Offset Guard::wanted(const Transformd& X_BD, const Transformd& X_BC) const noexcept {
  Offset c{.translation = X_BC.p - X_BD.p, .rotation = Vector3::Zero()};
  if (limits_.corrects == format::Corrects::kPose)
    c.rotation = rotation_vector(times_transposed<double>(X_BC.R, X_BD.R));
  return c;
}

void Guard::ramp_towards(double goal, double dt) noexcept {
  const double step = limits_.ramp_s > 0.0 ? dt / limits_.ramp_s : 1.0;
  ramp_ = goal > ramp_ ? std::min(goal, ramp_ + step) : std::max(goal, ramp_ - step);
}

/// Moves the applied correction towards `goal`; true if a limit cut it.
bool Guard::approach(const Offset& goal, double dt) noexcept {
  bool cut = false;
  const double gain = smooth_step(ramp_);
  const Vector3 translation = shortened(goal.translation, limits_.max_correction_m, cut) * gain;
  const Vector3 rotation = shortened(goal.rotation, limits_.max_rotation_rad, cut) * gain;
  bool slewing_m = false, slewing_rad = false;
  const Vector3 move =
      shortened(translation - applied_.translation, limits_.slew_m_per_s * dt, slewing_m);
  const Vector3 turn =
      shortened(rotation - applied_.rotation, limits_.slew_rad_per_s * dt, slewing_rad);
  // Arriving sets the goal itself, so that a decayed correction is exactly zero.
  applied_.translation = slewing_m ? Vector3(applied_.translation + move) : translation;
  applied_.rotation = slewing_rad ? Vector3(applied_.rotation + turn) : rotation;
  return cut || slewing_m || slewing_rad;
}

GuardOutput Guard::applied_to(const Transformd& X_BD, Status status) noexcept {
  const Vector3& e = applied_.rotation;
  const Transformd turn = exp(format::Twist{.d = {}, .e = {e(0), e(1), e(2)}});
  Transformd X_BC = turn * Transformd{.R = X_BD.R, .p = Vector3::Zero()};
  X_BC.p = X_BD.p + applied_.translation;
  if (has_output_) last_ = X_BC;
  return {.X_BC = X_BC, .has_output = has_output_, .status = status};
}

/// What the correction says, unless it is no correction.
Status Guard::judge(const Transformd& X_BD, const Correction& correction) const noexcept {
  const bool sane = internal::is_pose(correction.X_BC) &&
                    internal::is_finite(Vector3(correction.X_BC.p - X_BD.p));
  return sane || refused(correction.status) ? correction.status : Status::kNotFinite;
}

/// One cycle further on the way out.
GuardOutput Guard::fade(const Transformd& X_BD, const Offset& goal, Status why,
                        double dt) noexcept {
  ramp_towards(0.0, dt);
  approach(goal, dt);
  return applied_to(X_BD, why);
}

GuardOutput Guard::step(const Transformd& X_BD, const Correction& correction, double dt_s,
                        Inputs inputs) noexcept {
  ++counters_.steps;
  if (!internal::is_pose(X_BD)) {
    ++counters_.held;
    return {.X_BC = last_, .has_output = has_output_, .status = Status::kNotFinite};
  }
  const Status status = judge(X_BD, correction);
  const double dt = elapsed(dt_s);
  const Offset goal = refused(status) ? Offset{} : wanted(X_BD, correction.X_BC);
  if (inputs == Inputs::kStale) {
    ++counters_.stale;
    return fade(X_BD, goal, Status::kStale, dt);
  }
  if (refused(status)) {
    ++counters_.refused;
    return fade(X_BD, goal, status, dt);
  }
  has_output_ = true;
  const double full = enabled_ == Enable::kOn ? 1.0 : 0.0;
  ramp_towards(full, dt);
  if (approach(goal, dt)) {
    ++counters_.limited;
    return applied_to(X_BD, Status::kLimited);
  }
  return applied_to(X_BD, ramp_ == full ? status : Status::kRamping);
}

}  // namespace plumb
