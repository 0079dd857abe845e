// SPDX-License-Identifier: Apache-2.0
#include "show/check_view.hpp"
#include "show/error_table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

Json convention_json(const Convention& c) {
  Json reversed = Json::array(), turned = Json::array(), columns = Json::array(),
       zeros = Json::array(), factors = Json::array(), units = Json::array();
  for (std::size_t j = 0; j < c.reversed.size(); ++j) {
    columns.push_back(c.column[j] + 1);
    if (c.reversed[j]) reversed.push_back(j + 1);
    if (c.quarter_turns[j] != 0)
      turned.push_back({{"joint", j + 1}, {"angle_deg", 90 * c.quarter_turns[j]}});
    if (c.zero[j] != 0.0) zeros.push_back({{"joint", j + 1}, {"offset_deg", to_deg(c.zero[j])}});
    if (c.factor[j] != 1.0) factors.push_back({{"joint", j + 1}, {"factor", c.factor[j]}});
    if (!c.own_unit[j].empty()) units.push_back({{"joint", j + 1}, {"unit", c.own_unit[j]}});
  }
  return {{"dh_convention", c.dh == format::Convention::kStandard ? "standard" : "modified"},
          {"length_unit", c.length_unit},
          {"angle_unit", c.angle_unit},
          {"joint_angle_unit", c.turn_unit},
          {"sliding_joint_unit", c.slide_unit},
          {"point_unit", c.point_unit},
          {"reversed_joints", reversed},
          {"joint_columns", columns},
          {"turned_zeros", turned},
          {"joint_offsets", zeros},
          {"joint_factors", factors},
          {"joint_units", units},
          {"coupling", coupling_json(c.coupling)},
          {"left_handed", c.mirror != Mirror::kNone},
          {"frame_inverted", c.frame_inverted}};
}

Json interpretation_json(const Cell& cell, const Convention& labels, const Interpretation& r) {
  Json out = convention_json(r.convention);
  out["changes"] = in_words(cell, labels, r.convention);
  put(out, "placed_rms_mm", to_mm(r.placed_m));
  put(out, "residual_mm", to_mm(r.fitted_m));
  return out;
}

Json detection_json(const Cell& cell, const Detection& d) {
  const Convention& labels = d.present.convention;
  Json out{{"changed", d.changed}, {"tried", d.tried}};
  if (!d.why_not.empty()) {
    put_null(out, "residual_mm", d.why_not);
    out["present"] = convention_json(labels);
    out["best"] = convention_json(labels);
    out["table"] = Json::array();
    return out;
  }
  put(out, "residual_mm", to_mm(d.best.fitted_m));
  out["present"] = interpretation_json(cell, labels, d.present);
  out["best"] = interpretation_json(cell, labels, d.best);
  out["table"] = Json::array();
  for (const auto& r : d.table) out["table"].push_back(interpretation_json(cell, labels, r));
  out["same_points"] = Json::array();
  for (const auto& r : d.same) out["same_points"].push_back(in_words(cell, labels, r.convention));
  return out;
}

const char* name_of(Separation::Cause cause) {
  switch (cause) {
    case Separation::Cause::kChoice:
      return "choice";
    case Separation::Cause::kArm:
      return "arm";
    case Separation::Cause::kPoses:
      return "poses";
    default:
      return "weak";
  }
}

Json parameters_json(const IdentifiabilityReport& p) {
  Json out{{"rank", p.rank}, {"candidates", p.candidates}};
  out["fitted"] = p.calibration.estimates.size();
  put(out, "scaled_condition", p.scaled_condition);
  put(out, "calibrability", p.calibration.calibrability);
  const auto& o = p.observability;
  out["observability"] = Json::object();
  put(out["observability"], "O1", o.O1);
  put(out["observability"], "O2", o.O2);
  put(out["observability"], "O3", o.O3);
  put(out["observability"], "O4", o.O4);
  put(out["observability"], "O5", o.O5);
  out["correlations"] = Json::array();
  for (const auto& s : p.separations)
    out["correlations"].push_back({{"parameter", s.parameter},
                                   {"with", s.partners},
                                   {"rho", s.rho},
                                   {"cause", name_of(s.cause)},
                                   {"text", s.text}});
  return out;
}

/// Angles in deg, travels in mm.
Json joint_json(const JointCoverage& c, bool slides_) {
  const std::string unit = slides_ ? "_mm" : "_deg";
  Json out{{"joint", c.joint}};
  out["min" + unit] = shown(c.q_min, slides_);
  out["max" + unit] = shown(c.q_max, slides_);
  out["limit_min" + unit] = shown(c.limit_min, slides_);
  out["limit_max" + unit] = shown(c.limit_max, slides_);
  out["share"] = c.share;
  out["histogram"] = c.tenths;
  out["text"] = c.text;
  return out;
}

Json coverage_json(const Cell& cell, const Coverage& coverage) {
  Json out = Json::array();
  for (std::size_t j = 0; j < coverage.joints.size(); ++j)
    out.push_back(joint_json(coverage.joints[j], slides(cell.nominal.joints[j])));
  return out;
}

Json effects_json(const std::vector<Testable>& effects) {
  static const char* const kAnswers[] = {"no", "weakly", "yes"};
  Json out = Json::array();
  for (const auto& e : effects)
    out.push_back({{"effect", e.effect},
                   {"testable", kAnswers[static_cast<int>(e.answer)]},
                   {"why", e.why},
                   {"measure", e.measure}});
  return out;
}

}  // namespace

Json check_json(const Cell& cell, const Check& check) {
  Json out{{"ok", check.exit == Exit::kDone}, {"verdict", verdict(check)}};
  out["findings"] = Json::array();
  for (const auto& problem : check.findings) out["findings"].push_back(problem_json(problem));
  out["convention"] = detection_json(cell, check.detection);
  if (check.parameters)
    out["identifiability"] = parameters_json(*check.parameters);
  else
    put_null(out, "identifiability", check.why_no_parameters);
  out["coverage"] = Json::array();
  if (check.coverage) {
    out["coverage"] = coverage_json(cell, *check.coverage);
    out["poses"] = check.coverage->poses;
    out["readings"] = check.coverage->readings;
    const auto &low = check.coverage->box_min, &high = check.coverage->box_max;
    out["box"] = {{"min_mm", {to_mm(low[0]), to_mm(low[1]), to_mm(low[2])}},
                  {"max_mm", {to_mm(high[0]), to_mm(high[1]), to_mm(high[2])}}};
  }
  if (check.rounding)
    out["rounding"] = {{"step", check.rounding->step_in_unit},
                       {"unit", check.rounding->unit},
                       {"at_tool_rms_mm", to_mm(check.rounding->at_tool_m)}};
  else
    put_null(out, "rounding", "the joint readings are not rounded to a power of ten");
  add_floor(check.floor, out);
  add_orientation(check.orientations.judged, check.orientations.meant, out);
  out["effects"] = effects_json(check.effects);
  return out;
}

}  // namespace plumb::offline::show
