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
    centres_.at[j] = point(vector(mechanics.links[j].com_m));
    mass_[j] = mechanics.links[j].mass_kg;
  }
}

double Weights::payload_kg(const Context& context) const noexcept {
  return known(context.payload_kg) ? context.payload_kg : payload_kg_;
}

void Weights::hang(const Context& context, ChainPoints& of_frames, Loads& out) const noexcept {
  Vector3 com_F = payload_com_F_;
  for (int k = 0; k < 3; ++k)
    com_F(k) = known(context.payload_com_m[k]) ? context.payload_com_m[k] : com_F(k);
  internal::copy(centres_, of_frames);
  of_frames.at[joints_] = point(X_TF_ * com_F);
  out.gravity = gravity_;
  out.payload_kg = payload_kg(context);
  out.payload_force = gravity_ * out.payload_kg;
  out.wrench = vector(context.force_N);
  out.tip_moment = vector(context.moment_Nm);
  out.pushed = !is_zero(context.force_N) || !is_zero(context.moment_Nm);
}

void Weights::weigh(const ChainPoints& points_B, Loads& out) const noexcept {
  const auto& at = points_B.at[joints_];
  out.payload_at = Vector3(at[0], at[1], at[2]);
  static_assert(sizeof(Loads::Behind) == sizeof(Lanes));
  Lanes behind = lanes(at.data()) * out.payload_kg;
  for (std::size_t j = joints_; j-- > 0;) {
    behind = behind + lanes(points_B.at[j].data()) * mass_[j];
    store(behind, reinterpret_cast<double*>(&out.joint[j]));
  }
}

void Weights::weigh(const Chain& chain, const ChainFrames& frames, const Context& context,
                    Loads& out) const noexcept {
  ChainPoints of_frames, points_B;
  hang(context, of_frames, out);
  const auto place = [&](const Transformd& X, std::size_t i) {
    const auto& c = of_frames.at[i];
    points_B.at[i] = point(X * Vector3(c[0], c[1], c[2]));
  };
  const auto n = static_cast<std::size_t>(chain.joints());
  for (std::size_t j = 0; j < n; ++j) place(frames.joint[j], j);
  place(frames.tip, n);
  weigh(points_B, out);
}

void weigh(const Chain& chain, const ChainFrames& frames, const format::Mechanics& mechanics,
           const std::array<double, 3>& gravity, const Transformd& X_TF, const Context& context,
           Loads& out) noexcept {
  const Weights weights(mechanics, gravity, X_TF, chain.joints());
  weights.weigh(chain, frames, context, out);
}

}  // namespace plumb
