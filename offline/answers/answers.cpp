// SPDX-License-Identifier: Apache-2.0
#include "answers/answers.hpp"

#include "answers/action.hpp"
#include "answers/after_diagnosis.hpp"
#include "answers/kept_diagnosis.hpp"
#include "compare/full_verdict.hpp"
#include "compare/worst_band.hpp"
#include "diagnose/certainty.hpp"
#include "fit/verdict.hpp"

namespace plumb::offline {
namespace {

using Class = Answers::Class;

/// What the grade, which is a colour, leaves open: whether it is the measurement that limits.
bool is_limited(Quality quality) {
  return quality == Quality::kLimitedByNoise || quality == Quality::kPerhapsLimitedByJoints;
}

Class class_of(const Fit& fit, double tolerance_m) {
  switch (grade(fit, tolerance_m)) {
    case Grade::kGood:
      return Class::kGood;
    case Grade::kPartly:
      return is_limited(quality(fit, tolerance_m)) ? Class::kLimited : Class::kGoodBut;
    case Grade::kUnknown:
      return Class::kUndecidable;
    case Grade::kBad:
      break;
  }
  return Class::kNotGood;
}

Finding last_finding(const Diagnosis& d) { return d.finding_after.value_or(d.finding); }

Answers::Why why_of(const Cell& cell, const Diagnosis* d) {
  if (d == nullptr) return {"Nobody has looked yet.", "not_looked"};
  return {d->finding_after ? d->text_after : d->text, name_of(certainty(cell, *d))};
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
  out.found = class_of(fit, cell.tolerance_m);
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
  const Action next = action_of(answers.next);
  return {{"class", name_of(answers.found)},
          {"sentence", answers.sentence},
          {"where", answers.where},
          {"why", {{"text", answers.why.text}, {"state", answers.why.state}}},
          {"next", next.typed()},
          {"next_why", next.why}};
}

}  // namespace plumb::offline
