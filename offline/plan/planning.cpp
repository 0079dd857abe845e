// SPDX-License-Identifier: Apache-2.0
#include "plan/planning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/effect_binding.hpp"
#include "cell/artefacts.hpp"
#include "cell/setups.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "fit/measured_orientations.hpp"
#include "noise/weights.hpp"
#include "plan/plan_steps.hpp"
#include "solve/frame_start.hpp"

namespace plumb::offline {
namespace {

/// Poses over which predictions are judged.
constexpr int kChecked = 500;
/// Place of the reflector on the flange, where the cell states none.
constexpr std::array<double, 3> kUsualTarget_m{0.05, 0.0, 0.1};

std::vector<int> used_rows(const Measurements& measured) {
  std::vector<int> out;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.set[static_cast<std::size_t>(i)] != SetMark::kIgnore) out.push_back(i);
  return out;
}

ArmState nominal_arm(const Cell& cell) {
  ArmState out;
  out.arm.calibrated = cell.nominal;
  out.arm.gravity = cell.gravity;
  out.arm.mechanics = mechanics_of(cell);
  place_as_given(cell.measurement, out);
  for (int k = 0; k < out.setups(); ++k)
    if (setup_rule(cell.measurement, k).fit_target) out.target(k).p = kUsualTarget_m;
  return out;
}

/// The fitted arm, or none with a note why.
std::optional<Calibration> fitted_arm(const Cell& cell, const Measurements& used, PosePlan& out) {
  std::vector<int> rows(static_cast<std::size_t>(used.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::string why = "nothing is measured yet";
  try {
    if (!rows.empty()) return calibrate(cell, used, rows);
  } catch (const Failure& failure) {
    why = failure.problems().front().message;
  }
  out.remarks.push_back({.severity = Severity::kNote,
                         .code = "N-PLAN-NOMINAL",
                         .message = fmt::format("planned for the nominal arm: {}", why),
                         .help = "measure these poses, then: plumb fit"});
  return std::nullopt;
}

/// The cell without the two effects that are to be told apart and without learnt trees.
Cell without_rivals(Cell cell, const std::vector<EffectEntry>& rivals) {
  std::erase_if(cell.effects, [](const EffectEntry& e) { return is_local_tree(e.name); });
  for (const auto& rival : rivals)
    std::erase_if(cell.effects, [&](EffectEntry& listed) {
      if (listed.name != rival.name) return false;
      if (is_wave(listed.name))
        return listed.joints == rival.joints && listed.options == rival.options;
      if (!descriptor_of(listed.name).joints_apart) return listed.joints == rival.joints;
      std::erase_if(listed.joints, [&](int joint) {
        return std::find(rival.joints.begin(), rival.joints.end(), joint) != rival.joints.end();
      });
      return listed.joints.empty();
    });
  return cell;
}

}  // namespace

void check_plannable(const Cell& cell) {
  if (has_artefacts(cell.measurement))
    throw Failure(
        Exit::kInput,
        {.code = "E-PLAN-POINT",
         .message = "poses are planned for measured positions: readings about points, "
                    "planes or anchors have their own places",
         .help = "at each of them turn the tool about all axes as far as it goes, at four "
                 "places or more, high and low, near and far"});
}

namespace {

PlanStart start_of(const Cell& cell, const Measurements& measured, const PlanRequest& request,
                   PosePlan& out) {
  check_plannable(cell);
  if (const auto& setups = cell.measurement.setups; setups.size() > 1)
    out.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-PLAN-SETUP",
         .message = fmt::format("the poses are chosen to be measured in the first set-up, '{}'",
                                setups.front().name),
         .help = "for another one, list it first in cell.toml"});
  PlanStart start;
  start.used = measured.size() > 0 ? pick(measured, used_rows(measured)) : measured;
  start.calibration = fitted_arm(cell, start.used, out);
  start.state = start.calibration ? start.calibration->state : nominal_arm(cell);
  start.sigma_m = reading_sigma(cell, start.used);
  if (measured.has_orientation() || measured.size() == 0)
    start.sigma_rad = cell.measurement.sigma_rad.value_or(0.0);
  PoseRules other = request.rules;
  other.seed = request.rules.seed ^ 0x9e3779b9U;
  other.pool = kChecked;
  start.pool =
      imagined(cell, start.used, pose_pool(cell, start.state, request.rules), request.rules.seed);
  start.check = imagined(cell, start.used, pose_pool(cell, start.state, other), other.seed);
  if (start.state.arm.effects.empty()) start.state.arm.effects = bind_effects(cell, start.pool);
  out.measured = start.used.size();
  out.pool = start.pool.size();
  out.sigma_m = start.sigma_m;
  return start;
}

void plan_d_optimal(const Cell& cell, const PlanStart& start, const PlanRequest& request,
                    PosePlan& out) {
  const DesignSpace space =
      design_space(cell, start.state, start.pool, start.sigma_m, start.sigma_rad);
  const Eigen::MatrixXd known = space.lines(start.used);
  const auto candidates = blocks(space.lines(start.pool), space.per_pose());
  const Design design =
      d_optimal(candidates, known, space.prior(), request.n, DesignCriterion::all(space.size()));
  Information information(space.prior());
  information.add(known);
  out.parameters = static_cast<int>(space.size());
  out.before = prediction_sigma(space, start.check, information.covariance());
  for (const int i : design.chosen) information.add(candidates[static_cast<std::size_t>(i)]);
  out.after = prediction_sigma(space, start.check, information.covariance());
  out.ln_det = design.value;
  const RowsN q = start.pool.q(design.chosen, Eigen::all);
  for (const int i : driven(cell, start, q, out.drive))
    out.poses.push_back({.name = fmt::format("N{:03}", out.poses.size() + 1),
                         .q = q.row(i).transpose(),
                         .note = ""});
}

}  // namespace

PosePlan plan_poses(const Cell& cell, const Measurements& measured, const PlanRequest& request) {
  PosePlan out;
  const Cell judged = as_judged(cell, measured);
  const Cell model = request.separate.empty() ? judged : without_rivals(judged, request.separate);
  const PlanStart start = start_of(model, measured, request, out);
  if (request.separate.empty())
    plan_d_optimal(model, start, request, out);
  else
    plan_separation(model, start, request, out);
  return out;
}

}  // namespace plumb::offline
