// SPDX-License-Identifier: Apache-2.0
#include "show/fit_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "cell/artefacts.hpp"
#include "cell/formula_reader.hpp"
#include "cell/setups.hpp"
#include "effects/registry.hpp"
#include "fit/verdict.hpp"
#include "show/artefacts_view.hpp"
#include "show/error_table.hpp"
#include "show/heads.hpp"
#include "show/likeness_view.hpp"
#include "show/parameter_unit.hpp"
#include "show/table.hpp"
#include "show/units.hpp"
#include "show/verdict_json.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline::show {
namespace {

Json parameter_json(const Estimate& e) {
  const ParameterUnit u = unit_of(e);
  Json out{{"name", e.name}};
  put(out, "value", e.value * u.per_si);
  out["unit"] = u.name;
  put(out, "std", e.std * u.per_si);
  put(out, "nominal", e.nominal * u.per_si);
  put(out, "change", (e.value - e.nominal) * u.per_si);
  return out;
}

Json parameters_json(const std::vector<Estimate>& estimates) {
  Json out = Json::array();
  for (const auto& e : estimates)
    if (e.of_robot) out.push_back(parameter_json(e));
  return out;
}

/// Frame and target: their values are in `frame` and `target_mm`.
Json measurement_std_json(const std::vector<Estimate>& estimates) {
  Json out = Json::object();
  for (const auto& e : estimates)
    if (!e.of_robot) put(out, e.name + "_" + unit(e.is_length), shown(e.std, e.is_length));
  return out;
}

Json tree_json(const TreeChoice& tree) {
  return {{"leaves", tree.leaves},
          {"leaves_total", std::accumulate(tree.leaves.begin(), tree.leaves.end(), 0)},
          {"cv_before_rms_mm", to_mm(tree.cv_before_m)},
          {"cv_after_rms_mm", to_mm(tree.cv_after_m)},
          {"gain_se_mm", to_mm(tree.gain_se_m)},
          {"reason", tree.reason}};
}

Json effects_json(const Cell& cell) {
  Json out = Json::array();
  for (const auto& effect : cell.effects) {
    Json joints = Json::array();
    for (int j : effect.joints) joints.push_back(cell.nominal.joints[j].name);
    out.push_back({{"effect", effect.name}, {"joints", joints}});
    if (is_formula(effect.name)) out.back()["name"] = formula_label(formula_text(effect));
  }
  return out;
}

Table parameter_table(const std::vector<Estimate>& estimates) {
  Table table{
      .name = "parameters",
      .caption = "Fitted numbers of the arm and its effects",
      .head = {head::kParameter, head::kNominal, head::kFitted, head::kChange, head::kSigma, ""}};
  table.left_from = 5;
  for (const auto& e : estimates) {
    if (!e.of_robot) continue;
    const ParameterUnit u = unit_of(e);
    table.add({e.name, u.text(e.nominal), u.text(e.value),
               (e.value > e.nominal ? "+" : "") + u.text(e.value - e.nominal), u.text(e.std),
               u.name});
  }
  return table;
}

Json setups_json(const MeasurementSettings& m, const ArmState& state) {
  Json out = Json::array();
  for (int k = 0; k < state.setups(); ++k) {
    const Setup rule = setup_rule(m, k);
    if (rule.is_artefact()) continue;
    Json one{{"name", setup_name(m, k)}, {"frame", pose_json(state.frame(k))}};
    one["frame"]["fitted"] = rule.fit_frame;
    const auto& t = state.target(k).p;
    one["target_mm"] = {to_mm(t[0]), to_mm(t[1]), to_mm(t[2])};
    one["target_fitted"] = rule.fit_target;
    out.push_back(std::move(one));
  }
  return out;
}

/// A row for each of several set-ups.
///
/// @param held  Names of parameters that the readings leave open.
Blocks setups_blocks(const MeasurementSettings& m, const ArmState& state,
                     const std::vector<std::string>& held) {
  Table table{.name = "setups",
              .caption = "Where tracker and reflector stood",
              .head = {"set-up [mm]", "frame", "x", "y", "z", "target", "x", "y", "z"}};
  const auto how = [&](bool fitted, int root, int k) {
    return root != k ? "as " + setup_name(m, root) : std::string(fitted ? "fitted" : "given");
  };
  const auto frame_how = [&](int k) -> std::string {
    const std::string frame = frame_prefix(m, k);
    const bool open = std::any_of(held.begin(), held.end(),
                                  [&](const std::string& name) { return name.starts_with(frame); });
    return open ? "guessed" : how(setup_rule(m, k).fit_frame, frame_root(m, k), k);
  };
  for (int k = 0; k < state.setups(); ++k) {
    const Setup rule = setup_rule(m, k);
    if (rule.is_artefact()) continue;
    const auto &f = state.frame(k).p, &t = state.target(k).p;
    table.add({setup_name(m, k), frame_how(k), mm(f[0]), mm(f[1]), mm(f[2]),
               how(rule.fit_target, target_root(m, k), k), mm(t[0]), mm(t[1]), mm(t[2])});
  }
  if (table.rows.empty()) return {};
  return {std::move(table),
          under("frame: base in the measurement frame; target: reflector in the tool frame")};
}

Json outliers_json(const Fit& fit, const std::vector<std::string>& pose) {
  Json out = Json::array();
  const auto add = [&](const std::vector<Outlier>& outliers, const char* set) {
    for (const auto& o : outliers) {
      Json one{{"pose", pose[o.row]}, {"set", set}};
      put(one, "error_mm", to_mm(o.error_m));
      put(one, "times_usual", o.times);
      out.push_back(std::move(one));
    }
  };
  add(fit.calibration.outliers, "fit");
  add(fit.held_outliers, "held");
  return out;
}

/// Frames of set-ups and artefacts have no nominal place; the table of set-ups says which frames
/// are guessed.
Blocks held_note(std::vector<std::string> held) {
  std::erase_if(held, [](const std::string& name) {
    return name.starts_with("frame[") ||
           std::ranges::any_of(artefact_readings(), [&](const ReadingDescriptor& kind) {
             return name.starts_with(kind.noun);
           });
  });
  if (held.empty()) return {};
  return {under(fmt::format("kept at nominal, because these poses say too little about them: {}",
                            fmt::join(held, ", ")))};
}

/// What the series of waves came to: their numbers are too many to be listed.
Blocks series_note(const Cell& cell, const ArmState& state) {
  const std::string waves = series_words(cell, state.arm);
  if (waves.empty()) return {};
  return {under("series of waves: " + waves)};
}

/// Where tracker and reflector stood.
Blocks measurement_blocks(const Cell& cell, const Calibration& c) {
  const ArmState& state = c.state;
  if (state.setups() > 1 || of_artefact(cell.measurement, 0)) {
    Blocks out = setups_blocks(cell.measurement, state, c.held);
    append(out, artefacts_blocks(cell, c));
    return out;
  }
  const Setup rule = setup_rule(cell.measurement, 0);
  const auto& f = state.X_MB;
  const auto& t = state.X_TG.p;
  const auto how = [](bool fitted) { return fitted ? "fitted" : "given"; };
  return {
      under(fmt::format("frame, {}: base in the measurement frame at ({:.3f}, {:.3f}, {:.3f}) mm, "
                        "quaternion wxyz ({:.6f}, {:.6f}, {:.6f}, {:.6f})",
                        how(rule.fit_frame), to_mm(f.p[0]), to_mm(f.p[1]), to_mm(f.p[2]), f.q[0],
                        f.q[1], f.q[2], f.q[3])),
      under(fmt::format("target, {}: reflector in the tool frame at ({:.3f}, {:.3f}, {:.3f}) mm",
                        how(rule.fit_target), to_mm(t[0]), to_mm(t[1]), to_mm(t[2])))};
}

}  // namespace

