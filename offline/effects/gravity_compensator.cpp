// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/gravity_compensator.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr double kMostRatio = 10.0;  // beyond it the spring is no balancing spring of this joint
constexpr double kUsualRatio = 0.5;  // if the cell states none; the scan tries those below
constexpr double kSpringRatios[] = {0.25, 0.5, 0.8};

constexpr EffectOption kGravityCompensatorOptions[] = {
    {.key = OptionKey::kLengthRatio,
     .rule = "a number from 0 to 10",
     .example = "0.5",
     .least = 0.0,
     .most = kMostRatio},
    {.key = OptionKey::kAnchorRatio,
     .rule = "a number greater than 0, at most 10",
     .example = "0.5",
     .above = 0.0,
     .most = kMostRatio}};

constexpr GridAxis kGravityCompensatorGrid[] = {
    {.key = OptionKey::kLengthRatio, .values = kSpringRatios},
    {.key = OptionKey::kAnchorRatio, .values = kSpringRatios}};

Testability gravity_compensator_testable(const DataSense& data) {
  if (data.joints() < 2 || data.range[1] < kWideRange_rad)
    return cannot_show("the second joint hardly moves");
  return can_show_weakly("depends on q2 alone: inseparable from that joint's harmonics");
}

void bind_gravity_compensator(const EffectEntry& entry, const ConstantsSource&,
                              format::Effect& out) {
  out.constants = {number_option(entry, OptionKey::kLengthRatio, kUsualRatio),
                   number_option(entry, OptionKey::kAnchorRatio, kUsualRatio)};
}

constexpr EffectDescriptor kGravityCompensatorDescriptor{
    .name = effects::GravityCompensator::kInfo.name,
    .law = &effects::GravityCompensator::kInfo,
    .explanation =
        "A spring that carries the second joint. It depends on q2 alone and cannot be told from "
        "that joint's harmonics.",
    .options = kGravityCompensatorOptions,
    .joints = JointList::kSet,
    .testable = gravity_compensator_testable,
    .measure = "the second joint over its whole range",
    .sentence = "the balancing spring of {0} pulls unevenly",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kSecond,
    .grid = kGravityCompensatorGrid,
    .turns_listed_joint_only = true,
    .once_a_joint = true,
    .joints_apart = true,
    .bind = bind_gravity_compensator,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::GravityCompensator) {
  return kGravityCompensatorDescriptor;
}

}  // namespace plumb::offline
