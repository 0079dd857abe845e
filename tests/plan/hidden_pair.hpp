// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulate/simulate.hpp"

/// Simulated arms whose hidden effect a diagnosis cannot tell from another one, and their
/// measurement at planned poses.
namespace plumb::offline {

/// One reading of a plan, as an operator would carry it out. SI.
struct PlannedReading {
  Eigen::VectorXd q;
  std::optional<Eigen::VectorXd>
      from;                        // the arm goes there first; else straight from the last pose
  std::optional<Payload> payload;  // else that of the cell
  bool warm = false;               // after the arm has run for some time
};

/// The true effect, and one that explains the poses measured so far nearly as well.
struct HiddenPair {
  Cell cell;
  SimulationPlan recipe;  // of the first measurement
  Simulation first;
  std::string first_csv;
  EffectEntry truth, rival;
  double lead = 0.0;        // ln B of the true one less that of the other [nats]
  double carries_kg = 0.0;  // the heaviest load of the arm
  std::string separate;     // the measurement that the diagnosis recommends
  std::string words;        // "gear_harmonics:J2 or gravity_compensator:J2"
};

/// Joins measurement files as the programs read them.
MeasurementFiles read_files(const Cell& cell, const std::vector<std::string>& texts);

/// The arm of a number, if a diagnosis of its first measurement (45 to 150 poses) lists the truth,
/// one of the two is its first candidate, both can replace each other, and neither leads the other
/// by 10 nats.
std::optional<HiddenPair> hidden_pair(std::uint64_t number);

/// The measurement file of planned readings on the arm of a pair, taken after the first ones.
std::string measured_csv(const HiddenPair& pair, const std::vector<PlannedReading>& plan);

/// By how much the truth leads the other one when all is diagnosed together [nats]. One that is no
/// longer in the list is behind the last one of it.
double lead_with(const HiddenPair& pair, const std::string& second_csv);

}  // namespace plumb::offline
