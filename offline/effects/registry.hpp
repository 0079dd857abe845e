// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "effects/descriptor.hpp"

/// The one place where the offline half learns what an effect is. Descriptors are asked for by name
/// here, and nowhere else is a name compared.
namespace plumb::offline {

/// Geometry and the local tree, then every law of the library in its order.
std::span<const EffectDescriptor* const> effect_descriptors();

/// Null if there is no effect of that name. Cost: one comparison of names per effect.
const EffectDescriptor* find_descriptor(std::string_view name);

/// The same for a name that is known to be one; throws std::out_of_range otherwise.
const EffectDescriptor& descriptor_of(std::string_view name);

/// Whether entries of that name are the geometry, the local tree, waves of a joint, a series of
/// waves, a change point, or a formula of the user's own. False for an unknown name.
bool is_geometry(std::string_view name);
bool is_local_tree(std::string_view name);
bool is_wave(std::string_view name);
bool is_series(std::string_view name);
bool is_change_point(std::string_view name);
bool is_formula(std::string_view name);

/// Whether the effect is an error of one measurement (drift, step, tracker), and so of no other
/// one. The procedure (settling_lag) is none. False for an unknown name.
bool is_of_measurement(std::string_view name);

/// Whether the motion changes with the weight that the arm carries.
bool grows_with_load(const EffectDescriptor& effect);

/// Names for entries that a program makes itself. A wave is one of the law that is scanned over the
/// wave number, a change point one of the law that is scanned over the rows.
std::string geometry_effect();
std::string wave_effect();
std::string series_effect();
std::string change_point_effect();
std::string formula_effect();

}  // namespace plumb::offline
