// SPDX-License-Identifier: Apache-2.0
#include "fit/distance_unit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "arm/predicted_points.hpp"
#include "cell/artefacts.hpp"
#include "cell/table_place.hpp"
#include "numbers/quantile.hpp"
#include "solve/frame_start.hpp"

namespace plumb::offline {
namespace {

constexpr int kFewestReadings = 10;  // of an anchor
/// A unit is meant if the scale lies so near to it. Chosen: the target, which is hardly known, is a
/// tenth of the distances away from the flange.
constexpr double kNear = 0.25;

struct Unit {
  double times;  // of the one that is written
  const char* words;
};
constexpr Unit kUnits[] = {{25.4, "as inches are to mm"},   {1.0 / 25.4, "as mm are to inches"},
                           {1000.0, "as metres are to mm"}, {1e-3, "as mm are to metres"},
                           {10.0, "as cm are to mm"},       {0.1, "as mm are to cm"}};

/// By how much the distances d must be multiplied so that they meet in one centre c:
///
///   |p|^2 = 2 p c + s^2 d^2 + 2 s l d + (l^2 - |c|^2)
///
/// with the zero l only where it is unknown. Nothing if no such scale is positive.
std::optional<double> scale_of(const Rows3& p, const Eigen::VectorXd& d, bool fit_length) {
  const Rows3 centred = p.rowwise() - p.colwise().mean();
  Eigen::MatrixXd A(p.rows(), fit_length ? 6 : 5);
  A.leftCols(3) = 2.0 * centred;
  A.col(3).setOnes();
  A.col(4) = d.cwiseAbs2();
  if (fit_length) A.col(5) = d;
  const Eigen::VectorXd x =
      A.completeOrthogonalDecomposition().solve(centred.rowwise().squaredNorm());
  return x(4) > 0.0 ? std::optional(std::sqrt(x(4))) : std::nullopt;
}

std::vector<double> scales_of(const Cell& cell, const Measurements& measured) {
  std::map<int, std::vector<int>> rows;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.kind_of(i) == ReadingKind::kDistance) rows[setup_of(measured, i)].push_back(i);
  ArmState nominal;
  nominal.arm.calibrated = cell.nominal;
  place_as_given(cell.measurement, nominal);
  std::vector<double> out;
  for (const auto& [setup, of_one] : rows) {
    if (static_cast<int>(of_one.size()) < kFewestReadings) continue;
    const Measurements some = pick(measured, of_one);
    const bool fit_length = cell.measurement.setups[static_cast<std::size_t>(setup)].fit_length;
    const auto scale = scale_of(predict_targets(nominal, some), some.p_M.col(0), fit_length);
    if (scale) out.push_back(*scale);
  }
  return out;
}

}  // namespace

void warn_of_distance_unit(const Cell& cell, MeasurementFiles& measured) {
  if (measured.kind.empty()) return;
  const std::vector<double> scales = scales_of(cell, measured);
  if (scales.empty()) return;
  const double scale = median(scales);
  for (const Unit& unit : kUnits) {
    if (std::abs(std::log(scale / unit.times)) > kNear) continue;
    auto& table = *std::find_if(measured.tables.begin(), measured.tables.end(), [](const Table& t) {
      return kind_of(t) == ReadingKind::kDistance;
    });
    const Column& column = *value_column(table);
    table.remarks.push_back(
        {Severity::kWarning, "W-FIT-UNIT",
         fmt::format(
             "the nominal arm meets these distances only if they are {:.3g} times as large, {}",
             scale, unit.words),
         place_in_header(table, column, "which unit?"),
         "write the unit of the numbers into the name of the column"});
    return;
  }
}

}  // namespace plumb::offline
