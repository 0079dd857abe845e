// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/axis_wobble.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability axis_wobble_testable(const DataSense& data) {
  Testability harmonics = harmonics_testable(data);
  if (harmonics.answer == Testability::Answer::kNo) return harmonics;
  return data.poses < kManyPoses ? can_show_weakly(poses_text(data)) : harmonics;
}

constexpr EffectDescriptor kAxisWobbleDescriptor{
    .name = effects::AxisWobble::kInfo.name,
    .law = &effects::AxisWobble::kInfo,
    .explanation =
        "The joint's axis tilts and shifts once and twice a turn: bearing run-out. Typical: 10 "
        "to 50 urad, 2 to 20 um. Needs: poses over the joint's range.",
    .joints = JointList::kSet,
    .testable = axis_wobble_testable,
    .measure = "150 poses, each joint over at least half a turn",
    .sentence = "the axis of {0} wobbles as it turns",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .joints_apart = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::AxisWobble) { return kAxisWobbleDescriptor; }

}  // namespace plumb::offline
