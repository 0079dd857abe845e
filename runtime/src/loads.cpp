// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/loads.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "lanes.hpp"
#include "room.hpp"

namespace plumb {
namespace {

Vector3 vector(const std::array<double, 3>& v) noexcept { return {v[0], v[1], v[2]}; }

bool known(double v) noexcept { return v == v; }

/// Of either sign.
bool is_zero(const std::array<double, 3>& v) noexcept {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x) << 1; };
  return (bits(v[0]) | bits(v[1]) | bits(v[2])) == 0;
}

std::array<double, 4> point(const Vector3& p) noexcept { return {p(0), p(1), p(2), 1.0}; }

WidePoint wide(const Vector3& p) noexcept { return {Wide(p(0)), Wide(p(1)), Wide(p(2))}; }

Vector3 narrow(const WidePoint& p) noexcept {
  return {p.x.copies[0], p.y.copies[0], p.z.copies[0]};
}

}  // namespace

Weights::Weights(const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
                 const Transformd& X_TF, int joints) noexcept
    : gravity_(vector(gravity)),
      X_TF_(X_TF),
      payload_kg_(mechanics.payload_kg),
      payload_com_F_(vector(mechanics.payload_com_m)),
      joints_(static_cast<std::size_t>(joints)) {
  const std::size_t links = std::min(mechanics.links.size(), joints_);
  for (std::size_t j = 0; j < links; ++j) {
    centres_[j] = wide(vector(mechanics.links[j].com_m));
    mass_[j] = Wide(mechanics.links[j].mass_kg);
  }
}

double Weights::payload_kg(const Context& context) const noexcept {
  return known(context.payload_kg) ? context.payload_kg : payload_kg_;
}

void Weights::hang(const Context& context, WidePoint& payload_T, Loads& out) const noexcept {
  Vector3 com_F = payload_com_F_;
  for (int k = 0; k < 3; ++k)
    com_F(k) = known(context.payload_com_m[k]) ? context.payload_com_m[k] : com_F(k);
  payload_T = wide(X_TF_ * com_F);
  out.gravity = gravity_;
  out.payload_kg = payload_kg(context);
  out.payload_force = gravity_ * out.payload_kg;
  out.wrench = vector(context.force_N);
  out.tip_moment = vector(context.moment_Nm);
  out.pushed = !is_zero(context.force_N) || !is_zero(context.moment_Nm);
}

void Weights::weigh(const ChainPoints& points_B, Loads& out) const noexcept {
  if (joints_ == 6) return weigh<6>(points_B, out);
  weigh<0>(points_B, out);
}

/// kJoints: known when compiled, so that the loop is unrolled; 0: joints_.
template <std::size_t kJoints>
void Weights::weigh(const ChainPoints& points_B, Loads& out) const noexcept {
  const std::size_t n = kJoints > 0 ? kJoints : joints_;
  const auto& at = points_B.at[n];
  out.payload_at = Vector3(at[0], at[1], at[2]);
  static_assert(sizeof(Loads::Behind) == sizeof(Lanes));
  Lanes behind = lanes(at.data()) * out.payload_kg;
  for (std::size_t j = n; j-- > 0;) {
    behind = behind + lanes(points_B.at[j].data()) * mass_[j];
    store(behind, &out.joint[j]);
  }
}

void Weights::weigh(const ChainFrames& frames, const Context& context, Loads& out) const noexcept {
  WidePoint payload_T;
  hang(context, payload_T, out);
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
