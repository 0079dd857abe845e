// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "arm/effect_binding.hpp"
#include "diagnose/scan.hpp"
#include "effects/registry.hpp"
#include "fit/fit_cell.hpp"
#include "simulate/law.hpp"
#include "tests/blind/answer.hpp"
#include "tests/blind/claims.hpp"
#include "tests/blind/seen.hpp"

namespace plumb::tests {
namespace {

using namespace offline;
constexpr std::uint64_t kTreeEvery = 5;  // cases
constexpr double kShiftWithin = 0.10;

/// The same with a tree that learns what the effects leave.
ArmState fitted_with_tree(const Seen& seen, std::vector<EffectEntry> effects) {
  Cell cell = seen.cell;
  effects.push_back({.name = "local_tree", .joints = {}, .options = {}, .place = {}});
  cell.effects = std::move(effects);
  return fit_all(cell, seen.measured).calibration.state;
}

/// By how much the error that a tracker sees at new poses falls with the first candidate, as a
/// share: with all its waves, and under the gravity for which the diagnosis lists it.
double true_fall(Seen seen, const BlindCase& blind, const Diagnosis& d, double sigma) {
  const Simulation& fresh = blind.fresh_scattered ? *blind.fresh_scattered : blind.fresh_robot;
  if (d.gravity && d.gravity->certain) seen.cell.gravity = d.gravity->found;
  const Candidate& first = d.candidates.front();
  std::vector<EffectEntry> more = seen.cell.effects;
  more.push_back(first.entry);
  for (std::size_t k = 1; k < first.cycles.size(); ++k) {
    more.push_back(first.entry);
    more.back().options["cycles_per_turn"] = first.cycles[k];
  }
  const double before = std::hypot(sigma, true_error(fitted(seen, seen.cell.effects), fresh));
  return 1.0 - std::hypot(sigma, true_error(fitted(seen, more), fresh)) / before;
}

void score_unknown(const BlindCase& blind, const Diagnosis& d, Score& out) {
  const auto truth = nlohmann::json::parse(blind.truth_json);
  std::vector<std::string> inputs;
  for (const auto& effect : truth["effects"])
    if (effect.contains("inputs"))
      for (const auto& input : effect["inputs"]) inputs.push_back(input);
  const auto& found = d.unknown ? d.unknown : d.unknown_after;
  // What library effects can make up between them need not be called unknown.
  const auto& hidden = out.drawn.hidden.front();
  const bool made_up = d.finding == Finding::kMissing && hidden.names.size() > 1 &&
                       is_like(hidden, d.candidates.front().entry) &&
                       at_joint(hidden, d.candidates.front().entry);
  // A joint that errs with the next joint's angle is the next axis that wobbles.
  const auto wobbles = [&](const EffectEntry& e) {
    return e.name == "axis_wobble" && hidden.law == "other_joint" && !inputs.empty() &&
           inputs.front() == fmt::format("q{}", e.joints.front() + 1);
  };
  const bool merged =
      made_up || (d.finding == Finding::kMissing && wobbles(d.candidates.front().entry));
  out.unknown_said = found.has_value() || merged;
  out.inputs_right = merged;
  if (!found) return;
  const auto& said = found->pattern.depends_on;
  out.inputs_right = std::any_of(inputs.begin(), inputs.end(), [&](const std::string& input) {
    return std::any_of(said.begin(), said.end(), [&](const std::string& name) {
      return name == input || (input == "temp" && name.rfind("temp", 0) == 0);
    });
  });
}

/// Which pose, counting repeats once, stands just ahead of a cut behind so many rows.
int pose_ahead(const MeasurementFiles& measured, double rows) {
  int pose = 0;
  for (int i = 1; i < static_cast<int>(rows) && i < measured.size(); ++i)
    pose += measured.replicate_group[i] != measured.replicate_group[i - 1];
  return pose;
}

/// Size of the fitted step of that entry [m].
double shift_of(const EffectEntry& entry, const ArmState& arm) {
  for (const auto& effect : arm.arm.effects)
    if (effect.name == "step" &&
        std::abs(effect.constants.front() - std::get<double>(entry.options.at("after_row"))) < 1.0)
      return Eigen::Map<const Eigen::Vector3d>(effect.parameters.data()).norm();
  return 0.0;
}

/// A bumped reflector also by how far it went; the others only by when.
bool finds_step(const Seen& seen, const BlindCase& blind, const Diagnosis& d,
                const ArmState& diagnosed) {
  const auto truth = nlohmann::json::parse(blind.truth_json);
  for (const auto& effect : truth["effects"]) {
    const auto& numbers = effect["numbers"].is_array() ? effect["numbers"][0] : effect["numbers"];
    if (!numbers.contains("row_after")) continue;
    const int there = pose_ahead(seen.measured, numbers["row_after"].get<double>());
    for (const auto& added : d.added) {
      if (added.entry.name != "step") continue;
      const double after_row = std::get<double>(added.entry.options.at("after_row"));
      if (std::abs(pose_ahead(seen.measured, after_row) - there) > 1) continue;
      if (!numbers.contains("shift_mm") || numbers["of"] != "tool") return true;
      const auto mm = numbers["shift_mm"].get<std::vector<double>>();
      const double shift = 1e-3 * Eigen::Map<const Eigen::Vector3d>(mm.data()).norm();
      return std::get<std::string>(added.entry.options.at("of")) == "tool" &&
             std::abs(shift_of(added.entry, diagnosed) - shift) <= kShiftWithin * shift;
    }
  }
  return false;
}

std::string words_of(const Cell& cell, const Diagnosis& d) {
  std::string out = d.candidates.empty() ? "-" : key_of(cell, d.candidates.front().entry);
  out += " |";
  for (const auto& added : d.added) out += " " + key_of(cell, added.entry);
  if (const auto& u = d.unknown ? d.unknown : d.unknown_after)
    out += " | unknown: " + u->pattern.subject + " " + u->pattern.words;
  return out;
}

/// What was added at several joints, joint by joint.
std::vector<EffectEntry> one_by_one(const std::vector<Addition>& added) {
  std::vector<EffectEntry> out;
  for (const auto& a : added) {
    out.push_back(a.entry);
    const bool pair = descriptor_of(a.entry.name).joints == JointList::kOrderedPair;
    if (pair || a.entry.joints.size() < 2) continue;
    out.pop_back();
    for (const int joint : a.entry.joints) {
      out.push_back(a.entry);
      out.back().joints = {joint};
    }
  }
  return out;
}

void judge(const Seen& seen, const BlindCase& blind, const Diagnosis& d, Score& out) {
  out.finding = d.finding;
  out.finding_after = d.finding_after.value_or(d.finding);
  out.said = words_of(seen.cell, d);
  const auto& hidden = out.drawn.hidden;
  if (!hidden.empty() && !d.candidates.empty()) {
    const EffectEntry& first = d.candidates.front().entry;
    out.class_first = d.finding == Finding::kMissing && is_like(hidden.front(), first);
    out.joint_first = out.class_first && at_joint(hidden.front(), first);
  }
  out.added = static_cast<int>(d.added.size());
  for (const auto& one : hidden)
    out.recalled.push_back(std::any_of(d.added.begin(), d.added.end(), [&](const Addition& a) {
      return is_like(one, a.entry) && at_joint(one, a.entry);
    }));
  for (const auto& added : one_by_one(d.added))
    out.extra += std::none_of(hidden.begin(), hidden.end(), [&](const auto& one) {
      return (is_like(one, added) || is_third_harmonic(one, added)) && at_joint(one, added);
    });
  if (out.drawn.group == Group::kUnknown) score_unknown(blind, d, out);
}

}  // namespace

Score run_case(const HiddenCase& drawn) {
  Score out;
  out.drawn = drawn;
  try {
    const BlindCase blind = make_blind_case(drawn.request);
    const Seen seen = written_and_read(blind, drawn.request.seed);
    const auto start = std::chrono::steady_clock::now();
    const Diagnosis d = diagnose(seen.cell, seen.measured, {.apply = true, .tell = {}});
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    judge(seen, blind, d, out);
    const double sigma = drawn.request.sigma_m;
    const ArmState diagnosed = fitted(seen, d.effects);
    out.before = true_error(fitted(seen, seen.cell.effects), blind.fresh_robot) / sigma;
    out.after = true_error(diagnosed, blind.fresh_robot) / sigma;
    if (drawn.request.seed % kTreeEvery == 0)
      out.with_tree = true_error(fitted_with_tree(seen, d.effects), blind.fresh_robot) / sigma;
    if (drawn.group == Group::kStep) out.step_found = finds_step(seen, blind, d, diagnosed);
    const double axes = 3.0;
    out.held_over_floor = d.after.rms / (std::sqrt(axes) * sigma);
    // What new poses show scatters with the joints as well.
    const double seen_error =
        blind.fresh_scattered ? true_error(diagnosed, *blind.fresh_scattered) / sigma : out.after;
    out.held_over_true = d.after.rms / (sigma * std::sqrt(axes * (1.0 + seen_error * seen_error)));
    out.claims = claims_of(drawn, d);
    if (!drawn.kind.empty() && out.claims->fall_counts)
      out.claims->true_fall = true_fall(seen, blind, d, sigma);
    if (drawn.formulas) out.formula = formula_score(drawn, blind, seen, d);
    out.made = true;
  } catch (const Failure& failure) {
    out.why_not = failure.what();
  }
  return out;
}

}  // namespace plumb::tests
