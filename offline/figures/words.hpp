// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/pose_words.hpp"
#include "draw/sheet.hpp"
#include "figures/run_results.hpp"

/// Words and numbers that several figures use.
namespace plumb::offline::figures {

/// The unit of an axis of lengths: one for all that is compared in a figure.
struct LengthUnit {
  std::string name;    // "mm" or "µm"
  double per_m = 1e3;  // of this unit
};
LengthUnit unit_for(double largest_m);

using compare::length_text;

/// The words of compare/pose_words.hpp for the readings and the fit of a run.
inline std::string judged_words(const RunResults& results) {
  return compare::judged_words(results.run.fit);
}
inline std::string pose_list(const RunResults& results, std::span<const int> rows,
                             std::size_t most) {
  return compare::pose_list(results.measured, rows, most);
}

/// The plain names of effects, each once, as in `plumb explain`: "gear ripple (12 times) and
/// geometry" with " and " between them.
std::string effect_names(const std::vector<std::string>& effects, const std::string& between);

/// The notes that every figure of errors carries: the sign, the counts, and that an in-sample error
/// is no accuracy.
std::vector<std::string> error_notes(const RunResults& results);

/// "held out" filled and "fitted" hollow, of those that the run has.
std::vector<draw::LegendEntry> pose_legend(const RunResults& results);

/// Errors of these rows [m], ascending.
enum class Which { kBefore, kAfter };
std::vector<double> sorted_errors(const RunResults& results, const std::vector<int>& rows,
                                  Which which);

/// The q-quantile (0 .. 1) of ascending values: the smallest that so large a share do not exceed;
/// 0 of none.
double quantile_of(const std::vector<double>& ascending, double q);

/// The numbers of a pose, for the title of its mark.
std::string pose_numbers(const RunResults& results, int row);

/// About `most` of the rows, in their order: a tenth of them the worst by error after the fit, the
/// rest evenly spread.
std::vector<int> thinned(const RunResults& results, const std::vector<int>& rows, std::size_t most);

/// "600 of 12000 poses are drawn: the worst ones, and an even choice of the others."; empty if all
/// are.
std::string thinning_note(std::size_t drawn, std::size_t all);

}  // namespace plumb::offline::figures
