// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/guard.hpp"

#include <algorithm>

#include "finite.hpp"
#include "pose_lanes.hpp"

namespace plumb {
namespace {

/// A valid limit is kept. A limit that is negative, infinite or NaN becomes 0, which allows no
/// correction.
double sound(double limit) noexcept { return limit > 0.0 && limit < 1e300 ? limit : 0.0; }

format::GuardLimits sound(format::GuardLimits limits) noexcept {
  for (double* limit : {&limits.max_correction_m, &limits.max_rotation_rad, &limits.slew_m_per_s,
                        &limits.slew_rad_per_s, &limits.ramp_s, &limits.cycle_s})
    *limit = sound(*limit);
  return limits;
}

/// Rises from 0 to 1 with zero slope at both ends.
double smooth_step(double x) noexcept { return x * x * (3.0 - 2.0 * x); }

double length(const Lanes& v) noexcept {
  const Lanes squares = v * v;
  return portable::sqrt(squares[0] + squares[1] + squares[2]);
}

/// v, which has this length, shortened to `limit`. If the square of the length overflows, the
/// result is zero. If length and limit are both zero, the quotient is NaN and v is not changed.
Lanes shortened(const Lanes& v, double length, double limit) noexcept {
  const double share = limit / length;
  return v * (share < 1.0 ? share : 1.0);
}

/// Moves what is applied towards `goal`; true if a limit cut it.
bool approach(const Lanes& goal, double gain, double size, double step, double* applied) noexcept {
  const Lanes before = lanes(applied);
  const double far = length(goal);
  const Lanes wanted = shortened(goal, far, size) * gain;
  const Lanes rest = wanted - before;
  const double left = length(rest);
  const bool slewing = left > step;
  // Arriving sets the goal itself, so that a decayed correction is exactly zero.
  store(slewing ? before + shortened(rest, left, step) : wanted, applied);
  return far > size || slewing;
}

}  // namespace

/// The correction that the guard moves to.
struct Guard::Goal {
  Lanes translation = broadcast(0.0);
  Lanes rotation = broadcast(0.0);
};

Guard::Guard(const format::GuardLimits& limits) noexcept : limits_(sound(limits)) {}

void Guard::swap(const format::GuardLimits& limits) noexcept {
  limits_ = sound(limits);
  ++counters_.swaps;
}

inline double Guard::elapsed(double dt_s) const noexcept {
  return dt_s > 0.0 ? std::min(dt_s, 2.0 * limits_.cycle_s) : 0.0;
}

/// Without a ramp time the step is infinite or NaN; in both cases the goal is reached at once.
inline void Guard::ramp_towards(double goal, double dt) noexcept {
  const double step = dt / limits_.ramp_s;
  ramp_ = std::max(std::min(goal, ramp_ + step), ramp_ - step);
}

template <Guard::Moves kMoves>
Guard::Goal Guard::wanted(const Transformd& X_BD, const Transformd& X_BC) const noexcept {
  Goal c{.translation = origin(X_BC) - origin(X_BD)};
  if (kMoves == Moves::kPose && limits_.corrects == format::Corrects::kPose) {
    const Vector3 e = rotation_vector(times_transposed<double>(X_BC.R, X_BD.R));
    c.rotation = Lanes{e(0), e(1), e(2), 0.0};
  }
  return c;
}

/// Moves the applied correction towards `goal`; true if a limit cut it.
template <Guard::Moves kMoves>
bool Guard::approach(const Goal& goal, double dt) noexcept {
  const double gain = smooth_step(ramp_);
  bool cut = plumb::approach(goal.translation, gain, limits_.max_correction_m,
                             limits_.slew_m_per_s * dt, applied_.translation.data());
  if (kMoves == Moves::kPose)
    cut |= plumb::approach(goal.rotation, gain, limits_.max_rotation_rad,
                           limits_.slew_rad_per_s * dt, applied_.rotation.data());
  return cut;
}

/// True if a rotation may have to be applied. A model that corrects positions only may still have
/// to undo a rotation that the model before it applied.
inline bool Guard::turns() const noexcept {
  using internal::magnitude_key;
  const Three& e = applied_.rotation;
  return limits_.corrects == format::Corrects::kPose ||
         (magnitude_key(e[0]) | magnitude_key(e[1]) | magnitude_key(e[2])) != 0;
}

template <Guard::Moves kMoves>
GuardOutput Guard::applied_to(const Transformd& X_BD, Status status) noexcept {
  GuardOutput out{.X_BC = moved(X_BD, lanes(applied_.translation.data())),
                  .has_output = has_output_,
                  .status = status};
  if (kMoves == Moves::kPose && turns())
    out.X_BC.R = product(rotation_of(Vector3(applied_.rotation.data())), X_BD.R);
  if (has_output_) copy(out.X_BC, last_);
  return out;
}

/// The status of the correction, or kNotFinite if it is accepted but not finite.
template <Guard::Moves kMoves>
Status Guard::judge(const Transformd& X_BD, const Correction& correction) const noexcept {
  const Transformd& X_BC = correction.X_BC;
  const bool turned = kMoves == Moves::kPose && limits_.corrects == format::Corrects::kPose;
  const bool sane = internal::is_finite(Lanes(origin(X_BC) - origin(X_BD))) &&
                    (!turned || internal::is_pose(X_BC));
  return sane || refused(correction.status) ? correction.status : Status::kNotFinite;
}

/// The status by which this step proceeds. Counts the causes that let the correction fade.
inline Status Guard::heard(Status said, Inputs inputs) noexcept {
  if (inputs == Inputs::kStale) {
    ++counters_.stale;
    return Status::kStale;
  }
  if (refused(said)) ++counters_.refused;
  return said;
}

template <Guard::Moves kMoves>
[[gnu::noinline]] GuardOutput Guard::step_of(const Transformd& X_BD, const Correction& correction,
                                             double dt_s, Inputs inputs) noexcept {
  ++counters_.steps;
  if (!internal::is_pose(X_BD)) {
    ++counters_.held;
    return {.X_BC = last_, .has_output = has_output_, .status = Status::kNotFinite};
  }
  const Status said = judge<kMoves>(X_BD, correction);
  const Goal goal = refused(said) ? Goal{} : wanted<kMoves>(X_BD, correction.X_BC);
  const Status status = heard(said, inputs);
  if (!refused(status)) has_output_ = true;
  const double dt = elapsed(dt_s);
  const double end = enabled_ == Enable::kOn && !refused(status) ? 1.0 : 0.0;
  ramp_towards(end, dt);
  const bool cut = approach<kMoves>(goal, dt);
  if (refused(status)) return applied_to<kMoves>(X_BD, status);
  if (cut) {
    ++counters_.limited;
    return applied_to<kMoves>(X_BD, Status::kLimited);
  }
  return applied_to<kMoves>(X_BD, ramp_ == end ? status : Status::kRamping);
}

GuardOutput Guard::step(const Transformd& X_BD, const Correction& correction, double dt_s,
                        Inputs inputs) noexcept {
  return turns() ? step_of<Moves::kPose>(X_BD, correction, dt_s, inputs)
                 : step_of<Moves::kPosition>(X_BD, correction, dt_s, inputs);
}

}  // namespace plumb
