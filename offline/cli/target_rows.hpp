// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/corrected.hpp"
#include "cli/csv_output.hpp"
#include "cli/refusals.hpp"
#include "cli/row_stream.hpp"

namespace plumb::offline::cli {

/// Totals over targets, all of a file or those of a block.
struct TargetTotals {
  TargetTotals(const Corrector& corrector, const format::Chain& arm, KnownInputs unused)
      : refusals(corrector, arm), inputs(std::move(unused)) {}
  StatusCounts counts;
  Refusals refusals;
  KnownInputs inputs;
  int limited = 0;         // corrections cut to the guard's size
  std::size_t faded = 0;   // corrections of which nothing is left, far outside what was fitted
  double largest_m = 0.0;  // of the corrections that were not refused
  double largest_rad = 0.0;

  void add(const TargetTotals& more) {
    counts.add(more.counts);
    refusals.add(more.refusals);
    inputs.add(more.inputs);
    limited += more.limited;
    faded += more.faded;
    largest_m = std::max(largest_m, more.largest_m);
    largest_rad = std::max(largest_rad, more.largest_rad);
  }
};

/// W-CORRECT-LIMITED, or nothing where the guard cut no correction.
std::vector<Problem> limited_remark(const TargetTotals& found);

/// Corrects the targets of a file, block by block: each from its own joint state; without joint
/// columns from the last solution, `start` [rad] or [m] being the first. The model must outlive it.
class TargetRows {
 public:
  TargetRows(const format::Model& model, std::vector<double> start);

  static std::vector<std::string> columns() {
    return {"cx_mm", "cy_mm", "cz_mm", "cqw", "cqx", "cqy", "cqz", "status"};
  }

  /// For RowStream. Throws Failure (kInput, E-TARGET-...) without a joint state to start from.
  RowStream::Computed compute(Table table, const show::PassThrough& columns);

  const TargetTotals& found() const { return found_; }

 private:
  std::function<void(std::string&)> solved(const Targets& targets,
                                           const show::PassThrough& columns);
  void follow(const Targets& targets, const show::PassThrough& columns, std::string& text);
  static void append(const Targets& targets, int row, std::span<const double> seed,
                     const CorrectedRow& solved, const show::PassThrough& columns,
                     TargetTotals& found, std::string& text);

  SinglePoses poses_;
  KnownInputs inputs_;  // without any row yet
  std::vector<std::string> sensors_;
  JointColumns joints_;
  const format::Chain& chain_;
  std::vector<double> start_, last_;
  TargetTotals found_;
};

}  // namespace plumb::offline::cli
