// SPDX-License-Identifier: Apache-2.0
#include "effects/torque_constant.hpp"

#include <algorithm>

namespace plumb::offline {
namespace {

constexpr double kTurnsOverAt = 0.5;      // of the largest torque, where the cell says nothing
constexpr double kLeastTorque_Nm = 1e-6;  // it is a divisor

}  // namespace

void bind_torque_constant(const EffectEntry& entry, const ConstantsSource& source,
                          format::Effect& out) {
  out.constants.clear();
  if (const double given = number_option(entry, OptionKey::kTorque_Nm, 0.0); given > 0.0) {
    out.constants.assign(out.joints.size(), given);
    return;
  }
  const auto largest = source.largest_torques();
  for (const int j : out.joints)
    out.constants.push_back(std::max(kLeastTorque_Nm, kTurnsOverAt * largest[j]));
}

}  // namespace plumb::offline
