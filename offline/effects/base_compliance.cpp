// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/base_compliance.hpp"

#include <algorithm>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability base_compliance_testable(const DataSense& data) {
  double lever = 0.0;
  for (const double l : data.lever_m) lever = std::max(lever, l);
  if (lever < kLever_m) return cannot_show("the moment on the base does not vary");
  return data.has_masses || data.payload_span_kg > 0.0
             ? can_show("the moment on the base varies with the pose")
             : can_show_weakly("masses unknown; it looks much like compliance of the first joints");
}

constexpr EffectDescriptor kBaseComplianceDescriptor{
    .name = effects::BaseCompliance::kInfo.name,
    .law = &effects::BaseCompliance::kInfo,
    .explanation =
        "The base tilts under the arm's moment: rotation = M0 / K. Typical: 1e-9 to 1e-6 rad/(N "
        "m). Needs: masses.",
    .joints = JointList::kNone,
    .testable = base_compliance_testable,
    .measure = "poses stretched to all sides; masses in cell.toml or two payloads",
    .sentence = "the base tilts under the moment of the arm",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kNone,

};

}  // namespace

const EffectDescriptor& law_descriptor(effects::BaseCompliance) {
  return kBaseComplianceDescriptor;
}

}  // namespace plumb::offline
