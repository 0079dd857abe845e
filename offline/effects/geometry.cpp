// SPDX-License-Identifier: Apache-2.0
#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr int kFewestPoses = 10;  // chosen: 30 coordinates for about 30 numbers

Testability geometry_testable(const DataSense& data) {
  if (data.poses < kFewestPoses) return cannot_show(poses_text(data));
  if (data.poses < kFewPoses) return can_show_weakly(poses_text(data));
  return can_show(poses_text(data));
}

constexpr EffectDescriptor kGeometryDescriptor{
    .name = "geometry",
    .explanation =
        "Constant errors of the links: DH parameters, with Hayati's beta where neighbouring axes "
        "are near parallel, or six small motions per link. Fitted as the subset that the poses "
        "can tell apart. Typical: 0.5 mm, 0.5 mrad. Needs: nothing but poses. Always listed "
        "first.",
    .joints = JointList::kNone,
    .testable = geometry_testable,
    .measure = "at least 50 poses all over the joint limits",
    .search = Search::kNever,

};

}  // namespace

const EffectDescriptor& geometry_descriptor() { return kGeometryDescriptor; }

}  // namespace plumb::offline
