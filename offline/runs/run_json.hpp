// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "runs/run.hpp"

namespace plumb::offline {

/// run.json: everything of a run except the poses. SI, full precision.
nlohmann::ordered_json run_to_json(const Run& run);

/// Reads run.json. Throws nlohmann::json::exception if the content is not a run.
Run run_from_json(const nlohmann::ordered_json& j);

/// noise_floor.json: the noise floor as a diagnosis of the model found it. SI.
nlohmann::ordered_json floor_to_json(const NoiseFloor& floor);

/// Reads noise_floor.json. Throws as `run_from_json`, or Failure (kInput) if the schema is another.
NoiseFloor floor_from_json(const nlohmann::ordered_json& j);

/// predictions.csv: pose, set, fold, predicted point, error of the orientation where it is fitted,
/// and in `note` the digest of the reading.
std::string predictions_to_csv(const Measurements& measured, const Fit& fit);

/// Fills split and predictions of `fit` from predictions.csv, and returns the SHA-256 sum of the
/// file. Throws Failure (kInput) if the file is damaged.
std::string predictions_from_csv(const std::filesystem::path& file, Fit& fit);

}  // namespace plumb::offline
