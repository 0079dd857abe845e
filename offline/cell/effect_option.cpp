// SPDX-License-Identifier: Apache-2.0
#include "cell/effect_option.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "plumb/runtime/effect_library.hpp"

namespace plumb::offline {
namespace {

using Takes = EffectOption::Takes;

constexpr const char* kForms[] = {"blended", "crisp"};
constexpr const char* kSplits[] = {"shared", "own"};
constexpr const char* kMoved[] = {"tool", "base", "joint"};
constexpr double kMostCycles = 1e5;  // a motor turn has hundreds, its poles and slots thousands
constexpr double kMostRatio = 10.0;  // a spring ten times as long as its lever hangs elsewhere
constexpr double kColdest_degC = -273.15;

constexpr EffectOption kOptions[] = {
    {.effect = "gear_ripple",
     .key = "cycles_per_turn",
     .rule = "a number greater than 0, at most 100000",
     .example = "20",
     .above = 0.0,
     .most = kMostCycles,
     .required = true,
     .lists = true},
    {.effect = "joint_compliance_soft",
     .key = "torque_Nm",
     .rule = "a number greater than 0",
     .example = "50",
     .above = 0.0},
    {.effect = "backlash_load",
     .key = "torque_Nm",
     .rule = "a number greater than 0",
     .example = "50",
     .above = 0.0},
    {.effect = "reversal",
     .key = "transition_deg",
     .rule = "a number from 0 to 360",
     .example = "0.5",
     .least = 0.0,
     .most = 360.0},
    {.effect = "drift",
     .key = "settling_s",
     .rule = "a number greater than 0",
     .example = "1800",
     .above = 0.0},
    {.effect = "thermal_growth",
     .key = "sensor",
     .takes = Takes::kText,
     .rule = "the name of a temperature column",
     .example = "temp"},
    {.effect = "thermal_growth",
     .key = "reference_degC",
     .rule = "a number above absolute zero",
     .example = "20",
     .above = kColdest_degC},
    {.effect = "step",
     .key = "after_row",
     .takes = Takes::kWhole,
     .rule = "a whole number of 1 or more: the last row before it",
     .example = "84",
     .least = 1.0,
     .required = true,
     .lists = true},
    {.effect = "step",
     .key = "of",
     .takes = Takes::kWord,
     .rule = "\"tool\", \"base\" or \"joint\"",
     .example = "tool",
     .words = kMoved},
    {.effect = "gravity_compensator",
     .key = "length_ratio",
     .rule = "a number from 0 to 10",
     .example = "0.5",
     .least = 0.0,
     .most = kMostRatio},
    {.effect = "gravity_compensator",
     .key = "anchor_ratio",
     .rule = "a number greater than 0, at most 10",
     .example = "0.5",
     .above = 0.0,
     .most = kMostRatio},
    {.effect = "local_tree",
     .key = "min_gain",
     .takes = Takes::kShare,
     .rule = "a share like \"2%\" or 0.02",
     .example = "2%"},
    {.effect = "local_tree",
     .key = "form",
     .takes = Takes::kWord,
     .rule = "\"blended\" or \"crisp\"",
     .example = "crisp",
     .words = kForms},
    {.effect = "local_tree",
     .key = "splits",
     .takes = Takes::kWord,
     .rule = "\"shared\" or \"own\"",
     .example = "own",
     .words = kSplits},
    {.effect = "local_tree",
     .key = "degree",
     .takes = Takes::kWhole,
     .rule = "1 (affine leaves) or 2 (quadratic ones too)",
     .example = "2",
     .least = 1.0,
     .most = 2.0},
};

bool is_text(const EffectOption& option) {
  return option.takes == Takes::kText || option.takes == Takes::kWord;
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::vector<const EffectOption*> options_of(std::string_view effect) {
  std::vector<const EffectOption*> out;
  for (const auto& option : kOptions)
    if (option.effect == effect) out.push_back(&option);
  return out;
}

const EffectOption* find_option(std::string_view effect, std::string_view key) {
  for (const auto& option : kOptions)
    if (option.effect == effect && option.key == key) return &option;
  return nullptr;
}

bool makes_sense(const EffectOption& option, double value) {
  if (is_text(option) || !std::isfinite(value)) return false;
  if (option.takes == Takes::kShare) return value >= 0.0 && value < 1.0;
  if (option.takes == Takes::kWhole && value != std::floor(value)) return false;
  return value > option.above && value >= option.least && value <= option.most;
}

bool makes_sense(const EffectOption& option, const std::string& text) {
  if (option.takes == Takes::kText) return !text.empty();
  return option.takes == Takes::kWord &&
         std::find(option.words.begin(), option.words.end(), text) != option.words.end();
}

std::optional<EffectEntry::Value> option_value(const EffectOption& option,
                                               const std::string& text) {
  if (is_text(option))
    return makes_sense(option, text) ? std::optional<EffectEntry::Value>(text) : std::nullopt;
  auto number = number_of(text);
  if (!number && option.takes == Takes::kShare) number = parse_percent(text);
  if (!number || !makes_sense(option, *number)) return std::nullopt;
  return *number;
}

void fill_in_usual(EffectEntry& entry) {
  if (entry.name == "step") entry.options.try_emplace("of", std::string("tool"));
}

std::string joints_fault(const EffectEntry& entry) {
  const auto& joints = entry.joints;
  const std::set<int> different(joints.begin(), joints.end());
  if (entry.name == "cross_compliance")
    return joints.size() == 2 && different.size() == 2
               ? ""
               : "needs two joints: the one that yields, then the one whose torque it yields to";
  if (different.size() != joints.size()) return "names a joint twice";
  if (entry.name == "step") {
    const auto of = entry.options.find("of");
    const bool joint =
        of != entry.options.end() && of->second == EffectEntry::Value(std::string("joint"));
    if (joint) return joints.size() == 1 ? "" : "of = \"joint\" needs the one joint that slipped";
    return joints.empty() ? "" : "takes a joint only with of = \"joint\"";
  }
  const int law = find_effect_law(entry.name);
  const bool takes_joints = law >= 0 && effect_info(law).per_joint;
  return joints.empty() || takes_joints ? "" : "takes no joints";
}

}  // namespace plumb::offline
