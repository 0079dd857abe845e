// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "fit/verdict.hpp"
#include "show/compare_view.hpp"
#include "show/compare_words.hpp"
#include "show/error_table.hpp"
#include "show/units.hpp"
#include "show/verdict_json.hpp"

namespace plumb::offline::show {
namespace {

using compare::Comparison;
using compare::ErrorProfile;
using Kind = ErrorProfile::Kind;

constexpr std::size_t kWorst = 10;

Json worst_json(const Comparison& comparison) {
  Json out = Json::array();
  for (std::size_t i = 0; i < std::min(kWorst, comparison.poses.size()); ++i) {
    const auto& pose = comparison.poses[i];
    out.push_back({{"pose", pose.pose},
                   {"row", pose.row + 1},
                   {"error_mm", to_mm(pose.error_M.norm())},
                   {"dx_mm", to_mm(pose.error_M(0))},
                   {"dy_mm", to_mm(pose.error_M(1))},
                   {"dz_mm", to_mm(pose.error_M(2))},
                   {"set", pose.held ? "held" : "fit"}});
  }
  return out;
}

const char* key_of(Kind kind) {
  switch (kind) {
    case Kind::kJoint:
      return "joint";
    case Kind::kOrder:
      return "order";
    case Kind::kRegion:
      return "region";
    case Kind::kLoad:
      return "load";
    case Kind::kContext:
      return "context";
    case Kind::kSetup:
      return "setup";
  }
  return "";
}

void add_bins(const ErrorProfile& profile, Json& out) {
  std::string suffix = unit_name(profile.unit);
  if (!suffix.empty()) suffix = "_" + suffix;
  for (const auto& bin : profile.bins) {
    Json row;
    if (profile.kind == Kind::kJoint)
      row["joint"] = profile.name;
    else if (profile.kind != Kind::kOrder)
      row["quantity"] = profile.name;
    if (profile.kind == Kind::kSetup) {
      row = {{"setup", profile.names[static_cast<std::size_t>(bin.from)]}};
    } else {
      row["from" + suffix] = in_unit(bin.from, profile.unit);
      row["to" + suffix] = in_unit(bin.to, profile.unit);
    }
    row["n"] = bin.n;
    put(row, "mean_mm", bin.n > 0 ? to_mm(bin.mean) : NAN, "no pose lies here");
    row["n_fit"] = bin.fit_n;
    put(row, "mean_fit_mm", bin.fit_n > 0 ? to_mm(bin.fit_mean) : NAN, "no fit pose lies here");
    out.push_back(std::move(row));
  }
}

Json profiles_json(const std::vector<ErrorProfile>& profiles) {
  Json out;
  for (const auto kind : {Kind::kJoint, Kind::kRegion, Kind::kLoad, Kind::kContext, Kind::kOrder})
    out[key_of(kind)] = Json::array();
  for (const auto& profile : profiles)
    if (profile.kind == Kind::kSetup) out[key_of(Kind::kSetup)] = Json::array();
  for (const auto& profile : profiles) add_bins(profile, out[key_of(profile.kind)]);
  return out;
}

Json matters_json(const std::vector<ErrorProfile>& profiles) {
  Json out = Json::array();
  for (const auto& profile : profiles)
    if (profile.bins.size() > 1)
      out.push_back({{"by", key_of(profile.kind)},
                     {"quantity", profile.name},
                     {"explained_pct", 100.0 * profile.explained},
                     {"ln_p", profile.ln_p},
                     {"matters", profile.matters}});
  return out;
}

Json joint_shares_json(const Cell& cell, const std::vector<compare::JointShare>& shares) {
  Json out = Json::array();
  for (const auto& share : shares)
    out.push_back({{"joint", cell.nominal.joints[share.joint].name},
                   {"share_pct", 100.0 * share.share},
                   {"rms_urad", share.rms_rad * 1e6},
                   {"bins", share.bins},
                   {"ln_p", share.ln_p},
                   {"matters", share.matters}});
  return out;
}

Json turns_json(const Cell& cell, const compare::Turns& turns) {
  Json out{{"text", dependence_words(turns.profiles, "The orientation error")},
           {"joints_text", turning_joint_words(cell, turns)},
           {"worst", Json::array()}};
  for (std::size_t i = 0; i < std::min(kWorst, turns.poses.size()); ++i) {
    const auto& pose = turns.poses[i];
    out["worst"].push_back(
        {{"pose", pose.pose}, {"row", pose.row + 1}, {"error_deg", to_deg(pose.error_rad)}});
  }
  out["matters"] = matters_json(turns.profiles);
  out["joints"] = joint_shares_json(cell, turns.joints);
  return out;
}

Json lack_of_fit_json(const compare::LackOfFit& found, const Fit& fit) {
  using Basis = compare::LackOfFit::Basis;
  Json out{{"text", lack_of_fit_words(found, fit)}};
  if (found.basis == Basis::kNone) {
    put_null(out, "ratio", "neither repeats of a pose nor sigma_um are given");
    return out;
  }
  out["basis"] = found.basis == Basis::kRepeats ? "repeats" : "sigma";
  put(out, "ratio", found.ratio);
  out["dof_model"] = found.dof_model;
  out["dof_noise"] = found.dof_noise;
  out["ln_p"] = found.ln_p;
  out["significant"] = found.significant();
  out["systematic_pct"] = 100.0 * found.systematic;
  return out;
}

Json order_json(const compare::Autocorrelation& found) {
  Json out{{"text", order_words(found)}, {"n", found.n}};
  if (found.n == 0) {
    put_null(out, "lag1", "too few poses");
    return out;
  }
  out["lag1"] = found.lag1;
  out["low95"] = found.low95;
  out["high95"] = found.high95;
  out["beyond"] = found.beyond();
  out["closeness"] = found.closeness;
  return out;
}

void add_shift(const StepFound& step, bool slides, Json& out) {
  const auto three = [&](Eigen::Index first, double scale) {
    return Json{step.shift(first) * scale, step.shift(first + 1) * scale,
                step.shift(first + 2) * scale};
  };
  if (step.source == MotionSource::kJoint)
    out[slides ? "shift_um" : "turn_urad"] = step.shift(0) * 1e6;
  else
    out["shift_mm"] = three(0, 1e3);
  if (step.source == MotionSource::kBase) out["turn_urad"] = three(3, 1e6);
}

Json steps_json(const Cell& cell, const Measurements& measured, const Changes& found) {
  Json out = Json::array();
  for (const auto& step : found.steps) {
    Json row{{"text", step_words(cell, measured, step)},
             {"after_row", step.before + 1},
             {"after_pose", measured.pose[step.before]},
             {"before_pose", measured.pose[step.after]},
             {"earliest_row", step.earliest + 1},
             {"latest_row", step.latest + 1},
             {"of", name_of(step.source)},
             {"size_mm", to_mm(step.size_m)},
             {"ln_p", step.ln_p}};
    const bool joint = step.source == MotionSource::kJoint;
    if (joint) row["joint"] = cell.nominal.joints[step.joint].name;
    add_shift(step, joint && slides(cell.nominal.joints[step.joint]), row);
    out.push_back(std::move(row));
  }
  return out;
}

Json drifts_json(const Cell& cell, const Measurements& measured, const Changes& found) {
  Json out = Json::array();
  for (const auto& drift : found.drifts) {
    Json row{{"text", drift_words(cell, measured, drift)},
             {"from_row", drift.from + 1},
             {"to_row", drift.to + 1},
             {"of", name_of(drift.source)},
             {"size_mm", to_mm(drift.size_m)},
             {"ln_p", drift.ln_p}};
    if (drift.joint >= 0) row["joint"] = cell.nominal.joints[drift.joint].name;
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace

Json compare_json(const Cell& cell, const Measurements& measured, const Comparison& comparison,
                  const Run& run, const Answers& answers) {
  const Fit& fit = run.fit;
  Json out = stats_json(comparison.stats);
  add_interval(held_out_interval(measured, fit), out);
  out["set"] = comparison.set == Comparison::Set::kHeldOut ? "held_out" : "fit";
  out["frame"] = "measurement";
  out["run"] = run.number;
  out["fit"] = stats_json(fit.fit);
  out["fit_within_tolerance_pct"] = 100.0 * comparison.fit_within_tolerance;
  out["nominal"] = stats_json(fit.nominal_held);
  add_floor(fit.floor, out);
  out["tolerance_mm"] = to_mm(cell.tolerance_m);
  out["within_tolerance_pct"] = 100.0 * comparison.within_tolerance;
  add_verdict(cell, fit, answers, out);
  out["worst"] = worst_json(comparison);
  out["where"] = answers.where;
  out["by"] = profiles_json(comparison.profiles);
  out["matters"] = matters_json(comparison.profiles);
  add_turns(fit, out);
  if (!comparison.turns.poses.empty())
    out["orientation_errors"] = turns_json(cell, comparison.turns);
  out["joints"] = joint_shares_json(cell, comparison.joints);
  out["joints_text"] = joint_words(cell, comparison);
  out["lack_of_fit"] = lack_of_fit_json(comparison.lack_of_fit, fit);
  out["autocorrelation"] = order_json(comparison.order);
  out["change_points"] = steps_json(cell, measured, comparison.changes);
  out["drifts"] = drifts_json(cell, measured, comparison.changes);
  return out;
}

}  // namespace plumb::offline::show
