// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/gear_harmonics.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"
#include "plumb/runtime/detail/effects/encoder_eccentricity.hpp"

namespace plumb::offline {
namespace {

/// An eccentric code disc makes a first harmonic.
constexpr std::string_view kHarmonicsSameMotion[] = {effects::EncoderEccentricity::kInfo.name};

constexpr EffectDescriptor kGearHarmonicsDescriptor{
    .name = effects::GearHarmonics::kInfo.name,
    .law = &effects::GearHarmonics::kInfo,
    .explanation =
        "A joint's error repeats once and twice a turn: dq = sum A_h sin(h q + phi_h), h = 1, 2. "
        "Typical: 100 urad. Needs: poses over most of the joint's range.",
    .joints = JointList::kSet,
    .testable = harmonics_testable,
    .measure = "each joint over at least half a turn, 40 poses or more",
    .sentence = "the error of {0} repeats once and twice a turn",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .turns_listed_joint_only = true,
    .cause = Cause::kUnevenGear,
    .group_share = 0.7,
    .joints_apart = true,
    .same_motion = kHarmonicsSameMotion,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::GearHarmonics) { return kGearHarmonicsDescriptor; }

}  // namespace plumb::offline
