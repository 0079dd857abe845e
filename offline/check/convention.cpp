// SPDX-License-Identifier: Apache-2.0
#include "check/convention.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cell/setups.hpp"
#include "cell/toml_text.hpp"
#include "cell/units.hpp"
#include "check/constants.hpp"
#include "check/unit_guess.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {
namespace {

bool slides(const Cell& cell, int joint) {
  return cell.nominal.joints[joint].type == format::JointType::kPrismatic;
}

std::string unit_in_file(const MeasurementFiles& measured, const std::string& name,
                         const std::string& fallback) {
  for (const auto& table : measured.tables)
    if (const Column* column = table.find(name)) return column->unit;
  return fallback;
}

/// Factor of a joint's readings by the unit of its own column or, if it has none, of all.
double own_ratio(const Convention& meant, int joint, const std::string& now, double of_all) {
  const std::string& own = meant.own_unit[static_cast<std::size_t>(joint)];
  return own.empty() ? of_all : unit_ratio(own, now);
}

std::string column_of(int joint) { return fmt::format("q{}", joint + 1); }

/// What a mirror does to points: coordinate k becomes sign[k] times the coordinate from[k].
struct AxisChange {
  std::array<int, 3> from{0, 1, 2};
  std::array<double, 3> sign{1.0, 1.0, 1.0};
};

AxisChange axis_change(Mirror mirror) {
  AxisChange out;
  switch (mirror) {
    case Mirror::kNone:
      break;
    case Mirror::kNegateX:
    case Mirror::kNegateY:
    case Mirror::kNegateZ:
      out.sign[static_cast<int>(mirror) - 1] = -1.0;
      break;
    case Mirror::kSwapXY:
      out.from = {1, 0, 2};
      break;
    case Mirror::kSwapYZ:
      out.from = {0, 2, 1};
      break;
    case Mirror::kSwapXZ:
      out.from = {2, 1, 0};
  }
  return out;
}

void mirror_points(Measurements& m, Mirror mirror) {
  if (mirror == Mirror::kNone) return;
  const AxisChange change = axis_change(mirror);
  const Rows3 before = m.p_M;
  for (int k = 0; k < 3; ++k) m.p_M.col(k) = change.sign[k] * before.col(change.from[k]);
  if (!m.has_orientation()) return;
  // The rotation becomes S R S. The vector part of a quaternion is a pseudovector, so its sign
  // changes with det S = -1.
  const Rows4 quat = m.quat_M;
  for (int k = 0; k < 3; ++k) m.quat_M.col(k + 1) = -change.sign[k] * quat.col(change.from[k] + 1);
}

CellEdit text_edit(const Convention& present, const Convention& meant) {
  CellEdit out;
  if (meant.dh != present.dh)
    out.dh_convention = meant.dh == format::Convention::kStandard ? "standard" : "modified";
  if (meant.length_unit != present.length_unit) out.length_unit = meant.length_unit;
  if (meant.angle_unit != present.angle_unit) out.angle_unit = meant.angle_unit;
  return out;
}

Cell reread(const Cell& cell, const CellEdit& edit) {
  if (edit.empty()) return cell;
  const std::string text = cell.text.empty() ? write_cell(cell) : cell.text;
  const auto file = cell.file.empty() ? std::filesystem::path("cell.toml") : cell.file;
  CellEdit alone = edit;
  // In another convention the arm differs from what its fleet has learned, so that prior is
  // dropped.
  if (!cell.fit.prior_from.empty()) alone.prior_from = "";
  Cell out = parse_cell(edited(text, file.string(), alone), file);
  out.measurement.files = cell.measurement.files;
  // The text may have several set-ups of which `cell` has one.
  const auto& of_cell = cell.measurement.setups;
  const auto& of_text = out.measurement.setups;
  if (of_cell.size() == 1 && of_text.size() > 1)
    for (std::size_t k = 0; k < of_text.size(); ++k)
      if (of_text[k].name == of_cell.front().name) return cell_of_setup(out, static_cast<int>(k));
  return out;
}

format::Pose inverse(const format::Pose& pose) { return to_pose(from_pose(pose).inverse()); }

}  // namespace

Convention labelled_convention(const Cell& cell, const MeasurementFiles& measured) {
  Convention out;
  out.dh = cell.nominal.convention;
  out.length_unit = cell.length_unit;
  out.angle_unit = cell.angle_unit;
  out.turn_unit = "deg";
  out.slide_unit = "mm";
  for (int j = 0; j < cell.joints(); ++j)
    (slides(cell, j) ? out.slide_unit : out.turn_unit) =
        unit_in_file(measured, column_of(j), slides(cell, j) ? "mm" : "deg");
  out.point_unit = "mm";
  for (const char* axis : {"z", "y", "x"})
    out.point_unit = unit_in_file(measured, axis, out.point_unit);
  out.reversed.assign(cell.joints(), false);
  out.quarter_turns.assign(cell.joints(), 0);
  out.zero.assign(static_cast<std::size_t>(cell.joints()), 0.0);
  out.factor.assign(static_cast<std::size_t>(cell.joints()), 1.0);
  out.own_unit.resize(static_cast<std::size_t>(cell.joints()));
  out.column.resize(static_cast<std::size_t>(cell.joints()));
  std::iota(out.column.begin(), out.column.end(), 0);
  out.coupling = cell.nominal.coupling;
  return out;
}