Json fit_json(const Cell& cell, const Measurements& measured, const Fit& fit,
              const Answers& answers) {
  const Calibration& c = fit.calibration;
  Json out{{"poses_fit", fit.fit.n}, {"poses_held_out", fit.held.n}};
  out["folds"] = fit.split.folds;
  out["parameters"] = parameters_json(c.estimates);
  out["held_parameters"] = c.held;
  out["identifiable_rank"] = c.rank;
  put(out, "calibrability", c.calibrability);
  out["held_out"] = stats_json(fit.held);
  add_interval(held_out_interval(measured, fit), out["held_out"]);
  add_turns(fit, out);
  add_orientation(fit.orientations, {}, out);
  out["fit"] = stats_json(fit.fit);
  out["held_out_without_outliers"] = stats_json(fit.held_without_outliers);
  out["outliers"] = outliers_json(fit, measured.pose);
  out["base"] = name_of(fit.base);
  out["nominal"] = stats_json(fit.nominal_held);
  out["geometry"] = stats_json(fit.geometry_held);
  add_floor(fit.floor, out);
  put(out, "unavoidable_ratio", fit.unavoidable_ratio);
  out["still_joints"] = fit.still;
  out["effects"] = effects_json(cell);
  out["frame"] = pose_json(c.state.X_MB);
  const Setup first = setup_rule(cell.measurement, 0);
  out["frame"]["fitted"] = first.fit_frame;
  const auto& t = c.state.X_TG.p;
  out["target_mm"] = {to_mm(t[0]), to_mm(t[1]), to_mm(t[2])};
  out["target_fitted"] = first.fit_target;
  if (c.state.setups() > 1) out["setups"] = setups_json(cell.measurement, c.state);
  add_artefacts(cell, c, out);
  out["measurement_std"] = measurement_std_json(c.estimates);
  if (fit.tree)
    out["tree"] = tree_json(*fit.tree);
  else
    put_null(out, "tree", "[effects] does not list local_tree");
  out["convergence"] = {{"iterations", c.iterations}};
  put(out["convergence"], "sigma0", c.sigma0);
  add_likeness(c, out);
  out["tolerance_mm"] = to_mm(cell.tolerance_m);
  out["seed"] = cell.measurement.seed;
  add_verdict(cell, fit, answers, out);
  return out;
}

Blocks arm_blocks(const Cell& cell, const Fit& fit) {
  const Calibration& c = fit.calibration;
  Blocks out{parameter_table(c.estimates)};
  append(out, held_note(c.held));
  append(out, likeness_notes(c));
  append(out, series_note(cell, c.state));
  append(out, measurement_blocks(cell, c));
  if (fit.tree) out.emplace_back(under("tree: " + fit.tree->reason));
  out.emplace_back(under(fmt::format("{} numbers fitted, frame and target included; {} iterations",
                                     c.estimates.size(), c.iterations)));
  return out;
}

Blocks fit_blocks(const Cell& cell, const Measurements& measured, const Fit& fit,
                  const Answers& answers) {
  Blocks out{Sentence{answers.sentence, name_of(grade(fit, cell.tolerance_m))}};
  append(out, error_blocks(measured, fit));
  append(out, arm_blocks(cell, fit));
  return out;
}

}  // namespace plumb::offline::show
