// SPDX-License-Identifier: Apache-2.0
#include "runs/earlier_runs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "runs/run_json.hpp"
#include "runs/run_store.hpp"

namespace plumb::offline {

bool is_of_data(const Run& run, const MeasurementFiles& measured) {
  if (run.inputs.size() != measured.tables.size()) return false;
  for (std::size_t i = 0; i < run.inputs.size(); ++i)
    if (run.inputs[i].sha256 != measured.tables[i].sha256) return false;
  return true;
}

bool seems_fitted(const Cell& cell, const MeasurementFiles& measured) {
  const auto numbers = list_runs(cell);
  return std::any_of(numbers.rbegin(), numbers.rend(), [&](int number) {
    try {
      const Run run = run_from_json(nlohmann::ordered_json::parse(
          read_file(cell.directory / "runs" / fmt::format("{:04}", number) / "run.json")));
      return !run.recheck && is_of_data(run, measured) && is_of_cell(run, cell);
    } catch (const std::exception&) {
      return false;  // the error is reported when the run is loaded
    }
  });
}

std::vector<Run> earlier_runs(const Run& last, const Cell& cell, const MeasurementFiles& measured) {
  std::vector<Run> out;
  for (const int number : list_runs(cell)) {
    if (number >= last.number) break;
    try {
      Run run = load_run(cell, number);
      if (is_of_data(run, measured)) out.push_back(std::move(run));
    } catch (const Failure&) {
      continue;  // a damaged run is passed over
    }
  }
  return out;
}

std::vector<Run> rechecks_of(const Run& calibrated, const Cell& cell) {
  std::vector<Run> out;
  std::vector<int> line{calibrated.number};
  for (const int number : list_runs(cell)) {
    if (number <= calibrated.number) continue;
    try {
      Run run = load_run(cell, number);
      if (joins_line(run, line)) out.push_back(std::move(run));
    } catch (const Failure&) {
      continue;  // a damaged run is passed over
    }
  }
  return out;
}

}  // namespace plumb::offline
