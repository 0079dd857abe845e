// SPDX-License-Identifier: Apache-2.0
#include "check/rounding.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cell/units.hpp"
#include "fit/parameter_subset.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

constexpr int kMostDigits = 9;
constexpr double kWhole = 1e-6;  // of a step: what floating point may add
constexpr int kMostRows = 500;

/// The coarsest power of ten of which all values are multiples, in the column's unit; 0 if finer
/// than 1e-9 or if nothing but zeros is there.
double step_of(const Column& column) {
  const auto unit = unit_of(column.unit);
  if (!unit) return 0.0;
  double largest = 0.0;
  for (const double v : column.values) largest = std::max(largest, std::abs(unit->from_si(v)));
  if (!(largest > 0.0)) return 0.0;
  for (int digits = 0; digits <= kMostDigits; ++digits) {
    const double scale = std::pow(10.0, digits);
    bool all = true;
    for (const double v : column.values) {
      const double multiple = unit->from_si(v) * scale;
      all = std::abs(multiple - std::round(multiple)) < kWhole + 1e-14 * std::abs(multiple);
      if (!all) break;
    }
    if (all) return 1.0 / scale;
  }
  return 0.0;
}

/// The joint column of every file, coarsest step first found.
double file_step(const Measurements& measured, const std::string& name, std::string& unit) {
  double finest = 0.0;
  for (const auto& table : measured.tables) {
    const Column* column = table.find(name);
    if (column == nullptr) return 0.0;
    const double step = step_of(*column);
    if (step == 0.0) return 0.0;
    finest = finest == 0.0 ? step : std::min(finest, step);
    unit = column->unit;
  }
  return finest;
}

}  // namespace

std::optional<Rounding> joint_rounding(const Cell& cell, const Measurements& measured,
                                       const std::vector<int>& rows, const ArmState& placed) {
  Rounding out;
  std::vector<double> sigma(cell.joints(), 0.0);
  for (int j = 0; j < cell.joints(); ++j) {
    std::string unit;
    const double step = file_step(measured, fmt::format("q{}", j + 1), unit);
    if (step == 0.0) continue;
    const double si = unit_of(unit)->to_si(step);
    sigma[j] = si / std::sqrt(12.0);
    if (si <= out.step) continue;
    out.step = si;
    out.unit = unit;
    out.step_in_unit = step;
  }
  if (out.step == 0.0) return std::nullopt;
  const Chain chain(placed.arm.calibrated);
  const Vector3 target(placed.X_TG.p[0], placed.X_TG.p[1], placed.X_TG.p[2]);
  const auto thin = thinned(rows, kMostRows);
  double squares = 0.0;
  ChainFrames frames;
  for (const int i : thin) {
    const auto q = measured.q.row(i);
    chain.frames({q.data(), static_cast<std::size_t>(q.cols())}, frames);
    const Vector3 tip = frames.tip * target;
    for (int j = 0; j < cell.joints(); ++j) {
      const Vector3 z = frames.joint[j].R.col(2);
      const double lever = chain.revolute(j) ? z.cross(tip - frames.joint[j].p).norm() : 1.0;
      squares += std::pow(lever * sigma[j], 2);
    }
  }
  out.at_tool_m = std::sqrt(squares / static_cast<double>(thin.size()));
  return out;
}

}  // namespace plumb::offline
