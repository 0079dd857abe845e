// SPDX-License-Identifier: Apache-2.0
// Rules about effects, guard and provenance.
#include "plumb/format/formula.hpp"
#include "rule.hpp"

namespace plumb::format {
namespace {

std::vector<Rule> effect_rules() {
  return {
      {"NameWithCapitals", "effect's name", [](Model& m) { m.effects[0].name = "Gear Ripple"; }},
      {"NameEmpty", "effect's name", [](Model& m) { m.effects[0].name = ""; }},
      {"NameLong", "effect's name", [](Model& m) { m.effects[0].name = std::string(300, 'a'); }},
      {"OfTheTracker", "'tracker' belongs to a measurement",
       [](Model& m) { m.effects[0].name = "tracker"; }},
      {"OfADrift", "'drift' belongs to a measurement",
       [](Model& m) { m.effects[0].name = "drift"; }},
      {"OfAStep", "'step' belongs to a measurement", [](Model& m) { m.effects[0].name = "step"; }},
      {"OfASettlingLag", "'settling_lag' belongs to a measurement",
       [](Model& m) { m.effects[0].name = "settling_lag"; }},
      {"FormulaOfTheRow", "'formula' belongs to a measurement",
       [](Model& m) {
         m.effects[0].name = "formula";
         m.effects[0].formula.code = {instruction(FormulaOp::kRow)};
       }},
      {"FormulaOfALastMove", "'formula' belongs to a measurement",
       [](Model& m) {
         m.effects[0].name = "formula";
         m.effects[0].formula.code = {instruction(FormulaOp::kMove, 1)};
       }},
      {"Version", "version 0", [](Model& m) { m.effects[0].version = 0; }},
      {"Joint", "'reversal' names joint 7 of 6", [](Model& m) { m.effects[0].joints[0] = 6; }},
      {"TooManyJoints", "too many joints", [](Model& m) { m.effects[0].joints.assign(10, 0); }},
      {"Parameter", "a parameter", [](Model& m) { m.effects[0].parameters[0] = kNaN; }},
      {"TooManyParameters", "too many parameters",
       [](Model& m) { m.effects[0].parameters.assign(kMaxEffectParameters + 1, 0.0); }},
      {"ContextInput", "unknown input",
       [](Model& m) { m.effects[0].context[0].input = ContextInput{5}; }},
      {"ContextName", "context holds control",
       [](Model& m) { m.effects[0].context[0].name = "\r"; }},
      {"TooMuchContext", "too much context",
       [](Model& m) { m.effects[0].context.assign(10, ContextNeed{}); }},
      {"Fallback", "fallback", [](Model& m) { m.effects[0].context[0].fallback = kInf; }},
      {"FormulaOfAnother", "is no formula and has one",
       [](Model& m) { m.effects[0].formula.code = {0}; }},
      {"FormulaLeftOver", "is no formula and has one",
       [](Model& m) {
         m.effects[0].formula.parameters = {{"a", "", kNaN, 0.0}};
       }},
      {"FormulaMissing", "or is one and has none", [](Model& m) { m.effects[0].name = "formula"; }},
      {"TooMany", "too many effects", [](Model& m) { m.effects.resize(65, m.effects[0]); }},
  };
}

/// Each limit at zero (or below, where zero is allowed), beyond all sense, and not a number.
std::vector<Rule> guard_rules() {
  struct Limit {
    std::string name;
    double GuardLimits::*member;
    double low;
  };
  const Limit limits[] = {{"max_correction_m", &GuardLimits::max_correction_m, 0.0},
                          {"max_rotation_rad", &GuardLimits::max_rotation_rad, 0.0},
                          {"slew_m_per_s", &GuardLimits::slew_m_per_s, 0.0},
                          {"slew_rad_per_s", &GuardLimits::slew_rad_per_s, 0.0},
                          {"ramp_s", &GuardLimits::ramp_s, -1.0},
                          {"cycle_s", &GuardLimits::cycle_s, 0.0},
                          {"length_scale_m", &GuardLimits::length_scale_m, 0.0},
                          {"min_singular_value", &GuardLimits::min_singular_value, 0.0},
                          {"max_seed_distance", &GuardLimits::max_seed_distance, 0.0}};
  std::vector<Rule> out{
      {"corrects", "neither position nor pose", [](Model& m) { m.guard.corrects = Corrects{2}; }}};
  for (const auto& limit : limits)
    for (const auto& [suffix, value] :
         {std::pair{"_low", limit.low}, std::pair{"_high", 1e4}, std::pair{"_nan", kNaN}})
      out.push_back({limit.name + suffix, limit.name,
                     [member = limit.member, x = value](Model& m) { m.guard.*member = x; }});
  return out;
}

std::vector<Rule> provenance_rules() {
  return {
      {"ToolVersion", "provenance", [](Model& m) { m.provenance.tool_version = "\n"; }},
      {"Created", "provenance", [](Model& m) { m.provenance.created = "\xFF"; }},
      {"Run", "provenance", [](Model& m) { m.provenance.run = std::string(999, '1'); }},
      {"HashShort", "64 hex digits", [](Model& m) { m.provenance.inputs[0].sha256 = "abc"; }},
      {"HashNotHex", "64 hex digits", [](Model& m) { m.provenance.inputs[0].sha256[9] = 'g'; }},
      {"InputEmpty", "input file", [](Model& m) { m.provenance.inputs[0].name = ""; }},
      {"InputWithFolder", "has folders",
       [](Model& m) { m.provenance.inputs[0].name = "data/a.csv"; }},
      {"InputName", "input file", [](Model& m) { m.provenance.inputs[0].name = "\x01"; }},
      {"TooManyInputs", "too many input files",
       [](Model& m) { m.provenance.inputs.resize(65, m.provenance.inputs[0]); }},
      {"MeanOverRms", "the held-out mean", [](Model& m) { m.provenance.held_out.mean_m = 7e-5; }},
      {"RmsOverMax", "the held-out rms", [](Model& m) { m.provenance.held_out.rms_m = 2e-4; }},
      {"P95OverMax", "the held-out p95", [](Model& m) { m.provenance.held_out.p95_m = 2e-4; }},
      {"MeanNegative", "held-out figure", [](Model& m) { m.provenance.held_out.mean_m = -1e-6; }},
      {"MaxNaN", "held-out figure", [](Model& m) { m.provenance.held_out.max_m = kNaN; }},
      {"MaxInfinite", "held-out figure", [](Model& m) { m.provenance.held_out.max_m = kInf; }},
      {"NoiseFloor", "noise floor", [](Model& m) { m.provenance.noise_floor_m = -1.0; }},
      {"CovarianceSize", "covariance does not fit",
       [](Model& m) { m.provenance.covariance.pop_back(); }},
      {"CovarianceNaN", "covariance is not finite",
       [](Model& m) { m.provenance.covariance[1] = std::numeric_limits<float>::quiet_NaN(); }},
      {"VarianceNegative", "variance of 'J3.alpha'",
       [](Model& m) { m.provenance.covariance[2] = -1.0F; }},
      {"TooManyParameters", "too many fitted parameters: 161",
       [](Model& m) { m.provenance.parameter_names.resize(161); }},
      {"ParameterName", "fitted parameter",
       [](Model& m) { m.provenance.parameter_names[1] = "\x1B"; }},
  };
}

/// Ranges of what the model was told in its fit.
std::vector<Rule> range_rules() {
  const auto with = [](ContextInput input, std::string name, double low, double high) {
    return [=](Model& m) { m.domain.context = {{input, name, low, high}}; };
  };
  using enum ContextInput;
  return {
      {"NotFinite", "no range", with(kPayload, "", 0.0, kNaN)},
      {"Infinite", "no range", with(kPayload, "", -kInf, 1.0)},
      {"Beyond", "no range", with(kPayload, "", 0.0, 1e9)},
      {"Backwards", "no range", with(kTemperature, "temp", 30.0, 20.0)},
      {"NoTemperature", "unknown input", with(kTemperature, "", 20.0, 30.0)},
      {"NoSuchLoad", "unknown input", with(kPayload, "qx", 0.0, 1.0)},
      {"NoRangeOfADirection", "unknown input", with(kDirection, "", -1.0, 1.0)},
      {"NoSuchInput", "unknown input", with(ContextInput{9}, "", -1.0, 1.0)},
      {"Name", "control", with(kTemperature, "t\n", 20.0, 30.0)},
      {"Twice", "two ranges",
       [](Model& m) {
         m.domain.context.assign(2, {kPayload, "cx", 0.0, 0.1});
       }},
      {"TooMany", "ranges of context",
       [](Model& m) {
         m.domain.context.resize(19, {kTemperature, "temp", 20.0, 30.0});
       }},
  };
}

INSTANTIATE_TEST_SUITE_P(Ranges, SemanticRule, ::testing::ValuesIn(range_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(Effects, SemanticRule, ::testing::ValuesIn(effect_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(Guards, SemanticRule, ::testing::ValuesIn(guard_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(Provenance, SemanticRule, ::testing::ValuesIn(provenance_rules()),
                         name_of);

}  // namespace
}  // namespace plumb::format
