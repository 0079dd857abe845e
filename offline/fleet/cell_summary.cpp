// SPDX-License-Identifier: Apache-2.0
#include "fleet/cell_summary.hpp"

#include "answers/kept_answers.hpp"
#include "runs/kept_fields.hpp"

namespace plumb::offline::fleet {
namespace {

constexpr const char* kSchema = "fleet.cell/3";

}  // namespace

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<EffectEvidence>& evidence) {
  fields("effect", evidence.effect);
  fields("ln_bayes", evidence.ln_bayes);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<CellDiagnosis>& diagnosis) {
  fields("finding", diagnosis.finding);
  fields("effect", diagnosis.effect);
  fields("joints", diagnosis.joints);
  fields("words", diagnosis.words);
  fields("evidence", diagnosis.evidence);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<SummaryInput>& input) {
  fields("file", input.file);
  fields("sha256", input.sha256);
  fields("of_measurement", input.of_measurement);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<ArmNumber>& number) {
  fields("name", number.name);
  fields("effect", number.effect);
  fields("unit", number.unit);
  fields("value", number.value);
  fields("std", number.std);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<CellSummary>& cell) {
  fields("name", cell.name);
  fields("arm", cell.arm);
  fields("inputs", cell.inputs);
  fields("ok", cell.ok);
  fields("error_code", cell.error_code);
  fields("error", cell.error);
  fields("robot", cell.robot);
  fields("serial", cell.serial);
  fields("model", cell.model);
  fields("tolerance_m", cell.tolerance_m);
  fields("held_out", cell.held);
  fields("noise_floor_m", cell.floor_m);
  fields("answers", cell.answers);
  fields("verdict_head", cell.verdict_head);
  fields("verdict_class", cell.verdict_class);
  fields("good", cell.good);
  fields("effects", cell.effects);
  fields("diagnosis", cell.diagnosis);
  fields("numbers", cell.numbers);
  fields.symmetric("covariance", cell.covariance, cell.numbers.size());
}

Json to_json(const CellSummary& summary) {
  Json out{{"schema", kSchema}};
  FieldWriter fields(out);
  describe(fields, summary);
  return out;
}

CellSummary summary_from(const Json& json) {
  if (json.at("schema") != kSchema) json.at("a summary of this version");
  return from_kept<CellSummary>(json);
}

}  // namespace plumb::offline::fleet
