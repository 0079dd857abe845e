// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/reversal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

/// Travel after a turn until the other flank is loaded, if the cell does not state it; and the
/// values that a scan tries. Chosen.
constexpr double kDefaultTransition_rad = 0.01;
constexpr double kDefaultTransition_m = 1e-3;
constexpr double kBothWays = 0.2;  // share of the rarer direction
constexpr double kTransitions_deg[] = {0.05, 0.2, 0.6, 2.0};
constexpr double kTransitions_mm[] = {0.1, 0.5, 2.0, 8.0};

constexpr EffectOption kReversalOptions[] = {
    {.key = OptionKey::kTransition,
     .rule = "a number from 0 to 360",
     .example = "0.5",
     .least = 0.0,
     .most = 360.0,
     .credible_least = 0.0,
     .credible_most = 30.0,
     .credible_help = "a gear turns over within a degree or so"},
    {.key = OptionKey::kTransition_mm,
     .rule = "a number from 0 to 1000",
     .example = "1",
     .least = 0.0,
     .most = 1000.0,
     .credible_least = 0.0,
     .credible_most = 100.0,
     .credible_help = "a screw, rack or belt turns over within some millimetres"},
};

constexpr GridAxis kReversalGrid[] = {{.key = OptionKey::kTransition, .values = kTransitions_deg}};

constexpr GridAxis kReversalSlideGrid[] = {
    {.key = OptionKey::kTransition_mm, .values = kTransitions_mm}};

/// Beyond three degrees, or 20 mm, it is no friction.
constexpr Refinement kReversalRefinement{.key = OptionKey::kTransition, .most = 3.0};
constexpr Refinement kReversalSlideRefinement{.key = OptionKey::kTransition_mm, .most = 20.0};

constexpr AtSlide kReversalAtSlide{
    .unit = "m",
    .typical = 20e-6,
    .sentence = "{0} stop{1} short of the place by its play, depending on the side it came from",
    .negative_sentence = "{0} {3} over-compensated on reversal",
    .grid = kReversalSlideGrid,
    .refinement = &kReversalSlideRefinement};

Testability reversal_testable(const DataSense& data) {
  if (all_joint_list(data, [&](int j) { return data.both_ways[j] >= 0.0; }).empty())
    return cannot_show(data.ordered ? "no dir_jN columns"
                                    : "nothing says from which side the joints arrived");
  const std::string both =
      all_joint_list(data, [&](int j) { return data.both_ways[j] >= kBothWays; });
  const std::string one =
      all_joint_list(data, [&](int j) { return data.both_ways[j] < kBothWays; });
  if (both.empty()) return cannot_show("every joint arrives from one side only");
  const std::string why =
      fmt::format("{} arrive from both sides", both) + except_joints(one, "from one side only");
  const std::string travel = all_joint_list(data, [&](int j) { return data.has_travel[j]; });
  return travel.empty() ? can_show_weakly(why + "; no travel_jN columns") : can_show(why);
}

/// The transition of the entry [rad], or [m] of joints that slide.
double transition_of(const EffectEntry& entry, const ConstantsSource& source) {
  const bool sliding = std::any_of(entry.joints.begin(), entry.joints.end(),
                                   [&](int joint) { return source.slides(joint); });
  if (sliding && !std::all_of(entry.joints.begin(), entry.joints.end(),
                              [&](int joint) { return source.slides(joint); }))
    refuse_effect(entry, "lists joints that turn and joints that slide",
                  "give each kind an entry of its own: [[effects.reversal]]");
  const OptionKey other = sliding ? OptionKey::kTransition : OptionKey::kTransition_mm;
  if (has_option(entry, other))
    refuse_effect(
        entry,
        fmt::format("states {}, but its joints {}", option_name(other), sliding ? "slide" : "turn"),
        fmt::format("state {} instead",
                    option_name(sliding ? OptionKey::kTransition_mm : OptionKey::kTransition)));
  if (sliding)
    return number_option(entry, OptionKey::kTransition_mm, kDefaultTransition_m * 1e3) * 1e-3;
  const double usual_deg = kDefaultTransition_rad * 180 / M_PI;
  return number_option(entry, OptionKey::kTransition, usual_deg) * M_PI / 180;
}

void bind_reversal(const EffectEntry& entry, const ConstantsSource& source, format::Effect& out) {
  out.constants = {transition_of(entry, source)};
  out.context = {{format::ContextInput::kDirection, "", 0.0}};
  if (!source.has_direction())
    refuse_effect(
        entry, "needs the direction from which each joint came",
        "columns dir_j1 …; if the rows are consecutive moves: plumb import --dir from-order");
}

constexpr LaterChange kReversalLater{
    .chance = 0.2,
    .words = "the backlash of {}",
    .sentence = "the backlash of {0} is now {2} instead of {1} {3}"};

constexpr EffectDescriptor kReversalDescriptor{
    .name = effects::Reversal::kInfo.name,
    .law = &effects::Reversal::kInfo,
    .explanation =
        "The joint stops short of where it came from: dq = -h sign(d)(1 - exp(-|travel|/q_c)). "
        "Typical: 30 to 300 urad, or 5 to 100 um of play where it slides. It runs ahead instead, h "
        "below 0, where the controller "
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
    .at_slide = &kReversalAtSlide,
    .turns_listed_joint_only = true,
    .once_a_joint = true,
    .joints_apart = true,
    .later_change = &kReversalLater,
    .bind = bind_reversal,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::Reversal) { return kReversalDescriptor; }

}  // namespace plumb::offline
