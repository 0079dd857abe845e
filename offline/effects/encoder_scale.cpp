// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/encoder_scale.hpp"

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability encoder_scale_testable(const DataSense& data) {
  const std::string slides = long_slides(data);
  if (joints_within(data, 1e-2) == joint_list(data, [](int) { return true; }))
    return slides.empty() ? cannot_show("no joint moves") : can_show(slides + " travel far enough");
  const std::string narrow = joints_within(data, kWideRange_rad);
  if (narrow.empty()) return can_show("every joint moves by more than 60 deg");
  return can_show_weakly("small range" + except_joints(narrow, "it moves by less than 60 deg"));
}

/// A screw, rack or belt is off by 20 to 100 um a metre.
constexpr AtSlide kEncoderScaleAtSlide{
    .unit = "1",
    .typical = 50e-6,
    .sentence = "the scale of {0} is wrong: its screw, rack, belt or linear encoder"};

constexpr EffectDescriptor kEncoderScaleDescriptor{
    .name = effects::EncoderScale::kInfo.name,
    .law = &effects::EncoderScale::kInfo,
    .explanation =
        "The encoder counts too much or too little: dq = s q, s of 1e-5 to 1e-4. Of a joint that "
        "slides: the pitch of its screw, rack or belt, or its linear encoder, 20 to 100 um a "
        "metre. Where the arm has one such joint, the scale of the tracker looks the same. Needs: "
        "poses at both ends of the range.",
    .joints = JointList::kSet,
    .testable = encoder_scale_testable,
    .measure = "each joint near both of its limits",
    .sentence = "the encoder of {0} counts too much or too little",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .at_slide = &kEncoderScaleAtSlide,
    .turns_listed_joint_only = true,
    .group_share = 0.3,
    .joints_apart = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::EncoderScale) { return kEncoderScaleDescriptor; }

}  // namespace plumb::offline
