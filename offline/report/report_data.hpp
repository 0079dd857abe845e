// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "compare/comparison.hpp"
#include "compile/audit.hpp"
#include "diagnose/diagnosis.hpp"
#include "figures/run_results.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "runs/run.hpp"

namespace plumb::offline::report {

/// All that a report is written from. What it refers to must live longer. `measured` stands on the
/// base of the run.
struct ReportData {
  const Cell& cell;
  const MeasurementFiles& measured;
  const Run& run;
  const figures::RunResults& results;
  const compare::Comparison& comparison;
  bool run_is_current = true;  // of the present cell file

  std::vector<Run> earlier = {};  // of the same data

  std::optional<Diagnosis> diagnosis = {};  // of the present cell; else why there is none
  std::string why_no_diagnosis = {};
  bool diagnosis_is_kept = false;  // found earlier, by plumb diagnose or another report

  Answers answers = {};  // with the diagnosis, if there is one

  struct Controller {
    format::Model model;
    Audit audit;
  };
  std::optional<Controller> controller =
      {};  // the model of the run; else why it cannot be compiled
  std::string why_no_controller = {};

  std::optional<drivers::BusLayout> bus = {};  // of [deploy]; else why there is none
  std::string why_no_bus = {};

  std::vector<std::string> commands = {};  // that make this report again, as they are typed
  std::string created = {};                // of the report, ISO 8601, UTC
};

}  // namespace plumb::offline::report
