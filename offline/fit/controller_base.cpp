// SPDX-License-Identifier: Apache-2.0
#include "fit/controller_base.hpp"

#include <fmt/format.h>

#include <numeric>

#include "arm/parameter.hpp"
#include "arm/predicted_points.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "solve/constants.hpp"

namespace plumb::offline {
namespace {

std::string file_of(const MeasurementFiles& measured) {
  return measured.tables.empty() ? std::string() : measured.tables.front().file;
}

/// The controller's positions in the form of measured points.
Measurements said_by_controller(const MeasurementFiles& measured) {
  if (measured.nominal_B.rows() == 0)
    throw Failure(Exit::kInput,
                  {.code = "E-FIT-BASE",
                   .message = "there are no positions of the controller's own: columns nx_mm, "
                              "ny_mm, nz_mm",
                   .place = Place{.file = file_of(measured)},
                   .help = "to calibrate the arm of the cell: plumb fit"});
  Measurements out = measured;
  out.p_M = measured.nominal_B;
  if (out.has_axis == std::array{false, false, false}) out.has_axis = {true, true, true};
  out.sigma_m.resize(0, 3);
  out.quat_M.resize(0, 4);
  out.departure_B.resize(0, 3);
  out.setup.clear();  // the controller has one frame and one tool, whatever moved the tracker
  return out;
}

/// The nominal arm with the frame and the tool that the controller uses.
ArmState placed_by_controller(const Cell& cell, const Measurements& said) {
  Cell alone = cell;
  alone.measurement.setups.clear();
  alone.measurement.fit_frame = alone.measurement.fit_target = true;
  std::erase_if(alone.effects, [](const EffectEntry& e) { return !is_geometry(e.name); });
  std::vector<int> rows(static_cast<std::size_t>(said.size()));
  std::iota(rows.begin(), rows.end(), 0);
  return place_nominal(alone, said, rows);
}

void check_same_arm(const Cell& cell, const MeasurementFiles& measured) {
  const double mean = departure_of(measured).mean;
  if (mean < kMostMissed * reach(cell.nominal)) return;
  throw Failure(
      Exit::kInput,
      {.code = "E-FIT-BASE-FAR",
       .message = fmt::format("the controller's positions (nx, ny, nz) are {:.1f} mm off the "
                              "nominal arm in the mean, whatever frame and tool it uses",
                              mean * 1e3),
       .place = Place{.file = file_of(measured)},
       .help = "look at units and order of these columns, and at [robot] joints: plumb check"});
}

}  // namespace

void stand_on_controller(const Cell& cell, MeasurementFiles& measured) {
  stand_on_controller(cell, measured, measured);
}

void stand_on_controller(const Cell& cell, const MeasurementFiles& measured,
                         MeasurementFiles& rows) {
  const ArmState placed = placed_by_controller(cell, said_by_controller(measured));
  const Measurements said = said_by_controller(rows);
  rows.departure_B = to_base(placed, said, residuals(said, predict_points(placed, said)));
  check_same_arm(cell, rows);
}

Departure departure_of(const Measurements& measured) {
  if (measured.departure_B.rows() == 0) return {};
  const Eigen::VectorXd size = measured.departure_B.rowwise().norm();
  return {.mean = size.mean(), .max = size.maxCoeff()};
}

}  // namespace plumb::offline
