// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell.hpp"
#include "tests/blind/hidden_case.hpp"

namespace plumb::tests {

/// Whether the entry is of the class of what is hidden, or of one that no measurement of the point
/// can tell from it.
bool is_like(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry);

/// Whether it is at the right joint, or belongs to the arm.
bool at_joint(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry);

/// Eccentric gears err a little three times a turn as well, and more under load.
bool is_third_harmonic(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry);

/// Whether the entry has to do with what is hidden: it is like it, or it acts on the very joint
/// whose true law is richer than those of the library.
bool is_related(const HiddenCase::Answer& hidden, const offline::EffectEntry& entry);

}  // namespace plumb::tests
