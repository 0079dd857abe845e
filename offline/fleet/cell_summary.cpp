// SPDX-License-Identifier: Apache-2.0
#include "fleet/cell_summary.hpp"

#include "cell/packed_matrix.hpp"
#include "runs/json_parts.hpp"

namespace plumb::offline::fleet {
namespace {

constexpr const char* kSchema = "fleet.cell/2";

Json diagnosis_to(const std::optional<CellDiagnosis>& d) {
  if (!d) return nullptr;
  Json evidence = Json::array();
  for (const auto& one : d->evidence)
    evidence.push_back({{"effect", one.effect}, {"ln_bayes", one.ln_bayes}});
  return {{"finding", d->finding},
          {"effect", d->effect},
          {"joints", d->joints},
          {"words", d->words},
          {"evidence", evidence}};
}
std::optional<CellDiagnosis> diagnosis_from(const Json& j) {
  if (j.is_null()) return std::nullopt;
  CellDiagnosis out;
  j.at("finding").get_to(out.finding);
  j.at("effect").get_to(out.effect);
  j.at("joints").get_to(out.joints);
  j.at("words").get_to(out.words);
  for (const auto& one : j.at("evidence"))
    out.evidence.push_back({one.at("effect"), one.at("ln_bayes")});
  return out;
}

}  // namespace

Json to_json(const CellSummary& s) {
  Json inputs = Json::array(), numbers = Json::array();
  for (const auto& input : s.inputs)
    inputs.push_back(
        {{"file", input.file}, {"sha256", input.sha256}, {"of_measurement", input.of_measurement}});
  for (const auto& n : s.numbers)
    numbers.push_back({{"name", n.name},
                       {"effect", n.effect},
                       {"unit", n.unit},
                       {"value", n.value},
                       {"std", n.std}});
  return {{"schema", kSchema},
          {"name", s.name},
          {"arm", s.arm},
          {"inputs", inputs},
          {"ok", s.ok},
          {"error_code", s.error_code},
          {"error", s.error},
          {"robot", s.robot},
          {"serial", s.serial},
          {"model", s.model},
          {"tolerance_m", s.tolerance_m},
          {"held_out", offline::to_json(s.held)},
          {"noise_floor_m", s.floor_m},
          {"verdict", s.verdict},
          {"verdict_head", s.verdict_head},
          {"verdict_class", s.verdict_class},
          {"good", s.good},
          {"effects", s.effects},
          {"diagnosis", diagnosis_to(s.diagnosis)},
          {"numbers", numbers},
          {"covariance", packed(s.covariance)}};
}

CellSummary summary_from(const Json& j) {
  CellSummary out;
  if (j.at("schema") != kSchema) j.at("a summary of this version");
  j.at("name").get_to(out.name);
  j.at("arm").get_to(out.arm);
  for (const auto& input : j.at("inputs"))
    out.inputs.push_back({input.at("file"), input.at("sha256"), input.at("of_measurement")});
  j.at("ok").get_to(out.ok);
  j.at("error_code").get_to(out.error_code);
  j.at("error").get_to(out.error);
  j.at("robot").get_to(out.robot);
  j.at("serial").get_to(out.serial);
  j.at("model").get_to(out.model);
  j.at("tolerance_m").get_to(out.tolerance_m);
  out.held = stats_from(j.at("held_out"));
  j.at("noise_floor_m").get_to(out.floor_m);
  j.at("verdict").get_to(out.verdict);
  j.at("verdict_head").get_to(out.verdict_head);
  j.at("verdict_class").get_to(out.verdict_class);
  j.at("good").get_to(out.good);
  j.at("effects").get_to(out.effects);
  out.diagnosis = diagnosis_from(j.at("diagnosis"));
  for (const auto& n : j.at("numbers"))
    out.numbers.push_back({.name = n.at("name"),
                           .effect = n.at("effect"),
                           .unit = n.at("unit"),
                           .value = n.at("value"),
                           .std = n.at("std")});
  out.covariance = unpacked(j.at("covariance"), static_cast<Eigen::Index>(out.numbers.size()));
  return out;
}

}  // namespace plumb::offline::fleet
