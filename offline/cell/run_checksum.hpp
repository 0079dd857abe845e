// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "program/json.hpp"

/// A run must be what was fitted: its files carry SHA-256 sums, so that one that was edited, cut
/// off or mixed up is not compiled into a model. They guard against accidents, not against forgery.
namespace plumb::offline {

/// The text of run.json with the sum of predictions.csv, and as its last key the sum of the text
/// itself, taken with zeros in the place of that sum.
std::string with_checksums(Json run, const std::string& predictions_csv);

/// True if the sums are right. A run of an earlier version, which wrote none, counts as right.
bool json_sum_holds(const std::string& run_json_text);
bool predictions_sum_holds(const Json& run, const std::string& predictions_csv);

/// The same of a text of which the SHA-256 sum is known.
bool is_predictions_sum(const Json& run, const std::string& sha256_of_csv);

/// False of a run that was written before there were sums; throws Failure if it cannot be read.
bool has_checksums(const std::filesystem::path& run_folder);

}  // namespace plumb::offline
