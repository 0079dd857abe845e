// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/descriptor.hpp"

/// What the laws have in common that turn over at some torque of their joint: torque_Nm.
namespace plumb::offline {

inline constexpr double kTorqueShares[] = {0.03, 0.1, 0.3};
inline constexpr GridAxis kTorqueGrid[] = {{.key = OptionKey::kTorque_Nm,
                                            .kind = GridAxis::Values::kOfLargestTorque,
                                            .values = kTorqueShares}};

/// A law that turns over beyond that share of the largest torque is a spring.
inline constexpr Refinement kTorqueRefinement{
    .key = OptionKey::kTorque_Nm, .kind = Refinement::Most::kOfLargestTorque, .most = 0.35};

inline constexpr EffectOption kTorqueOptions[] = {{
    .key = OptionKey::kTorque_Nm,
    .rule = "a number greater than 0",
    .example = "50",
    .above = 0.0,
    .credible_least = 1e-3,
    .credible_most = 1e5,
    .credible_help = "in Nm, behind the gear",
}};

/// One constant per joint: the torque given, or half the largest torque on that joint.
void bind_torque_constant(const EffectEntry& entry, const ConstantsSource& source,
                          format::Effect& out);

}  // namespace plumb::offline
