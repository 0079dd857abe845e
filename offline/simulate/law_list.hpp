// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/law.hpp"

namespace plumb::offline::sim {

using MadeLaw = std::unique_ptr<Law>;

// One function for each law makes it. The formulas are stated above the code.
MadeLaw make_joint_compliance(const HiddenEffect& effect, const World& world);
MadeLaw make_soft_joint_compliance(const HiddenEffect& effect, const World& world);
MadeLaw make_cross_compliance(const HiddenEffect& effect, const World& world);
MadeLaw make_payload_compliance(const HiddenEffect& effect, const World& world);
MadeLaw make_backlash(const HiddenEffect& effect, const World& world);
MadeLaw make_gravity_compensator(const HiddenEffect& effect, const World& world);
MadeLaw make_link_flexure(const HiddenEffect& effect, const World& world);
MadeLaw make_base_compliance(const HiddenEffect& effect, const World& world);
MadeLaw make_tool_sag(const HiddenEffect& effect, const World& world);
MadeLaw make_gear_harmonics(const HiddenEffect& effect, const World& world);
MadeLaw make_gear_ripple(const HiddenEffect& effect, const World& world);
MadeLaw make_joint_table(const HiddenEffect& effect, const World& world);
MadeLaw make_encoder_scale(const HiddenEffect& effect, const World& world);
MadeLaw make_encoder_eccentricity(const HiddenEffect& effect, const World& world);
MadeLaw make_axis_wobble(const HiddenEffect& effect, const World& world);
MadeLaw make_wrist_coupling(const HiddenEffect& effect, const World& world);
MadeLaw make_reversal(const HiddenEffect& effect, const World& world);
MadeLaw make_overcompensated_reversal(const HiddenEffect& effect, const World& world);
MadeLaw make_settling_lag(const HiddenEffect& effect, const World& world);
MadeLaw make_thermal_growth(const HiddenEffect& effect, const World& world);
MadeLaw make_drift(const HiddenEffect& effect, const World& world);
MadeLaw make_step_reflector(const HiddenEffect& effect, const World& world);
MadeLaw make_step_base(const HiddenEffect& effect, const World& world);
MadeLaw make_two_steps_reflector(const HiddenEffect& effect, const World& world);
MadeLaw make_two_steps_base(const HiddenEffect& effect, const World& world);
MadeLaw make_step_encoder(const HiddenEffect& effect, const World& world);
MadeLaw make_tracker(const HiddenEffect& effect, const World& world);
MadeLaw make_dress_pack(const HiddenEffect& effect, const World& world);
MadeLaw make_joint_product(const HiddenEffect& effect, const World& world);
MadeLaw make_other_joint(const HiddenEffect& effect, const World& world);
MadeLaw make_joint_memory(const HiddenEffect& effect, const World& world);
MadeLaw make_warm_encoder(const HiddenEffect& effect, const World& world);
MadeLaw make_room_sway(const HiddenEffect& effect, const World& world);
MadeLaw make_tool_wander(const HiddenEffect& effect, const World& world);
MadeLaw make_folded_sine(const HiddenEffect& effect, const World& world);
MadeLaw make_growing(const HiddenEffect& effect, const World& world);
MadeLaw make_directed_sine(const HiddenEffect& effect, const World& world);
MadeLaw make_encoder_counts(const HiddenEffect& effect, const World& world);
MadeLaw make_axial_play(const HiddenEffect& effect, const World& world);
MadeLaw make_moving_air(const HiddenEffect& effect, const World& world);
MadeLaw make_rocking_base(const HiddenEffect& effect, const World& world);
MadeLaw make_unsensed_growth(const HiddenEffect& effect, const World& world);
MadeLaw make_parallelogram_wave(const HiddenEffect& effect, const World& world);
MadeLaw make_sunny_link(const HiddenEffect& effect, const World& world);
MadeLaw make_planar_published(const HiddenEffect& effect, const World& world);
MadeLaw make_planar_printed(const HiddenEffect& effect, const World& world);

}  // namespace plumb::offline::sim
