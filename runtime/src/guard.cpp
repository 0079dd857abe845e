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

/// v, shortened to `limit`; `cut` becomes true if it was longer. One whose square is beyond all
/// numbers becomes zero.
Vector3 shortened(const Vector3& v, double limit, bool& cut) noexcept {
  const double length = portable::sqrt(dot(v, v));
  const bool longer = length > limit;
  cut |= longer;
  const double share = limit / length;
  return v * (longer ? share : 1.0);
}

/// 0 .. 1 without a corner at either end.
double smooth_step(double x) noexcept { return x * x * (3.0 - 2.0 * x); }

}  // namespace

Guard::Guard(const format::GuardLimits& limits) noexcept : limits_(sound(limits)) {}

void Guard::swap(const format::GuardLimits& limits) noexcept {
  limits_ = sound(limits);
  ++counters_.swaps;
}

inline double Guard::elapsed(double dt_s) const noexcept {
  return dt_s > 0.0 ? std::min(dt_s, 2.0 * limits_.cycle_s) : 0.0;
}

inline Guard::Offset Guard::wanted(const Transformd& X_BD, const Transformd& X_BC) const noexcept {
  Offset c{.translation = X_BC.p - X_BD.p, .rotation = Vector3::Zero()};
  if (limits_.corrects == format::Corrects::kPose)
    c.rotation = rotation_vector(times_transposed<double>(X_BC.R, X_BD.R));
  return c;
}

inline void Guard::ramp_towards(double goal, double dt) noexcept {
  const double step = limits_.ramp_s > 0.0 ? dt / limits_.ramp_s : 1.0;
  ramp_ = goal > ramp_ ? std::min(goal, ramp_ + step) : std::max(goal, ramp_ - step);
}

/// Moves the applied correction towards `goal`; true if a limit cut it.
inline bool Guard::approach(const Offset& goal, double dt) noexcept {
  const double gain = smooth_step(ramp_);
  bool cut = approach(goal.translation, gain, limits_.max_correction_m, limits_.slew_m_per_s * dt,
                      applied_.translation);
  if (turns())
    cut |= approach(goal.rotation, gain, limits_.max_rotation_rad, limits_.slew_rad_per_s * dt,
                    applied_.rotation);
  return cut;
}

inline bool Guard::approach(const Vector3& goal, double gain, double size, double step,
                            Vector3& applied) noexcept {
  bool cut = false, slewing = false;
  const Vector3 wanted = shortened(goal, size, cut) * gain;
  const Vector3 move = shortened(wanted - applied, step, slewing);
  // Arriving sets the goal itself, so that a decayed correction is exactly zero.
  applied = slewing ? Vector3(applied + move) : wanted;
  return cut || slewing;
}

/// A model that corrects positions only may still have a turn to undo, of the one before it.
inline bool Guard::turns() const noexcept {
  const Vector3& e = applied_.rotation;
  return limits_.corrects == format::Corrects::kPose || e(0) != 0.0 || e(1) != 0.0 || e(2) != 0.0;
}

inline GuardOutput Guard::applied_to(const Transformd& X_BD, Status status) noexcept {
  GuardOutput out{.X_BC = X_BD, .has_output = has_output_, .status = status};
  if (turns()) out.X_BC.R = product(rotation_of(applied_.rotation), X_BD.R);
  out.X_BC.p += applied_.translation;
  if (has_output_) last_ = out.X_BC;
  return out;
}

/// What the correction says, unless it is no correction.
inline Status Guard::judge(const Transformd& X_BD, const Correction& correction) const noexcept {
  const bool turned = limits_.corrects == format::Corrects::kPose;
  const bool sane = internal::is_finite(Vector3(correction.X_BC.p - X_BD.p)) &&
                    (!turned || internal::is_pose(correction.X_BC));
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
