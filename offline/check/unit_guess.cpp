// SPDX-License-Identifier: Apache-2.0
#include "check/unit_guess.hpp"

#include <algorithm>
#include <cmath>

#include "cell/units.hpp"
#include "check/constants.hpp"

namespace plumb::offline {
namespace {

const char* const kLengths[] = {"mm", "m", "in"};

double in_metres(const std::string& unit) { return unit_of(unit)->to_si(1.0); }

/// Labelled first, then deg or rad if numbers up to `largest` can be that.
std::vector<std::string> plausible(double largest, const std::string& labelled) {
  std::vector<std::string> out{labelled};
  if (labelled != "rad" && largest <= check::kMostRadians) out.emplace_back("rad");
  if (labelled != "deg" && largest >= check::kLeastDegrees) out.emplace_back("deg");
  return out;
}

std::vector<std::string> lengths_with(const std::string& labelled) {
  std::vector<std::string> out{labelled};
  for (const char* unit : kLengths)
    if (labelled != unit) out.emplace_back(unit);
  return out;
}

/// No table is in micrometres, but a tracker may write points so.
std::vector<std::string> point_lengths_with(const std::string& labelled) {
  auto out = lengths_with(labelled);
  if (labelled != "um") out.emplace_back("um");
  return out;
}

bool near(double ratio, double wanted) {
  return std::abs(std::log(ratio / wanted)) < check::kRatioTolerance;
}

}  // namespace

double unit_ratio(const std::string& meant, const std::string& labelled) {
  return meant == labelled ? 1.0 : in_metres(meant) / in_metres(labelled);
}

double oddity(double reach_m) {
  return check::kOddPerDecade *
         std::max(0.0, std::abs(std::log10(std::max(reach_m, 1e-9))) - check::kUsualDecades);
}

std::vector<std::string> plausible_turn_units(double largest, const std::string& labelled) {
  return plausible(unit_of(labelled)->from_si(largest), labelled);
}

std::vector<std::string> plausible_table_units(const format::Chain& chain,
                                               const std::string& labelled) {
  double largest = 0.0;
  for (const auto& row : chain.joints)
    largest = std::max({largest, std::abs(row.alpha), std::abs(row.theta), std::abs(row.beta)});
  if (largest == 0.0) return {labelled};
  return plausible(unit_of(labelled)->from_si(largest), labelled);
}

const std::vector<double>& length_ratios() {
  static const std::vector<double> ratios = [] {
    std::vector<double> out{1.0};
    for (const char* a : kLengths)
      for (const char* b : kLengths)
        if (a != b) out.push_back(in_metres(a) / in_metres(b));
    return out;
  }();
  return ratios;
}

LengthUnits explain_ratios(const LengthUnits& labelled, double point_ratio, double slide_ratio,
                           double reach_m) {
  LengthUnits best = labelled;
  double least = 1e300;
  for (const auto& table : lengths_with(labelled.table)) {
    const double f_table = in_metres(table) / in_metres(labelled.table);
    for (const auto& point : point_lengths_with(labelled.point)) {
      if (!near(in_metres(point) / in_metres(labelled.point) / f_table, point_ratio)) continue;
      for (const auto& slide : lengths_with(labelled.slide)) {
        const double f_slide = in_metres(slide) / in_metres(labelled.slide);
        if (slide_ratio > 0.0 && !near(f_slide / f_table, slide_ratio)) continue;
        const double cost = (table != labelled.table ? 1.0 : 0.0) +
                            (point != labelled.point ? 1.0 : 0.0) +
                            (slide != labelled.slide ? 1.0 : 0.0) + oddity(reach_m * f_table);
        if (cost >= least) continue;
        least = cost;
        best = {table, slide, point};
      }
    }
  }
  return best;
}

}  // namespace plumb::offline
