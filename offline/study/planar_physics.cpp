// SPDX-License-Identifier: Apache-2.0
#include "study/planar_physics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "diagnose/diagnosis.hpp"
#include "fit/calibrate.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline::study {
namespace {

constexpr double kLeastSigma_m = 1e-6;  // stated for a tracker without noise

ArmState calibrated(const Cell& cell, const MeasurementFiles& measured) {
  std::vector<int> rows(measured.size());
  std::iota(rows.begin(), rows.end(), 0);
  return calibrate(cell, measured, rows).state;
}

std::string words_for(const EffectEntry& entry) {
  std::vector<std::string> joints;
  for (int j : entry.joints) joints.push_back(fmt::format("J{}", j + 1));
  return fmt::format("{} {}", entry.name, fmt::join(joints, ", "));
}

}  // namespace

PlanarCell measured_cell(const PlanarMeasuring& measuring) {
  PlanarCell out{
      .cell = planar_cell(measuring.variant), .measured = {}, .csv = {}, .truth_json = {}};
  out.cell.measurement.sigma_m = std::max(measuring.noise_m, kLeastSigma_m);
  out.cell.measurement.seed = measuring.seed;
  SimulationPlan plan;
  plan.q = measuring.q;
  plan.axes = {true, true, false};
  plan.noise_m = measuring.noise_m;
  plan.seed = measuring.seed;
  plan.truth.effects = {measuring.variant == PlanarVariant::kPublished ? "planar_published"
                                                                       : "planar_printed"};
  Simulation simulation = simulate(out.cell, plan);
  out.csv = simulated_csv(out.cell, simulation);
  out.truth_json = simulation.truth_json;
  out.measured = std::move(simulation.measured);
  return out;
}

ArmState with_link_flexure(const PlanarCell& planar) {
  Cell cell = planar.cell;
  cell.effects.push_back({.name = "link_flexure", .joints = {0, 1}, .options = {}, .place = {}});
  return calibrated(cell, planar.measured);
}

PlanarDiagnosis diagnosed(const PlanarCell& planar) {
  const Diagnosis found = diagnose(planar.cell, planar.measured, {.apply = true, .tell = {}});
  Cell cell = planar.cell;
  cell.effects = found.effects;
  std::vector<std::string> added;
  for (const auto& step : found.added) added.push_back(words_for(step.entry));
  return {.state = calibrated(cell, planar.measured),
          .verdict = found.text_after,
          .added = added.empty() ? "nothing" : fmt::format("{}", fmt::join(added, "; "))};
}

Samples points(const ArmState& state, const RowsN& q) {
  const Rows3 p_M = predict_points(state, q);
  Samples out = p_M.leftCols<2>();
  out.col(1).array() -= kPlanarOriginY_m;
  return out;
}

}  // namespace plumb::offline::study
