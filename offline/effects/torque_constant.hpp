// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/descriptor.hpp"

/// Shared by laws with a term that saturates beyond some torque of the joint, torque_Nm.
namespace plumb::offline {

/// Values that a scan tries, as shares of the largest torque. Chosen: evenly on a logarithmic scale
/// up to the largest one below.
inline constexpr double kTorqueShares[] = {0.03, 0.1, 0.3};
inline constexpr GridAxis kTorqueGrid[] = {{.key = OptionKey::kTorque_Nm,
                                            .kind = GridAxis::Values::kOfLargestTorque,
                                            .values = kTorqueShares}};

/// With a larger share of the largest torque, that term is nearly linear, like a spring.
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
