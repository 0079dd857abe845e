// SPDX-License-Identifier: Apache-2.0
#include "deploy/bus_of_cell.hpp"

#include "bus_text/bus_arm.hpp"
#include "bus_text/reach.hpp"
#include "program/file.hpp"

namespace plumb::offline {
namespace {

std::vector<drivers::LayoutFault> faults_of(const Cell& cell, const drivers::BusLayout& layout,
                                            drivers::BusUse use) {
  auto out = drivers::find_faults(layout, use);
  if (!out.empty() || use != drivers::BusUse::kCan) return out;
  return drivers::find_short_reach(layout, cell.nominal, cell.deploy.max_correction_m,
                                   "deploy.bus");
}

}  // namespace

drivers::BusLayout bus_of(const Cell& cell, drivers::BusUse use) {
  drivers::BusLayout out =
      cell.deploy.bus ? *cell.deploy.bus
                      : drivers::arm_layout(drivers::bus_arm(cell.nominal, cell.deploy.cycle_s), 0,
                                            drivers::CorrectionForm::kPose);
  std::vector<Problem> problems;
  for (const auto& fault : faults_of(cell, out, use))
    problems.push_back({.severity = Severity::kError,
                        .code = "E-CELL-BUS",
                        .message = fault.what,
                        .place = Place{.file = display_name(cell.file)},
                        .help = fault.help});
  if (!problems.empty()) throw Failure(Exit::kInput, std::move(problems));
  return out;
}

}  // namespace plumb::offline
