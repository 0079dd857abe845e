// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/cross_compliance.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability cross_compliance_testable(const DataSense& data) {
  const Testability own = compliance_testable(data);
  return own.answer == Testability::Answer::kYes && !data.has_masses
             ? can_show_weakly("masses unknown")
             : own;
}

constexpr EffectDescriptor kCrossComplianceDescriptor{
    .name = effects::CrossCompliance::kInfo.name,
    .law = &effects::CrossCompliance::kInfo,
    .explanation = "One joint yields under the torque of another: dq_i = c tau_j. Needs: masses.",
    .joints = JointList::kOrderedPair,
    .pair = "the one that yields, then the one whose torque it yields to",
    .testable = cross_compliance_testable,
    .measure = "masses in cell.toml, or two payloads",
    .sentence = "a joint yields under the torque of another ({0})",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kLoadedPairs,
    .turns_listed_joint_only = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::CrossCompliance) {
  return kCrossComplianceDescriptor;
}

}  // namespace plumb::offline
