// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/joint_compliance_soft.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"
#include "effects/torque_constant.hpp"

namespace plumb::offline {
namespace {

Testability joint_compliance_soft_testable(const DataSense& data) {
  Testability linear = compliance_testable(data);
  if (linear.answer == Testability::Answer::kNo || data.payload_span_kg > 0.0) return linear;
  return can_show_weakly("at one payload a soft start looks like plain compliance");
}

constexpr EffectDescriptor kJointComplianceSoftDescriptor{
    .name = effects::JointComplianceSoft::kInfo.name,
    .law = &effects::JointComplianceSoft::kInfo,
    .explanation =
        "Joint compliance with a soft start: dq = tau/K + D0 (1 - exp(-|tau|/tau1)) sign(tau). "
        "Gears yield most while the load is small. Needs: as joint_compliance.",
    .options = kTorqueOptions,
    .joints = JointList::kSet,
    .testable = joint_compliance_soft_testable,
    .measure = "the same poses with two payloads (payload_kg)",
    .sentence = "{0} yield{1} under load, most while the load is small",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .grid = kTorqueGrid,
    .refinement = &kTorqueRefinement,
    .turns_listed_joint_only = true,
    .once_a_joint = true,
    .cause = Cause::kYieldingJoint,
    .stated_size = StatedSize::kJointStiffness,
    .joints_apart = true,
    .bind = bind_torque_constant,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::JointComplianceSoft) {
  return kJointComplianceSoftDescriptor;
}

}  // namespace plumb::offline
