// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/reversal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr double kDefaultTransition_rad = 0.01;
constexpr double kBothWays = 0.2;  // share of the rarer direction
constexpr double kTransitions_deg[] = {0.05, 0.2, 0.6, 2.0};

constexpr EffectOption kReversalOptions[] = {{
    .key = OptionKey::kTransition,
    .rule = "a number from 0 to 360",
    .example = "0.5",
    .least = 0.0,
    .most = 360.0,
    .credible_least = 0.0,
    .credible_most = 30.0,
    .credible_help = "a gear turns over within a degree or so",
}};

constexpr GridAxis kReversalGrid[] = {{.key = OptionKey::kTransition, .values = kTransitions_deg}};

/// Beyond three degrees it is no friction.
constexpr Refinement kReversalRefinement{.key = OptionKey::kTransition, .most = 3.0};

Testability reversal_testable(const DataSense& data) {
  if (joint_list(data, [&](int j) { return data.both_ways[j] >= 0.0; }).empty())
    return cannot_show(data.ordered ? "no dir_jN columns"
                                    : "nothing says from which side the joints arrived");
  const std::string both = joint_list(data, [&](int j) { return data.both_ways[j] >= kBothWays; });
  const std::string one = joint_list(data, [&](int j) { return data.both_ways[j] < kBothWays; });
  if (both.empty()) return cannot_show("every joint arrives from one side only");
  const std::string why =
      fmt::format("{} arrive from both sides", both) + except_joints(one, "from one side only");
  const std::string travel = joint_list(data, [&](int j) { return data.has_travel[j]; });
  return travel.empty() ? can_show_weakly(why + "; no travel_jN columns") : can_show(why);
}

void bind_reversal(const EffectEntry& entry, const ConstantsSource& source, format::Effect& out) {
  const double transition_deg =
      number_option(entry, OptionKey::kTransition, kDefaultTransition_rad * 180 / M_PI);
  out.constants = {transition_deg * M_PI / 180};
  out.context = {{format::ContextInput::kDirection, "", 0.0}};
  if (!source.has_direction())
    refuse_effect(
        entry, "needs the direction from which each joint came",
        "columns dir_j1 …; if the rows are consecutive moves: plumb import --dir from-order");
}

constexpr EffectDescriptor kReversalDescriptor{
    .name = effects::Reversal::kInfo.name,
    .law = &effects::Reversal::kInfo,
    .explanation =
        "The joint stops short of where it came from: dq = -h sign(d)(1 - exp(-|travel|/q_c)). "
        "Typical: 30 to 300 urad. It runs ahead instead, h below 0, where the controller "
        "compensates more backlash than the joint has. Needs: columns dir_jN and travel_jN, or "
        "rows in order of moving.",
    .options = kReversalOptions,
    .joints = JointList::kSet,
    .testable = reversal_testable,
    .measure = "each pose from the + and the - side, with dir_jN (import --dir from-order)",
    .sentence = "{0} stop{1} short of the place, depending on the side it came from",
    .negative_sentence = "{0} {3} over-compensated on reversal",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .grid = kReversalGrid,
    .refinement = &kReversalRefinement,
    .turns_listed_joint_only = true,
    .once_a_joint = true,
    .joints_apart = true,
    .bind = bind_reversal,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::Reversal) { return kReversalDescriptor; }

}  // namespace plumb::offline
