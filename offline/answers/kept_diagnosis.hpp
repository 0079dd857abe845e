// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnose/diagnosis.hpp"
#include "runs/run.hpp"

/// What `plumb diagnose` found of the cell and data of a run, in diagnosis.json beside its
/// run.json, so that a report of the same run need not search again.
namespace plumb::offline {

/// Keeps what a diagnosis found: without `apply` of the model of the run, with `apply` of what was
/// added to reach it and what is left. A run that was not kept, and a folder that cannot be
/// written, keep nothing: then the next report diagnoses again.
void keep_diagnosis(const Run& run, const Diagnosis& found);

/// What was kept of that run by this version of plumb; nothing if there is none, or if its check
/// sum says that it was edited or cut off. The candidates have all that a report shows of them.
std::optional<Diagnosis> last_diagnosis(const Run& run);

/// The same, but only of a diagnosis without `apply`, whose candidates are those of this run.
std::optional<Diagnosis> kept_diagnosis(const Run& run);

}  // namespace plumb::offline
