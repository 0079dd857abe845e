// SPDX-License-Identifier: Apache-2.0
#include "check/rounding.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "cell/table_place.hpp"
#include "cell/units.hpp"
#include "check/constants.hpp"
#include "plumb/runtime/chain.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// Decimal places of the finest step that is looked for.
constexpr int kMostDigits = 9;
/// Distance from a whole multiple, in steps, that floating-point arithmetic may cause.
constexpr double kWhole = 1e-6;
/// Power of ten of the coarsest step: 10 m in mm, or 10 mm in um.
constexpr int kMostTens = 4;

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
double file_step(const MeasurementFiles& measured, const std::string& name, std::string& unit) {
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

bool multiples(const std::vector<double>& values, double step) {
  return std::all_of(values.begin(), values.end(), [step](double v) {
    const double multiple = v / step;
    return std::abs(multiple - std::round(multiple)) < kWhole + 1e-14 * std::abs(multiple);
  });
}

bool has_different(const std::vector<double>& values, std::size_t count) {
  std::set<double> found;
  for (auto v = values.begin(); v != values.end() && found.size() < count; ++v) found.insert(*v);
  return found.size() >= count;
}

/// The coarsest step of 1, 2, 2.5 or 5 times a power of ten, in the column's unit, of which all
/// values of a measured coordinate are multiples; 0 if there is none, or too few values to tell.
double step_of_point(const Column& column) {
  const auto unit = unit_of(column.unit);
  if (!unit) return 0.0;
  std::vector<double> values;
  for (const double v : column.values) values.push_back(unit->from_si(v));
  if (!has_different(values, check::kFewestValues)) return 0.0;
  for (int tens = kMostTens; tens >= -kMostDigits; --tens)
    for (const double leading : {5.0, 2.5, 2.0, 1.0}) {
      // Dividing by a power of ten keeps 0.1 exact to the last place; multiplying by 1e-1 does not.
      const double step =
          tens >= 0 ? leading * std::pow(10.0, tens) : leading / std::pow(10.0, -tens);
      if (multiples(values, step)) return step;
    }
  return 0.0;
}

struct CoarseAxis {
  const Column* column = nullptr;
  double step = 0.0;  // in the column's unit
  double si = 0.0;
};

/// The coordinate of a file with the coarsest step.
CoarseAxis coarsest_axis(const Table& table) {
  CoarseAxis out;
  for (const char* axis : {"x", "y", "z"}) {
    const Column* column = table.find(axis);
    if (column == nullptr) continue;
    const double step = step_of_point(*column);
    if (step == 0.0) continue;
    const double si = unit_of(column->unit)->to_si(step);
    if (si > out.si) out = {column, step, si};
  }
  return out;
}

}  // namespace

std::array<double, 3> point_steps(const MeasurementFiles& measured) {
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  std::array<double, 3> out{};
  for (const Table& table : measured.tables)
    for (std::size_t k = 0; k < kAxes.size(); ++k)
      if (const Column* column = table.find(kAxes[k]))
        if (const double step = step_of_point(*column); step > 0.0)
          out[k] = std::max(out[k], unit_of(column->unit)->to_si(step));
  return out;
}

std::vector<Problem> coarse_points(const MeasurementFiles& measured, const NoiseFloor& floor) {
  const bool known = floor.source != NoiseFloor::Source::kNone;
  std::vector<Problem> out;
  for (const Table& table : measured.tables) {
    const CoarseAxis axis = coarsest_axis(table);
    const double sigma = axis.si / std::sqrt(12.0);
    if (axis.column == nullptr ||
        (known ? sigma < check::kRoundingSeen * floor.sigma_m : axis.si < check::kCoarseRounding_m))
      continue;
    out.push_back(
        {Severity::kWarning, "W-CHECK-COARSE",
         fmt::format("the measured points are rounded to {:g} {}: that alone is {:.2g} mm of "
                     "scatter an axis{}",
                     axis.step, axis.column->unit, sigma * 1e3,
                     known ? fmt::format(", the noise is {:.2g} mm", floor.sigma_m * 1e3) : ""),
         place_in_header(table, *axis.column,
                         fmt::format("every value is a multiple of {:g}", axis.step)),
         "export the points again with all their digits"});
  }
  return out;
}

std::optional<Rounding> joint_rounding(const Cell& cell, const MeasurementFiles& measured,
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
  const auto thin = thinned(measured, rows, check::kRoundingRows);
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

std::vector<Problem> rounding_findings(const Rounding& rounding, const NoiseFloor& floor,
                                       std::optional<double> left_m) {
  const bool known = floor.source != NoiseFloor::Source::kNone;
  const double rounded = rounding.at_tool_m;
  if (known ? rounded < check::kRoundingSeen * floor.rms_m : rounded < check::kCoarseRounding_m)
    return {};
  if (left_m && *left_m < check::kRoundingLeft * rounded) return {};
  if (!known && (!left_m || *left_m > rounded / check::kRoundingLeft)) return {};
  return {{Severity::kWarning, "W-CHECK-ROUNDED",
           fmt::format("the joint readings are rounded to {:g} {}: that is {:.3g} mm at the tool, "
                       "{} {:.3g} mm",
                       rounding.step_in_unit, rounding.unit, rounded * 1e3,
                       known ? "the noise is" : "and the fit leaves",
                       (known ? floor.rms_m : *left_m) * 1e3),
           std::nullopt, "record more digits; exact commanded values are no harm"}};
}

}  // namespace plumb::offline
