// SPDX-License-Identifier: Apache-2.0
#include "answers/after_diagnosis.hpp"

#include <fmt/format.h>

#include "cell/artefacts.hpp"
#include "cell/effect_arguments.hpp"
#include "diagnose/certainty.hpp"
#include "diagnose/diagnosis_text.hpp"
#include "diagnose/effect_domain.hpp"
#include "diagnose/effect_words.hpp"

namespace plumb::offline {
namespace {

bool good_enough(const Cell& cell, const ErrorStats& held) {
  return held.n > 0 && held.p95 <= cell.tolerance_m;
}

std::string separating(const Cell& cell, const EffectEntry& a, const EffectEntry& b) {
  return fmt::format("plan --separate {},{}", planning_argument(cell, a),
                     planning_argument(cell, b));
}

constexpr const char* kMeasure = "plan --n 30   # which poses to measure next";
constexpr const char* kWhatShows =
    "check   # what touched points can show, and what else to measure";
constexpr const char* kCompile = "compile   # the model file for the controller";

std::vector<std::string> steps_after(const Cell& cell, const Diagnosis& d) {
  if (d.gravity && d.gravity->certain)
    return {"diagnose   # once cell.toml says gravity = " + gravity_text(d.gravity->found)};
  const Finding finding = d.finding_after.value_or(d.finding);
  if (finding == Finding::kMissing) {
    const Candidate& first = d.candidates.front();
    if (!helps(d, first)) return {good_enough(cell, d.before) ? kCompile : kMeasure};
    std::vector<double> rows;
    for (const Move& move : first.moves) rows.push_back(move.after_row);
    std::vector<std::string> out{
        "add " + adding_arguments(cell, first.entry, rows.empty() ? first.cycles : rows),
        "diagnose --apply   # all that is supported, one by one"};
    if (!d.alternatives.empty())
      out.insert(out.begin(), separating(cell, first.entry, d.alternatives.front().entry) +
                                  "   # which of them is it?");
    else if (const Candidate* const rival = near_rival(cell, d))
      out.push_back(separating(cell, first.entry, rival->entry) + "   # to be sure which it is");
    return out;
  }
  if (finding == Finding::kUnknown) {
    std::vector<std::string> out;
    if (!d.formulas.empty())
      out.push_back("add " + adding_arguments(cell, d.formulas.front().entry, {}) +
                    "   # the law that fits best");
    out.emplace_back("compare   # where is it, and since when?");
    return out;
  }
  const bool step_or_slow =
      d.undecided ? d.undecided->slow_motion.has_value() : d.slow_motion && !d.finding_after;
  if (step_or_slow) return {"compare   # the errors in order of time: do they jump, or creep?"};
  if (d.undecided)
    for (const auto& other : d.undecided->alternatives)
      if (other.compiled != is_compiled(d.undecided->entry))
        return {separating(cell, d.undecided->entry, other.entry)};
  if (d.tied) return {separating(cell, d.candidates.front().entry, *d.tied)};
  return {good_enough(cell, d.after) ? kCompile : kMeasure};
}

}  // namespace

std::vector<std::string> after_diagnosis(const Cell& cell, const Diagnosis& d) {
  std::vector<std::string> out = steps_after(cell, d);
  // Poses are not planned in a cell with readings about artefacts: check_plannable.
  for (std::string& step : out)
    if (has_artefacts(cell.measurement) && step.starts_with("plan ")) step = kWhatShows;
  return out;
}

}  // namespace plumb::offline
