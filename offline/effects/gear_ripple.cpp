// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/gear_ripple.hpp"

#include <fmt/format.h>

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr double kMostCycles = 1e5;  // a motor turn has hundreds, its poles and slots thousands

constexpr EffectOption kGearRippleOptions[] = {{
    .key = OptionKey::kCyclesPerTurn,
    .rule = "a number greater than 0, at most 100000",
    .example = "20",
    .above = 0.0,
    .most = kMostCycles,
    .required = true,
    .lists = true,
}};

Testability gear_ripple_testable(const DataSense& data) {
  if (data.poses < kFewPoses) return cannot_show(poses_text(data));
  if (data.poses < kManyPoses)
    return can_show_weakly(poses_text(data) + " for a scan over many frequencies");
  const std::string known = joint_list(data, [&](int j) { return data.has_gear_ratio[j]; });
  return can_show(known.empty() ? "enough poses for a scan" : "gear ratio known for " + known);
}

void bind_gear_ripple(const EffectEntry& entry, const ConstantsSource&, format::Effect& out) {
  out.constants = {number_option(entry, OptionKey::kCyclesPerTurn, 0.0)};
}

std::string gear_ripple_infix(const format::Effect& effect) {
  return fmt::format(".k{:g}", effect.constants[0]);
}

constexpr EffectDescriptor kGearRippleDescriptor{
    .name = effects::GearRipple::kInfo.name,
    .law = &effects::GearRipple::kInfo,
    .explanation =
        "The same at k cycles per joint turn, k from 0.5 to 40 and not always whole: tooth "
        "engagement, wave generator. Some arms show 300 urad. Needs: gear ratio or enough poses "
        "for a scan; a regular grid of poses can hide it.",
    .options = kGearRippleOptions,
    .joints = JointList::kSet,
    .testable = gear_ripple_testable,
    .measure =
        "150 poses not on a grid, or one joint swept alone in small uneven steps; gear_ratio",
    .sentence = "the gear of {0} turns unevenly, {2}",
    .search = Search::kWaves,
    .turns_listed_joint_only = true,
    .cause = Cause::kUnevenGear,
    .joints_apart = true,
    .bind = bind_gear_ripple,
    .parameter_infix = gear_ripple_infix,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::GearRipple) { return kGearRippleDescriptor; }

}  // namespace plumb::offline
