// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit/fit.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// What a run of `plumb recheck` has in addition. Its model is that of an earlier run in which the
/// changed parts were refitted. Its `fit` is of the new readings alone, and each of these is
/// predicted by a refit without it.
struct RecheckOf {
  int parent = 0;           // number of the run that was rechecked
  std::string verdict;      // "true", "changed", "undecidable"
  std::string words;        // the verdict as one sentence
  ErrorStats before;        // errors of the parent at the new readings
  double expected_m = 0.0;  // mean error to expect there if nothing has changed
  double limit_m = 0.0;     // control limit: three standard deviations above that
};

/// The other run from which the fit of a run took over numbers. The fit itself says which ones.
struct TakenOver {
  std::string check_sum;            // of run.json of the other run
  std::vector<std::string> inputs;  // check sums of all readings of the other run
};

/// A stored fit: runs/0001/run.json and predictions.csv beside the cell file. These two never
/// change once written; a diagnosis of the model adds noise_floor.json and diagnosis.json, which a
/// later diagnosis replaces.
struct Run {
  int number = 0;
  std::filesystem::path directory;
  std::string created;      // ISO 8601, UTC
  std::string cell_sha256;  // of cell.toml when the run was made
  std::string fit_sha256;   // fit_hash of the cell; cell_sha256 in runs of earlier versions
  std::vector<format::InputHash> inputs;
  std::vector<std::string> effects;
  Fit fit;
  std::optional<TakenOver> from;
  std::optional<RecheckOf> recheck;  // none: made by `plumb fit`, or by another verb that fits
};

}  // namespace plumb::offline
