// SPDX-License-Identifier: Apache-2.0
#include "answers/answers.hpp"

#include "answers/after_diagnosis.hpp"
#include "answers/kept_diagnosis.hpp"
#include "compare/full_verdict.hpp"
#include "compare/worst_band.hpp"
#include "diagnose/certainty.hpp"
#include "fit/verdict.hpp"

namespace plumb::offline {
namespace {

using Class = Answers::Class;

Class class_of(Quality quality) {
  switch (quality) {
    case Quality::kNotHeldOut:
      return Class::kUndecidable;
    case Quality::kGood:
    case Quality::kGoodNoiseUnknown:
      return Class::kGood;
    case Quality::kRepeatsDisagree:
    case Quality::kSigmaTooLarge:
    case Quality::kGoodNotComplete:
    case Quality::kGoodButForSome:
    case Quality::kWorstPoseIsFar:
      return Class::kGoodBut;
    case Quality::kLimitedByNoise:
    case Quality::kPerhapsLimitedByJoints:
      return Class::kLimited;
    case Quality::kTooFewPoses:
    case Quality::kBeyondSigmaTooLarge:
    case Quality::kBeyond:
    case Quality::kBeyondNoiseUnknown:
      break;
  }
  return Class::kNotGood;
}

Finding last_finding(const Diagnosis& d) { return d.finding_after.value_or(d.finding); }

Answers::Why why_of(const Cell& cell, const Diagnosis* d) {
  if (d == nullptr) return {"Nobody has looked yet.", "not_looked"};
  return {d->finding_after ? d->text_after : d->text, name_of(certainty(cell, *d))};
}

/// "diagnose   # which effect is missing?" is a command and its reason.
void put_next(const std::string& words, Json& out) {
  const auto reason = words.find(" # ");
  const std::string command = words.substr(0, reason);
  out["next"] = "plumb " + command.substr(0, command.find_last_not_of(' ') + 1);
  out["next_why"] = reason == std::string::npos ? "" : words.substr(reason + 3);
}

}  // namespace

const char* name_of(Answers::Class found) {
  switch (found) {
    case Class::kGood:
      return "good";
    case Class::kGoodBut:
      return "good_but";
    case Class::kLimited:
      return "limited";
    case Class::kMissing:
      return "missing";
    case Class::kUndecidable:
      return "undecidable";
    case Class::kNotGood:
      break;
  }
  return "not_good";
}

Answers answers_of(const Cell& cell, const Measurements& measured, const Fit& fit,
                   const Diagnosis* diagnosis) {
  Answers out;
  out.found = class_of(quality(fit, cell.tolerance_m));
  if (out.found == Class::kGood && !fit.still.empty()) out.found = Class::kGoodBut;
  if (out.found == Class::kNotGood && diagnosis != nullptr &&
      last_finding(*diagnosis) == Finding::kMissing)
    out.found = Class::kMissing;
  out.sentence = compare::full_verdict(cell, measured, fit);
  out.where = compare::where_sentence(cell, measured, fit);
  out.why = why_of(cell, diagnosis);
  out.next = diagnosis != nullptr ? after_diagnosis(cell, *diagnosis).front()
                                  : next_step(fit, cell.tolerance_m);
  return out;
}

Answers answers_of(const Cell& cell, const Measurements& measured, const Run& run) {
  const auto last = last_diagnosis(run);
  return answers_of(cell, measured, run.fit, last ? &*last : nullptr);
}

Json to_json(const Answers& answers) {
  Json out{{"class", name_of(answers.found)},
           {"sentence", answers.sentence},
           {"where", answers.where},
           {"why", {{"text", answers.why.text}, {"state", answers.why.state}}}};
  put_next(answers.next, out);
  return out;
}

}  // namespace plumb::offline
