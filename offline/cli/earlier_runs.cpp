// SPDX-License-Identifier: Apache-2.0
#include "cli/earlier_runs.hpp"

#include "cli/cell_data.hpp"
#include "program/problem.hpp"

namespace plumb::offline::cli {

std::vector<Run> earlier_runs(const Run& last, const Cell& cell, const MeasurementFiles& measured) {
  std::vector<Run> out;
  for (const int number : list_runs(cell)) {
    if (number >= last.number) break;
    try {
      Run run = load_run(cell, number);
      check_same_data(run, measured);
      out.push_back(std::move(run));
    } catch (const Failure&) {
      continue;  // damaged, or of other data: no step of this model
    }
  }
  return out;
}

}  // namespace plumb::offline::cli
