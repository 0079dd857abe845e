// SPDX-License-Identifier: Apache-2.0
#include "answers/kept_diagnosis.hpp"

#include "plumb/format/version.hpp"
#include "program/file.hpp"
#include "runs/kept_fields.hpp"
#include "runs/option_json.hpp"

namespace plumb::offline {

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<EffectEntry>& entry) {
  fields("name", entry.name);
  fields("joints", entry.joints);
  fields("options", entry.options);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Move>& move) {
  fields("after_row", move.after_row);
  fields("size_m", move.size_m);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Candidate>& candidate) {
  fields("entry", candidate.entry);
  fields("title", candidate.title);
  fields("domain", candidate.domain);
  fields("ln_bayes", candidate.ln_bayes);
  fields("gain", candidate.gain);
  fields("gain_se", candidate.gain_se);
  fields("alone", candidate.alone);
  fields("alone_turns", candidate.alone_turns);
  fields("after", candidate.after);
  fields("cycles", candidate.cycles);
  fields("peaks", candidate.peaks);
  fields("moves", candidate.moves);
  fields("supported", candidate.supported);
  fields("plausible", candidate.plausible);
  fields("explained", candidate.explained);
  fields("absorbed", candidate.absorbed);
  fields("largest_m", candidate.largest_m);
  fields("confounded_with", candidate.confounded_with);
  fields("separate", candidate.separate);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Alternative>& alternative) {
  fields("entry", alternative.entry);
  fields("cycles", alternative.cycles);
  fields("domain", alternative.domain);
  fields("behind", alternative.behind_nats);
  fields("compiled", alternative.compiled);
  fields("not_shown", alternative.not_shown);
  fields("measure", alternative.measure);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<UnknownStructure>& unknown) {
  fields("subject", unknown.pattern.subject);
  fields("words", unknown.pattern.words);
  fields("depends_on", unknown.pattern.depends_on);
  fields("share", unknown.share);
  fields("rms_m", unknown.rms_m);
  fields("rms_rad", unknown.rms_rad);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<OtherGravity>& gravity) {
  fields("stated", gravity.stated);
  fields("found", gravity.found);
  fields("nats_ahead", gravity.nats_ahead);
  fields("certain", gravity.certain);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Testable>& effect) {
  fields("answer", effect.answer);
  fields("effect", effect.effect);
  fields("why", effect.why);
  fields("measure", effect.measure);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Undecided>& undecided) {
  fields("entry", undecided.entry);
  fields("cycles", undecided.cycles);
  fields("domain", undecided.domain);
  fields("alternatives", undecided.alternatives);
  fields("slow_motion", undecided.slow_motion);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<FormulaNumber>& number) {
  fields("name", number.name);
  fields("unit", number.unit);
  fields("value", number.value);
  fields("std", number.std);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<FormulaOffer>& offer) {
  fields("entry", offer.entry);
  fields("numbers", offer.numbers);
  fields("before", offer.before);
  fields("after", offer.after);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<FoundTurns>& turns) {
  fields("floor", turns.floor);
  fields("before", turns.before);
  fields("after", turns.after);
  fields("refused", turns.refused);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Diagnosis>& found) {
  fields("finding", found.finding);
  fields("text", found.text);
  fields("finding_after", found.finding_after);
  fields("text_after", found.text_after);
  fields("undecided", found.undecided);
  fields("refused", found.refused);
  fields("floor", found.floor);
  fields("poses_fit", found.poses_fit);
  fields("poses_held", found.poses_held);
  fields("poses_choosing", found.poses_choosing);
  fields("nested", found.nested);
  fields("folds", found.folds);
  fields("before", found.before);
  fields("after", found.after);
  fields("turns", found.turns);
  fields("tied", found.tied);
  fields("gravity", found.gravity);
  fields("slow_motion", found.slow_motion);
  fields("alternatives", found.alternatives);
  fields("candidates", found.candidates);
  fields("not_testable", found.not_testable);
  fields("outliers", found.outliers);
  fields("formulas", found.formulas);
}

namespace {

constexpr const char* kSchema = "diagnosis/6";

std::filesystem::path kept_file(const Run& run) { return run.directory / "diagnosis.json"; }

}  // namespace

void keep_diagnosis(const Run& run, const Diagnosis& found) {
  if (run.number <= 0) return;
  const std::string text = to_text(kept_json(found));
  const Json file{{"schema", kSchema},
                  {"version", format::kVersion},
                  {"cell_sha256", run.cell_sha256},
                  {"sha256", sha256(text)},
                  {"found", Json::parse(text)}};
  try {
    write_file_atomically(kept_file(run), to_text(file));
  } catch (const Failure&) {
    return;  // it only saves time
  }
}

std::optional<Diagnosis> last_diagnosis(const Run& run) {
  if (run.number <= 0 || !std::filesystem::exists(kept_file(run))) return std::nullopt;
  try {
    const Json file = Json::parse(read_file(kept_file(run)));
    if (file.at("schema") != kSchema || file.at("version") != format::kVersion ||
        file.at("cell_sha256") != run.cell_sha256 ||
        file.at("sha256") != sha256(to_text(file.at("found"))))
      return std::nullopt;
    return from_kept<Diagnosis>(file.at("found"));
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const Failure&) {
    return std::nullopt;
  }
}

std::optional<Diagnosis> kept_diagnosis(const Run& run) {
  auto out = last_diagnosis(run);
  return out && !out->finding_after ? out : std::nullopt;
}

}  // namespace plumb::offline
