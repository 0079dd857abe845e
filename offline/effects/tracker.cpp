// SPDX-License-Identifier: Apache-2.0
#include "effects/measurement/tracker.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability tracker_testable(const DataSense& data) {
  if (!data.positions) return cannot_show("no tracker measured anything");
  if (!data.tracker_frame)
    return can_show_weakly(
        "nothing says that the origin of the points is the tracker (# frame: tracker)");
  return data.poses < kManyPoses ? can_show_weakly(poses_text(data))
                                 : can_show("points in the tracker's own frame");
}

constexpr EffectDescriptor kTrackerDescriptor{
    .name = effects::Tracker::kInfo.name,
    .law = &effects::Tracker::kInfo,
    .explanation =
        "Errors of the instrument: radial offset, scale with range, second harmonic of its "
        "angles. Typical: 30 um, 2e-6/K, 6e-6. Belongs to the measurement. Needs: where the "
        "tracker stands.",
    .joints = JointList::kNone,
    .testable = tracker_testable,
    .measure = "points in the tracker's own frame (# frame: tracker), at several distances",
    .sentence = "the tracker measures with a systematic error",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kNone,
    .prior_width = 1.0,  // its scale can hardly be told from that of the arm
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::Tracker) { return kTrackerDescriptor; }

}  // namespace plumb::offline
