// SPDX-License-Identifier: Apache-2.0
#include "solve/solution_checks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "arm/predicted_points.hpp"
#include "cell/formula_reader.hpp"
#include "solve/constants.hpp"

namespace plumb::offline {
namespace {

/// How many of the parameters belong to effects, and in words to which.
std::pair<int, std::string> parameters_of_effects(const std::vector<Parameter>& parameters) {
  std::map<std::string, int> counts;
  int all = 0;
  for (const Parameter& p : parameters)
    if (p.of_effect()) ++counts[p.name.substr(0, p.name.find('.'))], ++all;
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == counts.end()) return {0, ""};
  return {all, counts.size() > 1 ? "effects, most of them of " + most->first : most->first};
}

}  // namespace

void check_enough(const FitData& data, std::size_t kept, const std::vector<Parameter>& candidates) {
  const int coordinates = data.residual_count();
  if (coordinates > static_cast<int>(kept)) return;
  const auto all = static_cast<int>(candidates.size());
  const auto [of_effects, effect] = parameters_of_effects(candidates);
  const std::string given =
      fmt::format("{} of {} measured poses are fitted and give {} coordinates", data.rows.size(),
                  data.measured->size(), coordinates);
  Problem problem{.code = "E-FIT-FEW",
                  .message = given + ", too few to fit arm, frame and target",
                  .help = "measure at least 30 poses all over the joint limits: plumb plan --n 30"};
  if (of_effects > 0 && coordinates > all - of_effects) {
    problem.message = fmt::format(
        "{}: enough for arm, frame and target, too few for the {} more "
        "parameters of {}",
        given, of_effects, effect);
    problem.help = fmt::format("name fewer of its joints, or fit more than {} poses",
                               all * static_cast<int>(data.rows.size()) / std::max(1, coordinates));
  }
  throw Failure(Exit::kNumbersSayNo, std::move(problem));
}

void refuse_undefined(const FitData& data, const format::Effect& effect, int row) {
  const format::Formula& f = effect.formula;
  Problem problem{.code = "E-FIT-FORMULA",
                  .message = fmt::format("formula '{}' has no value at pose '{}': {}", f.name,
                                         data.measured->pose[row], f.expression),
                  .help = "keep divisors, sqrt and log off 0, as in log(max(payload, 1 [kg]))"};
  if (data.cell != nullptr)
    for (const auto& entry : data.cell->effects)
      if (entry.name == effect.name && formula_label(formula_text(entry)) == f.name)
        problem.place = entry.place;
  throw Failure(Exit::kNumbersSayNo, std::move(problem));
}

void check_converged(const Solution& solution) {
  if (solution.converged) return;
  throw Failure(Exit::kNumbersSayNo,
                {.code = "E-FIT-CONVERGE",
                 .message = "the calibration did not converge: " + solution.reason,
                 .help = "if plumb check finds labels and units right, measure poses that differ "
                         "more: plumb plan --n 30"});
}

void check_meets(const Cell& cell, const FitData& data, const Solution& solution) {
  const Measurements some = pick(*data.measured, data.rows);
  const Rows3 error = residuals(some, predict_points(solution.state, some));
  const double rms = std::sqrt(error.squaredNorm() / static_cast<double>(error.rows()));
  const double length = reach(cell.nominal);
  if (rms <= kMostMissed * length) return;
  throw Failure(Exit::kNumbersSayNo,
                {.code = "E-FIT-MISS",
                 .message = fmt::format("calibrated as well as possible, this arm still misses its "
                                        "points by {:.1f} mm RMS, {:.1f} % of its links' length",
                                        rms * 1e3, 100.0 * rms / length),
                 .help = "find the wrong unit, joint sign or DH convention: plumb check"});
}

}  // namespace plumb::offline
