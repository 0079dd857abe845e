// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/wrench_compliance.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability wrench_compliance_testable(const DataSense& data) {
  return data.has_wrench ? can_show("forces are recorded")
                         : cannot_show("no columns of force or torque");
}

constexpr EffectDescriptor kWrenchComplianceDescriptor{
    .name = effects::WrenchCompliance::kInfo.name,
    .law = &effects::WrenchCompliance::kInfo,
    .explanation =
        "Joints yield under a force at the tool: dq = c J^T W. Needs: columns of force and "
        "torque.",
    .joints = JointList::kSet,
    .testable = wrench_compliance_testable,
    .measure = "the same poses pulled at with known forces",
    .sentence = "{0} yield{1} under the force at the tool",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .turns_listed_joint_only = true,
    .joints_apart = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::WrenchCompliance) {
  return kWrenchComplianceDescriptor;
}

}  // namespace plumb::offline
