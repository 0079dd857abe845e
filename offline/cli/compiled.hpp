// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/cell_data.hpp"
#include "compile/audit.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline::cli {

/// The model of a run. With kEveryPose its numbers come from every pose; the run stays the evidence
/// behind them.
enum class Poses { kOfTheRun, kEveryPose };
format::Model compiled(const Cell& cell, const Measurements& measured, Run run, Poses poses);

/// What --gate asks: no warning of the audit, and 95 % of the held-out poses within tolerance.
/// What fails becomes an error of `outcome`, exit kGateFailed.
void check_gate(const Audit& audit, const format::Model& model, double tolerance_m,
                Outcome& outcome);

/// "Compiled Line for Arm (serial 1): held-out mean 0.02 mm, 95 % 0.04 mm."
std::string compiled_headline(const format::Model& model);

}  // namespace plumb::offline::cli
