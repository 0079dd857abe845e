// SPDX-License-Identifier: Apache-2.0
#include "fleet/summarise.hpp"

#include "cell/fleet_priors.hpp"
#include "cell/setups.hpp"
#include "fit/cell_data.hpp"
#include "fit/effect_binding.hpp"
#include "fit/fit.hpp"
#include "fit/verdict.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"

namespace plumb::offline::fleet {
namespace {

namespace fs = std::filesystem;

std::string sum_of(const fs::path& file) {
  try {
    return sha256(read_file(file));
  } catch (const std::exception&) {
    return "";
  }
}

void put_numbers(const Fit& fit, CellSummary& out) {
  const Calibration& c = fit.calibration;
  std::vector<Eigen::Index> of_arm;
  for (std::size_t i = 0; i < c.estimates.size(); ++i) {
    const Estimate& e = c.estimates[i];
    const Parameter& p = c.parameters[i];
    if (!e.of_robot) continue;
    const bool of_effect = p.of_effect();
    if (of_effect &&
        domain_of(c.state.arm.effects[static_cast<std::size_t>(p.joint)]) != EffectDomain::kRobot)
      continue;
    of_arm.push_back(static_cast<Eigen::Index>(i));
    out.numbers.push_back(
        {.name = e.name,
         .effect =
             of_effect ? c.state.arm.effects[static_cast<std::size_t>(p.joint)].name : "geometry",
         .unit = of_effect     ? e.unit
                 : e.is_length ? "m"
                               : "rad",
         .value = e.value - e.nominal,
         .std = e.std});
  }
  out.covariance = c.covariance(of_arm, of_arm);
}

void fit_into(const fs::path& folder, CellSummary& out) {
  const Cell cell = read_cell(folder / "cell.toml");
  out.robot = cell.robot_name;
  out.serial = cell.serial;
  out.model = model_key(cell.nominal);
  out.tolerance_m = cell.tolerance_m;
  for (const auto& effect : cell.effects) out.effects.push_back(effect.name);
  const MeasurementFiles measured = read_cell_measurements(cell);
  const Fit fit = fit_cell(cell, measured);
  out.held = fit.held;
  out.floor_m = fit.floor.mean_m;
  out.good = fit.held.n > 0 && keeps(fit.held, cell.tolerance_m);
  out.verdict = verdict(fit, cell.tolerance_m);
  put_numbers(fit, out);
  out.ok = true;
}

}  // namespace

std::vector<SummaryInput> inputs_of(const fs::path& folder) {
  std::vector<SummaryInput> out{{"cell.toml", sum_of(folder / "cell.toml")}};
  try {
    const Cell cell = read_cell(folder / "cell.toml");
    for (const auto& file : measurement_files(cell.measurement))
      out.push_back({file.lexically_proximate(cell.directory).generic_string(), sum_of(file)});
  } catch (const std::exception&) {
    // Its summary will say why.
  }
  return out;
}

CellSummary summarise(const fs::path& folder) {
  CellSummary out;
  out.name = folder.filename().string();
  out.inputs = inputs_of(folder);
  try {
    fit_into(folder, out);
  } catch (const Failure& failure) {
    out.error_code = failure.problems().front().code;
    out.error = failure.problems().front().message;
  } catch (const fs::filesystem_error& failure) {
    out.error_code = "E-READ";
    out.error = failure.code().message();
  }
  return out;
}

}  // namespace plumb::offline::fleet
