// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/tool_sag.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr double kTippedLever_m = 1e-3;  // least change of the lever of gravity that counts

Testability tool_sag_testable(const DataSense& data) {
  // The tool sags differently only if it is tipped against gravity.
  if (data.lever_m.back() < kTippedLever_m && loaded_joints(data).empty())
    return cannot_show("the tool is never tipped");
  if (data.payload_span_kg > 0.0) return can_show("the payload varies");
  return data.has_payload
             ? can_show("payload known, the tool is tipped")
             : can_show_weakly("payload unknown, so only its product with the softness");
}

constexpr EffectDescriptor kToolSagDescriptor{
    .name = effects::ToolSag::kInfo.name,
    .law = &effects::ToolSag::kInfo,
    .explanation =
        "The tool sags under its weight: displacement = C (R^T g) m. Typical: 1 to 50 um. Needs: "
        "payload.",
    .joints = JointList::kNone,
    .testable = tool_sag_testable,
    .measure = "poses with the tool up, down and sideways; payload_kg",
    .sentence = "the tool sags under its weight",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kNone,

};

}  // namespace

const EffectDescriptor& law_descriptor(effects::ToolSag) { return kToolSagDescriptor; }

}  // namespace plumb::offline
