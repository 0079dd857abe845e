// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/joint_compliance.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr LaterChange kJointComplianceLater{
    .chance = 0.2,
    .words = "the stiffness of {}",
    .sentence = "the stiffness of {0} changed: it now yields {2} instead of {1} {3}"};

constexpr EffectDescriptor kJointComplianceDescriptor{
    .name = effects::JointCompliance::kInfo.name,
    .law = &effects::JointCompliance::kInfo,
    .explanation =
        "A joint turns under its load: dq = c tau, tau being the torque of gravity and payload "
        "about the joint. Heavy arms 1e6 to 4e6 N m/rad, light ones 1e4 to 1e5. Needs: link "
        "masses or the free gravity basis; column payload_kg if the payload varies.",
    .joints = JointList::kSet,
    .testable = compliance_testable,
    .measure = "poses with the arm stretched and folded; the same poses with and without payload",
    .sentence = "{0} yield{1} under load",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .turns_listed_joint_only = true,
    .cause = Cause::kYieldingJoint,
    .stated_size = StatedSize::kJointStiffness,
    .group_share = 0.3,
    .joints_apart = true,
    .later_change = &kJointComplianceLater,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::JointCompliance) {
  return kJointComplianceDescriptor;
}

}  // namespace plumb::offline
