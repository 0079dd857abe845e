// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/encoder_eccentricity.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability encoder_eccentricity_testable(const DataSense& data) {
  Testability harmonics = harmonics_testable(data);
  if (harmonics.answer == Testability::Answer::kNo) return harmonics;
  return can_show_weakly("the same as the first harmonic: one of the two");
}

constexpr EffectDescriptor kEncoderEccentricityDescriptor{
    .name = effects::EncoderEccentricity::kInfo.name,
    .law = &effects::EncoderEccentricity::kInfo,
    .explanation =
        "The code disc runs off centre: dq = atan2(e sin a, 1 + e cos a). To first order the "
        "same as the first harmonic: the two cannot be told apart. Typical: 100 urad.",
    .joints = JointList::kSet,
    .testable = encoder_eccentricity_testable,
    .measure = "each joint over at least half a turn, 40 poses",
    .sentence = "the code disc of {0} runs off centre",
    .search = Search::kNever,
    .turns_listed_joint_only = true,
    .joints_apart = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::EncoderEccentricity) {
  return kEncoderEccentricityDescriptor;
}

}  // namespace plumb::offline
