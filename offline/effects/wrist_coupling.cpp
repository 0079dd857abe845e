// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/wrist_coupling.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability wrist_coupling_testable(const DataSense& data) {
  if (data.joints() < 6) return cannot_show("the arm has no three-joint wrist");
  for (int j = 3; j < 6; ++j)
    if (data.range[j] < kWideRange_rad)
      return cannot_show(data.names[j] + " moves by less than 60 deg");
  return can_show("all three wrist joints move");
}

constexpr EffectDescriptor kWristCouplingDescriptor{
    .name = effects::WristCoupling::kInfo.name,
    .law = &effects::WristCoupling::kInfo,
    .explanation =
        "Turning one wrist joint turns the next through their common gears: dq5 = k45 q4, dq6 = "
        "k46 q4 + k56 q5. Typical: 1e-5 to 1e-3.",
    .joints = JointList::kNone,
    .testable = wrist_coupling_testable,
    .measure = "poses that move each wrist joint by more than 60 deg",
    .sentence = "turning one wrist joint turns the next",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kNone,

};

}  // namespace

const EffectDescriptor& law_descriptor(effects::WristCoupling) { return kWristCouplingDescriptor; }

}  // namespace plumb::offline
