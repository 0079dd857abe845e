// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/drive_coupling.hpp"

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability drive_coupling_testable(const DataSense& data) {
  const std::string wide = joint_list(data, [&](int j) { return data.range[j] >= kWideRange_rad; });
  if (data.joints() < 2) return cannot_show("the arm has one joint");
  if (wide.empty()) return cannot_show("no joint turns by 60 deg");
  if (data.poses < kFewPoses) return can_show_weakly(poses_text(data));
  return can_show(wide + " turn far enough to drive others");
}

constexpr EffectDescriptor kDriveCouplingDescriptor{
    .name = effects::DriveCoupling::kInfo.name,
    .law = &effects::DriveCoupling::kInfo,
    .explanation =
        "The drive of one joint moves another one too: dq_i = c q_j. Parallelograms of "
        "palletisers, gears of a hollow wrist, and the screw and spline of a SCARA do, where the "
        "controller takes out a little too much or too little of it. c of 1e-5 to 1e-3; m/rad "
        "where joint i slides and joint j turns. Needs: poses that move both joints "
        "independently.",
    .joints = JointList::kOrderedPair,
    .pair = "the one that is moved, then the one whose drive moves it",
    .testable = drive_coupling_testable,
    .measure = "poses that turn each joint by more than 60 deg, independently of its neighbours",
    .sentence = "{4} moves by a share of the angle of {5}",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kNeighbours,
    .turns_listed_joint_only = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::DriveCoupling) { return kDriveCouplingDescriptor; }

}  // namespace plumb::offline
