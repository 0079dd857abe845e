// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/pitch_error.hpp"

#include <fmt/format.h>

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr EffectOption kPitchErrorOptions[] = {{
    .key = OptionKey::kPitch_mm,
    .rule = "a number greater than 0, at most 10000",
    .example = "20",
    .above = 0.0,
    .most = 10000.0,
    .required = true,
    .lists = true,
}};

/// The pitches of the scan, as shares of the travel, from the coarsest to the finest. Chosen:
/// finer pitches have more periods over the travel than a scan can tell apart in a reasonable time.
constexpr double kPitchShares[] = {1.0 / 2.0, 1.0 / 150.0};
constexpr GridAxis kPitchErrorGrid[] = {
    {.key = OptionKey::kPitch_mm, .kind = GridAxis::Values::kPitches, .values = kPitchShares}};
constexpr Refinement kPitchErrorRefinement{
    .key = OptionKey::kPitch_mm, .of_travel = true, .most = 10000.0};

Testability pitch_error_testable(const DataSense& data) {
  if (all_joint_list(data, [&](int j) { return !data.turns[j]; }).empty())
    return cannot_show("no joint slides");
  const std::string slides = long_slides(data);
  if (slides.empty()) return cannot_show("no joint slides by 100 mm");
  if (data.poses < kFewPoses) return cannot_show(poses_text(data));
  return data.poses < kManyPoses
             ? can_show_weakly(poses_text(data) + " for a scan over many pitches")
             : can_show(slides + " travel far enough");
}

void bind_pitch_error(const EffectEntry& entry, const ConstantsSource&, format::Effect& out) {
  out.constants = {number_option(entry, OptionKey::kPitch_mm, 0.0) * 1e-3};
}

std::string pitch_error_infix(const format::Effect& effect) {
  return fmt::format(".p{:.5g}", effect.constants[0] * 1e3);
}

constexpr EffectDescriptor kPitchErrorDescriptor{
    .name = effects::PitchError::kInfo.name,
    .law = &effects::PitchError::kInfo,
    .explanation =
        "A joint that slides errs periodically along its travel, once and twice a pitch: a screw "
        "that wobbles, the teeth of a rack, a pinion or pulley beside its axis, the marks of a "
        "scale. Typical: 5 to 50 um. Needs: the pitch, or enough poses for a scan over pitches "
        "from half of the travel to a 150th of it.",
    .options = kPitchErrorOptions,
    .joints = JointList::kSliding,
    .testable = pitch_error_testable,
    .measure = "150 poses not on a grid, over the whole travel of the joint that slides",
    .sentence = "the position of {0} errs periodically, every {6} mm",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kSliding,
    .grid = kPitchErrorGrid,
    .refinement = &kPitchErrorRefinement,
    .turns_listed_joint_only = true,
    .joints_apart = true,
    .bind = bind_pitch_error,
    .parameter_infix = pitch_error_infix,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::PitchError) { return kPitchErrorDescriptor; }

}  // namespace plumb::offline
