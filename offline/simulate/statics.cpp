// SPDX-License-Identifier: Apache-2.0
#include "simulate/statics.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline::sim {
namespace {

constexpr double kCarriedPerCubicMetre = 5.0;   // [kg/m^3]
constexpr double kWeightPerPayloadMetre = 3.0;  // [1/m]
constexpr double kComError_m = 0.1;
constexpr double kLeastMass = 0.2;  // share of the mass in the cell
constexpr double kMassRatio = 0.6;  // ratio of the masses of successive links

double guessed_moving_mass(const Cell& cell, double reach) {
  const double carried =
      std::max(cell.payload.mass_kg, kCarriedPerCubicMetre * reach * reach * reach);
  return kWeightPerPayloadMetre * carried * reach;
}

Vector3d guessed_com(const Arm& arm, int i, Random& random) {
  const Vector3d along = arm.link_vector(i, VectorXd::Zero(arm.joints()));
  const Vector3d beside(random.normal(), random.normal(), random.normal());
  return random.uniform(0.35, 0.55) * along + 0.01 * arm.reach() * beside;
}

}  // namespace

MassModel guess_masses(const Cell& cell, const Arm& arm, double share, Random random) {
  MassModel out;
  const int n = arm.joints();
  const double first =
      guessed_moving_mass(cell, arm.reach()) * (1.0 - kMassRatio) / (1.0 - std::pow(kMassRatio, n));
  for (int i = 0; i < n; ++i) {
    const auto& known = cell.mechanics[i];
    const Vector3d guess = guessed_com(arm, i, random);
    const Vector3d along = arm.link_vector(i, VectorXd::Zero(n));
    const double bar = known.kg_per_m.value_or(0.0) * known.length_m.value_or(along.norm());
    const double otherwise = known.kg_per_m ? bar : first * std::pow(kMassRatio, i);
    out.mass.push_back(known.link_mass_kg.value_or(otherwise));
    const bool is_bar = known.kg_per_m && !known.link_mass_kg;
    out.com.push_back(known.link_com_m ? Vector3d(known.link_com_m->data())
                      : is_bar         ? Vector3d(0.5 * along)
                                       : guess);
    if (share == 0.0) continue;
    out.mass[i] *= std::max(1.0 + share * random.normal(), kLeastMass);
    for (int k = 0; k < 3; ++k) out.com[i](k) += share * kComError_m * random.normal();
  }
  out.payload = cell.payload.mass_kg;
  out.payload_com = Vector3d(cell.payload.com_m.data());
  out.gravity = Vector3d(cell.gravity.data());
  return out;
}

Loads::Loads(const MassModel& masses, const Frames& frames, double payload_kg,
             const Vector3d& com_F)
    : mass_(masses.mass.size() + 1),
      first_moment_(masses.mass.size() + 1),
      gravity_(masses.gravity),
      drives_(masses.drives) {
  const int n = static_cast<int>(masses.mass.size());
  mass_[n] = payload_kg;
  first_moment_[n] = payload_kg * (frames.flange * com_F);
  for (int i = n - 1; i >= 0; --i) {
    mass_[i] = mass_[i + 1] + masses.mass[i];
    first_moment_[i] = first_moment_[i + 1] + masses.mass[i] * (frames.joint[i] * masses.com[i]);
  }
  for (const auto& X : frames.joint) {
    axis_.push_back(X.linear().col(2));
    origin_.push_back(X.translation());
  }
}

}  // namespace plumb::offline::sim
