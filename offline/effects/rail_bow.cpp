// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/rail_bow.hpp"

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability rail_bow_testable(const DataSense& data) {
  if (all_joint_list(data, [&](int j) { return !data.turns[j]; }).empty())
    return cannot_show("no joint slides");
  const std::string slides = long_slides(data);
  if (slides.empty()) return cannot_show("no joint slides by 100 mm");
  if (data.poses < kFewPoses) return cannot_show(poses_text(data));
  return data.poses < kManyPoses ? can_show_weakly(poses_text(data))
                                 : can_show(slides + " travel far enough");
}

void bind_rail_bow(const EffectEntry&, const ConstantsSource& source, format::Effect& out) {
  for (const int joint : out.joints) {
    const ConstantsSource::Span travel = source.travel(joint);
    const double half = 0.5 * (travel.last - travel.first);
    out.constants.push_back(0.5 * (travel.first + travel.last));
    out.constants.push_back(half > 0.0 ? half : 1.0);
  }
}

constexpr EffectDescriptor kRailBowDescriptor{
    .name = effects::RailBow::kInfo.name,
    .law = &effects::RailBow::kInfo,
    .explanation =
        "A rail is not straight: what slides on it shifts sideways and turns along the travel. A "
        "series over the measured travel: shifts dx, dy of second and third order, turns e of "
        "first and second, in the axes of the joint, z along the rail. What is constant or, of "
        "the shifts, in proportion to the travel is geometry. Typical: 20 to 200 um, 20 to 200 "
        "urad. Needs: poses over the whole travel, with the arm in different poses.",
    .joints = JointList::kSliding,
    .testable = rail_bow_testable,
    .measure = "150 poses over the whole travel of the joint that slides",
    .sentence = "the rail of {0} is not straight",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kSliding,
    .joints_apart = true,
    .bind = bind_rail_bow,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::RailBow) { return kRailBowDescriptor; }

}  // namespace plumb::offline
