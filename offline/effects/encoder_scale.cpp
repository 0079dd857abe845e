// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/encoder_scale.hpp"

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability encoder_scale_testable(const DataSense& data) {
  if (joints_within(data, 1e-2) == joint_list(data, [](int) { return true; }))
    return cannot_show("no joint moves");
  const std::string narrow = joints_within(data, kWideRange_rad);
  if (narrow.empty()) return can_show("every joint moves by more than 60 deg");
  return can_show_weakly("small range" + except_joints(narrow, "it moves by less than 60 deg"));
}

constexpr EffectDescriptor kEncoderScaleDescriptor{
    .name = effects::EncoderScale::kInfo.name,
    .law = &effects::EncoderScale::kInfo,
    .explanation =
        "The encoder counts too much or too little: dq = s q, s of 1e-5 to 1e-4. Needs: poses at "
        "both ends of the range.",
    .joints = JointList::kSet,
    .testable = encoder_scale_testable,
    .measure = "each joint near both of its limits",
    .sentence = "the encoder of {0} counts too much or too little",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .turns_listed_joint_only = true,
    .joints_apart = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::EncoderScale) { return kEncoderScaleDescriptor; }

}  // namespace plumb::offline
