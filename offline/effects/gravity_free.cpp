// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/gravity_free.hpp"

#include <fmt/format.h>

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability gravity_free_testable(const DataSense& data) {
  const std::string loaded = loaded_joints(data);
  if (loaded.empty()) return cannot_show("gravity turns no joint differently from pose to pose");
  return data.poses < kManyPoses
             ? can_show_weakly(poses_text(data) + " for several numbers a joint")
             : can_show(fmt::format("the load of {} varies with the pose", loaded));
}

/// Three components of gravity in the frame of each link that the joint carries.
int gravity_free_parameters(int arm_joints, int joint) { return 3 * (arm_joints - joint); }

std::string gravity_free_parameter_name(int place) { return fmt::format("s{}", place + 1); }

constexpr EffectDescriptor kGravityFreeDescriptor{
    .name = effects::GravityFree::kInfo.name,
    .law = &effects::GravityFree::kInfo,
    .explanation =
        "Gravity torque without known masses: per joint, the components of gravity in the link "
        "frames with free factors, reduced to what can be told apart. A link that bends or a base "
        "that tilts under unknown weights may look the same; diagnose compares them and says so. "
        "Needs: poses in many orientations.",
    .joints = JointList::kSet,
    .testable = gravity_free_testable,
    .measure = "150 poses in many orientations",
    .sentence = "{0} yield{1} under gravity ({7})",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .turns_listed_joint_only = true,
    .cause = Cause::kYieldingJoint,
    .group_share = 0.3,
    .parameters_of_joint = gravity_free_parameters,
    .parameter_name = gravity_free_parameter_name,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::GravityFree) { return kGravityFreeDescriptor; }

}  // namespace plumb::offline
