// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/cell_sections.hpp"
#include "formula/compile_formula.hpp"

namespace plumb::offline {

/// The keys of one [[effects.formula]]: name, target, expression, parameters, domain. Reports all
/// that is wrong with it, each at its place in the text.
void read_formula(TomlTable& table, CellDraft& draft, EffectEntry& entry);

/// The same texts, from an entry that was read.
FormulaText formula_text(const EffectEntry& entry);

/// What formulas know of this arm.
FormulaArm formula_arm(const format::Chain& nominal);

}  // namespace plumb::offline
