// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "answers/answers.hpp"
#include "noise/error_stats.hpp"
#include "program/json.hpp"

namespace plumb::offline::fleet {

/// Something that a summary was made from.
struct SummaryInput {
  std::string file;  // relative to the cell's folder; "plumb": the version of the program
  std::string sha256;
  bool of_measurement = false;
  bool operator==(const SummaryInput&) const = default;
};

/// A number of the arm as the readings alone show it, with hardly any prior: its difference from
/// nominal, or the size of an effect. SI.
struct ArmNumber {
  std::string name;    // "J2.d", "joint_compliance.J2.c"
  std::string effect;  // "geometry", or the effect that it belongs to
  std::string unit;    // SI
  double value = 0.0;
  double std = 0.0;  // 1 sigma
};

/// The best candidate of one effect of the arm.
struct EffectEvidence {
  std::string effect;
  double ln_bayes = 0.0;
};

/// What a diagnosis of a cell says.
struct CellDiagnosis {
  std::string finding;                   // "complete", "missing", "unknown", "undecidable"
  std::string effect;                    // of "missing": the first one
  std::vector<std::string> joints;       // and where
  std::string words;                     // one sentence
  std::vector<EffectEvidence> evidence;  // effect by effect
};

/// What is known of one cell of a fleet: the result of fitting it as it stands.
struct CellSummary {
  std::string name;  // of its folder
  std::string arm;   // as its cell.toml calls it
  std::vector<SummaryInput> inputs;
  bool ok = false;
  std::string error_code, error;  // of a cell that could not be fitted
  std::string robot, serial;
  std::string model;  // equal for arms of one nominal chain
  double tolerance_m = 0.0;
  ErrorStats held;
  double floor_m = 0.0;                   // mean error that noise alone would leave; 0: not known
  Answers answers;                        // what people ask first; empty: it could not be fitted
  std::string verdict_head;               // the same in few words
  std::string verdict_class = "unknown";  // "good", "partly", "bad", "unknown"
  bool good = false;                      // the held-out error keeps the tolerance
  std::vector<std::string> effects;
  std::optional<CellDiagnosis> diagnosis;  // none: it was not asked for
  std::vector<ArmNumber> numbers;
  Eigen::MatrixXd covariance;  // of the numbers, SI
};

/// The content of a file of the results folder; SI, full precision, the same bytes for the same
/// cell on every machine.
Json to_json(const CellSummary& summary);

/// The reverse; throws nlohmann::json::exception on content that is no summary of this version.
CellSummary summary_from(const Json& json);

}  // namespace plumb::offline::fleet
