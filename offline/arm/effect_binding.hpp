// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb::offline {

/// The physical effects that a cell lists, bound to its arm and data: joints, constants (given, or
/// chosen from the data: half the largest torque, the mean temperature), parameters still 0.
/// Throws Failure (kInput) if a given one cannot work with these measurements.
std::vector<format::Effect> bind_effects(const Cell& cell, const Measurements& measured);

/// The same for one of them; `entry` names a law of the library.
format::Effect bind_effect(const Cell& cell, const Measurements& measured,
                           const EffectEntry& entry);

/// Masses and payload of the cell.
format::Mechanics mechanics_of(const Cell& cell);

/// Why this version cannot evaluate the effects of a model, in words; empty if it can.
std::string unusable_effects(const format::Model& model);

/// Temperature sensors the effects read, in the order of Context::temperature_degC.
std::vector<std::string> temperature_names(const format::Model& model);

/// "gear_ripple.J2.k20.sin": the effect, its joint, what distinguishes it from others at this
/// joint, and the parameter.
std::string effect_parameter_name(const format::Model& model, int effect, int parameter);

/// Whether an effect belongs to the robot or to the measurement, as its law or formula says.
EffectDomain domain_of(const format::Effect& effect);

/// Name, unit, typical size and bounds of a parameter, from the catalogue or from the formula. Its
/// texts refer to the memory of the model.
EffectParameter effect_parameter(const format::Model& model, int effect, int parameter);

}  // namespace plumb::offline
