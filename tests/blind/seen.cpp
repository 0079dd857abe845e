// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/seen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "fit/cell_data.hpp"
#include "fit/measured_orientations.hpp"
#include "program/file.hpp"

namespace plumb::tests {

using namespace offline;
namespace fs = std::filesystem;

Seen written_and_read(const BlindCase& blind, std::uint64_t seed) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("plumb_blind_{}", seed);
  fs::create_directories(folder);
  write_file_atomically(folder / "cell.toml", blind.cell_toml);
  write_file_atomically(folder / "measurements.csv", blind.measurements_csv);
  Seen out{read_cell(folder / "cell.toml"), {}};
  out.measured = read_cell_measurements(out.cell);
  fs::remove_all(folder);
  return out;
}

double true_error(ArmState arm, const Simulation& fresh) {
  // Thrown away before the arm works: steps, drift, lag, the tracker.
  for (auto& effect : arm.arm.effects) {
    const EffectInfo& info = *descriptor_of(effect.name).law;
    if (info.domain == EffectDomain::kMeasurement || info.domain == EffectDomain::kProcedure)
      std::fill(effect.parameters.begin(), effect.parameters.end(), 0.0);
  }
  const Rows3 error = fresh.true_p_M - predict_points(arm, fresh.measured);
  return std::sqrt(error.squaredNorm() / static_cast<double>(error.size()));
}

ArmState fitted(const Seen& seen, const std::vector<EffectEntry>& effects) {
  Cell cell = seen.cell;
  cell.effects = effects;
  cell = as_judged(cell, seen.measured);
  std::vector<int> rows(static_cast<std::size_t>(seen.measured.size()));
  std::iota(rows.begin(), rows.end(), 0);
  return calibrate(cell, seen.measured, rows).state;
}

}  // namespace plumb::tests
