// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fit/fit.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// What a run is that `plumb recheck` made: an earlier run with what had changed since refitted.
/// Its `fit` is of the new readings alone, each predicted by a refit without it.
struct RecheckOf {
  int parent = 0;           // number of the run that was rechecked
  std::string verdict;      // "true", "changed", "undecidable"
  std::string words;        // the same as one sentence
  ErrorStats before;        // error of the parent at the readings
  double expected_m = 0.0;  // mean error that the parent promised there
  double limit_m = 0.0;     // control limit: three standard deviations above that
};

/// What a run whose fit took numbers over from another one goes back to; the fit says what it took.
struct TakenOver {
  std::string check_sum;            // of the run.json of the other one
  std::vector<std::string> inputs;  // check sums of all readings of the other one
};

/// A kept fit: runs/0001/run.json and predictions.csv beside the cell file. Immutable once made; a
/// diagnosis of its model adds noise_floor.json and diagnosis.json, and a later one replaces them.
struct Run {
  int number = 0;
  std::filesystem::path directory;
  std::string created;      // ISO 8601, UTC
  std::string cell_sha256;  // of cell.toml as it was
  std::string fit_sha256;   // fit_hash of it; of a run of an earlier version, its cell_sha256
  std::vector<format::InputHash> inputs;
  std::vector<std::string> effects;
  Fit fit;
  std::optional<TakenOver> from;
  std::optional<RecheckOf> recheck;  // none: it was made by `plumb fit`, or a verb that fits
};

}  // namespace plumb::offline
