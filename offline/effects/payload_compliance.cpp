// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/payload_compliance.hpp"

#include <fmt/format.h>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

Testability payload_compliance_testable(const DataSense& data) {
  if (data.payload_span_kg > 0.0)
    return can_show(fmt::format("payload varies by {:.1f} kg", data.payload_span_kg));
  return cannot_show(data.has_payload ? "one payload only" : "no payload column");
}

constexpr EffectDescriptor kPayloadComplianceDescriptor{
    .name = effects::PayloadCompliance::kInfo.name,
    .law = &effects::PayloadCompliance::kInfo,
    .explanation =
        "Joints yield under the payload alone: dq = c J^T W. Needs: a payload that varies.",
    .joints = JointList::kSet,
    .testable = payload_compliance_testable,
    .measure = "the same poses with at least two payloads (payload_kg)",
    .sentence = "{0} yield{1} under the payload",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .turns_listed_joint_only = true,
    .joints_apart = true,
    .figure = "context-payload",
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::PayloadCompliance) {
  return kPayloadComplianceDescriptor;
}

}  // namespace plumb::offline
