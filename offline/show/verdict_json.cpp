// SPDX-License-Identifier: Apache-2.0
#include "show/verdict_json.hpp"

#include "fit/verdict.hpp"

namespace plumb::offline::show {

void add_verdict(const Cell& cell, const Fit& fit, const Answers& answers, Json& out) {
  out["finding"] = to_json(answers);
  out["verdict_error"] = stats_json(usual_held(fit));
  out["verdict"] = answers.sentence;
  out["verdict_head"] = verdict_head(fit, cell.tolerance_m);
  out["verdict_class"] = name_of(grade(fit, cell.tolerance_m));
}

}  // namespace plumb::offline::show
