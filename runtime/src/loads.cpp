// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/loads.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "columns.hpp"
#include "lane_choices.hpp"
#include "lane_order.hpp"
#include "lanes.hpp"
#include "pose_lanes.hpp"

namespace plumb {
namespace {

Vector3 vector(const std::array<double, 3>& v) noexcept { return {v[0], v[1], v[2]}; }
Vector3 vector(const Lanes& v) noexcept { return {v[0], v[1], v[2]}; }

std::array<double, 4> point(const Vector3& p) noexcept { return {p(0), p(1), p(2), 1.0}; }

WidePoint wide(const Vector3& p) noexcept { return {Wide(p(0)), Wide(p(1)), Wide(p(2))}; }

Vector3 narrow(const WidePoint& p) noexcept {
  return {p.x.copies[0], p.y.copies[0], p.z.copies[0]};
}

/// A context as an array of numbers. In it the payload and its centre are adjacent, and so are the
/// force and the moment.
const double* numbers(const Context& context) noexcept {
  static_assert(std::is_standard_layout_v<Context>);
  return reinterpret_cast<const double*>(&context);
}
constexpr std::size_t kHangsAt = offsetof(Context, payload_kg) / sizeof(double);
constexpr std::size_t kWrenchAt = offsetof(Context, force_N) / sizeof(double);
static_assert(offsetof(Context, payload_com_m) == (kHangsAt + 1) * sizeof(double) &&
              offsetof(Context, moment_Nm) == (kWrenchAt + 3) * sizeof(double));

Lanes lanes(const Triple& v) noexcept { return plumb::lanes(v.numbers.data()); }
Lanes lanes(const Loads::Behind& behind) noexcept {
  return plumb::lanes(behind.first_moment.data());
}

/// The origin of a frame. It also reads one number of the frame that follows, so X must not be the
/// last one.
Lanes origin_of(const Transformd& X) noexcept { return plumb::lanes(plumb::numbers(X) + 9); }

/// Summed in the order of `dot`.
double sum_of_three(const Lanes& a) noexcept { return a[0] + a[1] + a[2]; }

/// The first moment about p of masses whose first moment about the base's origin is given.
Lanes about(const Loads::Behind& behind, const Lanes& p) noexcept {
  return lanes(behind) - p * behind.mass;
}

Lanes force_of(const Loads& loads, int j) noexcept {
  const Lanes weight = lanes(loads.gravity) * loads.joint[j].mass;
  return loads.pushed ? weight + lanes(loads.wrench) : weight;
}

/// The moment of the external wrench about a point; `arm` leads from that point to the tip.
Lanes wrench_about(const Loads& loads, const Lanes& arm) noexcept {
  return cross(arm, lanes(loads.wrench)) + lanes(loads.tip_moment);
}

Lanes moment_of(const Loads& loads, int j, const ChainFrames& frames) noexcept {
  const Lanes at = origin_of(frames.joint[j]);
  const Lanes weight = cross(about(loads.joint[j], at), lanes(loads.gravity));
  return loads.pushed ? weight + wrench_about(loads, origin(frames.tip) - at) : weight;
}

/// The component of a load along the axis of joint j.
double along(int j, const ChainFrames& frames, const Lanes& load) noexcept {
  return sum_of_three(axis(frames.joint[j], 2) * load);
}

}  // namespace

Vector3 Loads::force(int j) const noexcept { return vector(force_of(*this, j)); }

Vector3 Loads::payload_force_in(const Transformd& X_BC) const noexcept {
  const Lanes force = lanes(payload_force);
  const Lanes x = axis(X_BC, 0) * force, y = axis(X_BC, 1) * force, z = axis(X_BC, 2) * force;
  return {sum_of_three(x), sum_of_three(y), sum_of_three(z)};
}

Vector3 Loads::moment(int j, const ChainFrames& frames) const noexcept {
  return vector(moment_of(*this, j, frames));
}

Vector3 Loads::base_moment(const ChainFrames& frames) const noexcept {
  const Lanes weight = cross(lanes(joint[0]), lanes(gravity));
  if (!pushed) return vector(weight);
  return vector(weight + cross(origin(frames.tip), lanes(wrench)) + lanes(tip_moment));
}

double Loads::torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept {
  return along(j, frames, chain.revolute(j) ? moment_of(*this, j, frames) : force_of(*this, j));
}

double Loads::payload_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept {
  const Lanes force = lanes(payload_force);
  const Lanes arm = lanes(payload_at) - origin_of(frames.joint[j]);
  return along(j, frames, chain.revolute(j) ? cross(arm, force) : force);
}

double Loads::wrench_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept {
  if (!chain.revolute(j)) return along(j, frames, lanes(wrench));
  if (!pushed) return along(j, frames, broadcast(0.0));
  return along(j, frames, wrench_about(*this, origin(frames.tip) - origin_of(frames.joint[j])));
}

Weights::Weights(const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
                 const Transformd& X_TF, int joints) noexcept
    : payload_{mechanics.payload_kg, mechanics.payload_com_m[0], mechanics.payload_com_m[1],
               mechanics.payload_com_m[2]},
      gravity_(vector(gravity)),
      joints_(static_cast<std::size_t>(joints)) {
  Columns(X_TF).store(X_TF_);
  const std::size_t links = std::min(mechanics.links.size(), joints_);
  for (std::size_t j = 0; j < links; ++j) {
    centres_[j] = wide(vector(mechanics.links[j].com_m));
    mass_[j] = Wide(mechanics.links[j].mass_kg);
  }
}

void Weights::attach_payload(const Context& context, WidePoint& payload_T,
                             Loads& out) const noexcept {
  const double* const given = numbers(context);
  const Lanes payload = known_or(plumb::lanes(given + kHangsAt), plumb::lanes(payload_.data()));
  const Lanes at_T = plumb::lanes(X_TF_[0].data()) * spread_lane<1>(payload) +
                     plumb::lanes(X_TF_[1].data()) * spread_lane<2>(payload) +
                     plumb::lanes(X_TF_[2].data()) * spread_lane<3>(payload) +
                     plumb::lanes(X_TF_[3].data());
  store(spread_lane<0>(at_T), &payload_T.x);
  store(spread_lane<1>(at_T), &payload_T.y);
  store(spread_lane<2>(at_T), &payload_T.z);
  out.payload_kg = payload[0];
  const Lanes g = lanes(gravity_);
  store(g, &out.gravity);
  store(g * spread_lane<0>(payload), &out.payload_force);
  const Lanes force = plumb::lanes(given + kWrenchAt), moment = plumb::lanes(given + kWrenchAt + 2);
  store(force, &out.wrench);
  store(last_three(moment), &out.tip_moment);
  out.pushed = !all(zero(force) & zero(moment));
}

/// Kept out of line so that its callers need not align their stack for its registers.
[[gnu::noinline]] void Weights::weigh(const ChainPoints& points_B, Loads& out) const noexcept {
  if (joints_ == 6) return weigh<6>(points_B, out);
  weigh<0>(points_B, out);
}

/// kJoints: number of joints as a compile-time constant, so that the loop is unrolled; 0: joints_.
template <std::size_t kJoints>
void Weights::weigh(const ChainPoints& points_B, Loads& out) const noexcept {
  const std::size_t n = kJoints > 0 ? kJoints : joints_;
  const Lanes payload_at = plumb::lanes(points_B.at[n].data());
  store(payload_at, &out.payload_at);
  static_assert(sizeof(Loads::Behind) == sizeof(Lanes) &&
                offsetof(Loads::Behind, mass) == 3 * sizeof(double));
  Lanes behind = payload_at * out.payload_kg;
  for (std::size_t j = n; j-- > 0;) {
    behind = behind + plumb::lanes(points_B.at[j].data()) * mass_[j];
    store(behind, &out.joint[j]);
  }
}

void Weights::weigh(const ChainFrames& frames, const Context& context, Loads& out) const noexcept {
  WidePoint payload_T;
  attach_payload(context, payload_T, out);
  ChainPoints points_B;
  for (std::size_t j = 0; j < joints_; ++j)
    points_B.at[j] = point(frames.joint[j] * narrow(centres_[j]));
  points_B.at[joints_] = point(frames.tip * narrow(payload_T));
  weigh(points_B, out);
}

void weigh(const Chain& chain, const ChainFrames& frames, const format::Mechanics& mechanics,
           const std::array<double, 3>& gravity, const Transformd& X_TF, const Context& context,
           Loads& out) noexcept {
  const Weights weights(mechanics, gravity, X_TF, chain.joints());
  weights.weigh(frames, context, out);
}

}  // namespace plumb
