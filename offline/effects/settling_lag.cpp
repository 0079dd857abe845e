// SPDX-License-Identifier: Apache-2.0
#include "effects/measurement/settling_lag.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability settling_lag_testable(const DataSense& data) {
  if (!data.ordered) return cannot_show("the order of the rows is not known");
  return data.poses < kFewPoses ? can_show_weakly(poses_text(data)) : can_show("rows in order");
}

constexpr EffectDescriptor kSettlingLagDescriptor{
    .name = effects::SettlingLag::kInfo.name,
    .law = &effects::SettlingLag::kInfo,
    .explanation =
        "Joints were read before the arm stood still: dq in proportion to the last step's share. "
        "Belongs to the procedure: it cleans the fit and is not compiled. Needs: order of poses.",
    .joints = JointList::kSet,
    .testable = settling_lag_testable,
    .measure = "rows in the order of measuring with t_s; some poses again after a wait",
    .sentence = "{0} had not yet come to rest when the joints were read",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .turns_listed_joint_only = true,
    .joints_apart = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::SettlingLag) { return kSettlingLagDescriptor; }

}  // namespace plumb::offline
