// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "diagnose/diagnosis.hpp"
#include "fit/fit.hpp"
#include "program/json.hpp"
#include "runs/run.hpp"

namespace plumb::offline {

/// What people ask of a calibration first. Decided here once; every verb that judges, the report,
/// the fleet and the workbench show these answers.
struct Answers {
  /// Is it good?
  enum class Class {
    kGood,         // it keeps the tolerance
    kGoodBut,      // it keeps the tolerance, with a reservation that the sentence names
    kLimited,      // it misses the tolerance by no more than noise or the joints' scatter leave
    kMissing,      // it misses it, and an effect of the library is missing
    kUndecidable,  // no reading was held out, so nobody can say
    kNotGood       // it misses it, for a reason that is not known yet
  };
  struct Why {
    std::string text;   // in plain words
    std::string state;  // as name_of(Certainty), or "not_looked"
  };

  Class found = Class::kUndecidable;
  std::string sentence;  // with the held-out error, the tolerance and the noise floor
  std::string where;     // the region of the largest errors
  Why why;
  std::string next;  // the words that follow `plumb`; the reason may follow behind " # "
};

/// Shown as "good", "good_but", "limited", "missing", "undecidable", "not_good".
const char* name_of(Answers::Class found);

/// The answers for a fit of these readings, which must stand on the base of the fit.
///
/// @param diagnosis  Of the same model and readings; null: nobody has looked yet.
///
/// Cost: that of compare::full_verdict, and joints * poses.
Answers answers_of(const Cell& cell, const Measurements& measured, const Fit& fit,
                   const Diagnosis* diagnosis);

/// The same for a run, with the last diagnosis that was kept with it.
Answers answers_of(const Cell& cell, const Measurements& measured, const Run& run);

/// {class, sentence, where, why{text, state}, next, next_why}: next with `plumb` before it.
Json to_json(const Answers& answers);

}  // namespace plumb::offline