double changes(const Convention& present, const Convention& other) {
  double out = 0.0;
  out += other.dh != present.dh ? 1.0 : 0.0;
  out += other.length_unit != present.length_unit ? 1.0 : 0.0;
  out += other.angle_unit != present.angle_unit ? 1.0 : 0.0;
  out += other.turn_unit != present.turn_unit ? 1.0 : 0.0;
  out += other.slide_unit != present.slide_unit ? 1.0 : 0.0;
  out += other.point_unit != present.point_unit ? 1.0 : 0.0;
  out += other.mirror != present.mirror ? check::kMirrorCosts : 0.0;
  out += other.frame_inverted != present.frame_inverted ? 1.0 : 0.0;
  for (std::size_t j = 0; j < other.reversed.size(); ++j) {
    out += other.reversed[j] != present.reversed[j] ? 1.0 : 0.0;
    out += other.quarter_turns[j] != present.quarter_turns[j] ? check::kQuarterTurnCosts : 0.0;
    out += other.column[j] != present.column[j] ? 1.0 : 0.0;
    out += other.zero[j] != present.zero[j] ? check::kZeroCosts : 0.0;
    out += other.own_unit[j] != present.own_unit[j] ? check::kOwnUnitCosts : 0.0;
    out += other.factor[j] != present.factor[j] ? check::kFactorCosts : 0.0;
  }
  const double couplings =
      static_cast<double>(std::max(present.coupling.size(), other.coupling.size()));
  return out + (other.coupling != present.coupling ? check::kCouplingCosts * couplings : 0.0);
}

Cell read_as(const Cell& cell, const Convention& present, const Convention& meant) {
  Cell out = reread(cell, text_edit(present, meant));
  for (int j = 0; j < out.joints(); ++j) {
    auto& row = out.nominal.joints[j];
    row.theta += M_PI_2 * meant.quarter_turns[j];
    row.offset += meant.zero[j];
  }
  out.nominal.coupling = meant.coupling;
  if (!meant.frame_inverted) return out;
  out.measurement.X_MB = inverse(out.measurement.X_MB);
  for (auto& setup : out.measurement.setups)
    if (!setup.fit_frame && !setup.frame_of) setup.X_MB = inverse(setup.X_MB);
  return out;
}

Measurements read_as(const Measurements& measured, const Cell& cell, const Convention& present,
                     const Convention& meant) {
  Measurements out = measured;
  RowsN values = measured.q;
  to_values(Coupling(present.coupling), values);
  const double turn = unit_ratio(meant.turn_unit, present.turn_unit);
  const double slide = unit_ratio(meant.slide_unit, present.slide_unit);
  for (int j = 0; j < cell.joints(); ++j)
    out.q.col(j) = (slides(cell, j) ? slide : own_ratio(meant, j, present.turn_unit, turn)) *
                   meant.factor[j] * (meant.reversed[j] ? -1.0 : 1.0) * values.col(meant.column[j]);
  to_angles(Coupling(meant.coupling), out.q);
  out.p_M *= unit_ratio(meant.point_unit, present.point_unit);
  mirror_points(out, meant.mirror);
  return out;
}

MeasurementFiles read_as(const MeasurementFiles& measured, const Cell& cell,
                         const Convention& present, const Convention& meant) {
  return {read_as(static_cast<const Measurements&>(measured), cell, present, meant),
          measured.tables};
}

CellEdit cell_edit(const Cell& cell, const Convention& present, const Convention& meant) {
  CellEdit out = text_edit(present, meant);
  const double angle = unit_ratio(meant.angle_unit, present.angle_unit);
  for (int j = 0; j < cell.joints(); ++j)
    if (meant.quarter_turns[j] != 0)
      out.theta[j] = cell.nominal.joints[j].theta * angle + M_PI_2 * meant.quarter_turns[j];
  for (int j = 0; j < cell.joints(); ++j)
    if (meant.zero[j] != 0.0) out.offset[j] = cell.nominal.joints[j].offset * angle + meant.zero[j];
  if (meant.coupling != present.coupling)
    out.coupling = toml_coupling(read_as(cell, present, meant).nominal);
  if (meant.frame_inverted) out.frame = read_as(cell, present, meant).measurement.X_MB;
  return out;
}

MeasurementEdit measurement_edit(const Cell& cell, const Convention& present,
                                 const Convention& meant) {
  MeasurementEdit out;
  for (int j = 0; j < cell.joints(); ++j) {
    const std::string& now = slides(cell, j) ? present.slide_unit : present.turn_unit;
    const std::string& own = meant.own_unit[j];
    const std::string& unit = slides(cell, j) ? meant.slide_unit
                              : own.empty()   ? meant.turn_unit
                                              : own;
    const int from = meant.column[j];
    if (meant.factor[j] != 1.0) out.factors[column_of(from)] = meant.factor[j];
    if (unit != now) out.units[column_of(from)] = unit;
    for (const char* prefix : {"q", "qc", "dir_j"}) {
      const std::string held = fmt::format("{}{}", prefix, from + 1);
      if (from != j) out.names[held] = fmt::format("{}{}", prefix, j + 1);
      if (meant.reversed[j]) out.negated.insert(held);
    }
  }
  const AxisChange change = axis_change(meant.mirror);
  const std::array<std::string, 3> axes{"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    if (meant.point_unit != present.point_unit) out.units[axes[k]] = meant.point_unit;
    if (change.sign[k] < 0) out.negated.insert(axes[k]);
    if (change.from[k] == k) continue;
    out.names[axes[change.from[k]]] = axes[k];
    out.names["s" + axes[change.from[k]]] = "s" + axes[k];
  }
  return out;
}

}  // namespace plumb::offline
