// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/formula.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability formula_testable(const DataSense&) { return can_show_weakly("depends on the formula"); }

constexpr EffectDescriptor kFormulaDescriptor{
    .name = effects::Formula::kInfo.name,
    .law = &effects::Formula::kInfo,
    .explanation =
        "An effect of your own under [[effects.formula]]: target = \"dq2\", expression = \"k * "
        "tau2\", parameters = [\"k [rad/(N m)] ~ 1e-6\"]. Targets dq1, pre1.rx, post1.dz, "
        "base.dx, tool.rz, tcp.x and the like; it reads q1 tau1 dir1 travel1 u1 and so on, t, "
        "payload, temp_NAME, x y z, row. Units are checked. Needs: the columns of what it reads.",
    .joints = JointList::kInFormula,
    .testable = formula_testable,
    .measure = "whatever the formula names",
    .search = Search::kNever,

};

}  // namespace

const EffectDescriptor& law_descriptor(effects::Formula) { return kFormulaDescriptor; }

}  // namespace plumb::offline
