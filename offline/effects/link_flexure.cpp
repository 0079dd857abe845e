// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/link_flexure.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability link_flexure_testable(const DataSense& data) {
  if (loaded_joints(data).empty()) return cannot_show("the load of no link varies");
  if (data.payload_span_kg > 0.0) return can_show("the payload varies");
  return can_show_weakly("at one payload bending links look much like compliant joints");
}

constexpr EffectDescriptor kLinkFlexureDescriptor{
    .name = effects::LinkFlexure::kInfo.name,
    .law = &effects::LinkFlexure::kInfo,
    .explanation =
        "A link bends like a cantilever under force and moment at its end, and under its own "
        "weight; usually 5 to 30 % of the joint compliance. Needs: masses, payload; EI, GJ and "
        "length help.",
    .joints = JointList::kSet,
    .testable = link_flexure_testable,
    .measure = "the same poses with and without payload (payload_kg)",
    .sentence = "the links of {0} bend under their load",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .stated_size = StatedSize::kLinkStiffness,
    .group_share = 1.5,
    .joints_apart = true,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::LinkFlexure) { return kLinkFlexureDescriptor; }

}  // namespace plumb::offline
