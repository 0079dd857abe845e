// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "check/identifiability.hpp"
#include "effects/fitted_laws.hpp"
#include "fit/calibrate.hpp"

/// What a check says of a cell whose model holds an effect.
namespace plumb::offline {
namespace {

constexpr int kPoses = 120;

/// A six-axis arm with masses, so that every law of a load can work.
Cell heavy_arm() {
  Cell cell = parse_cell(
      "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\njoints = [\n"
      "{ alpha = -90, a = 150, d = 450, q = [-160, 160] },\n"
      "{ a = 600, q = [-150, 60], parallel_next = true },\n"
      "{ alpha = -90, a = 120, q = [-120, 120] },\n"
      "{ alpha = 90, d = 640, q = [-180, 180] },\n"
      "{ alpha = -90, a = 30, q = [-115, 115] },\n"
      "{ d = 95, q = [-180, 180] }]\n",
      "/cell/cell.toml");
  for (auto& m : cell.mechanics) {
    m.link_mass_kg = 20.0;
    m.link_com_m = {0.1, 0.03, -0.05};
  }
  cell.payload = {20.0, {0.02, -0.03, 0.1}};
  return cell;
}

/// Random poses with every context there is; noise of 10 um.
MeasurementFiles rich_measurements(const Cell& cell) {
  std::mt19937_64 dice(5);
  std::uniform_real_distribution<double> share;
  std::normal_distribution<double> normal;
  ArmState truth;
  truth.arm.nominal = truth.arm.calibrated = cell.nominal;
  for (auto& row : truth.arm.calibrated.joints)
    for (double* number : {&row.theta, &row.d, &row.a, &row.alpha}) *number += 3e-4 * normal(dice);
  truth.X_MB.p = {2.1, -1.2, 0.3};
  truth.X_TG.p = {0.03, 0.02, 0.12};
  MeasurementFiles m;
  m.q.resize(kPoses, cell.joints());
  for (Eigen::Index i = 0; i < kPoses; ++i)
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
      m.q(i, j) = row.q_min + share(dice) * (row.q_max - row.q_min);
    }
  m.p_M = predict_points(truth, m.q);
  for (Eigen::Index i = 0; i < m.p_M.size(); ++i) m.p_M.data()[i] += 10e-6 * normal(dice);
  m.pose.assign(kPoses, "p");
  m.set.assign(kPoses, SetMark::kUnmarked);
  m.replicate_group.resize(kPoses);
  std::iota(m.replicate_group.begin(), m.replicate_group.end(), 0);
  const auto fill = [&](RowsN& to, int columns, double low, double high) {
    to.resize(kPoses, columns);
    for (Eigen::Index i = 0; i < to.size(); ++i) to.data()[i] = low + share(dice) * (high - low);
  };
  fill(m.context.direction, cell.joints(), -1.0, 1.0);
  m.context.direction = m.context.direction.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; });
  fill(m.context.travel, cell.joints(), 0.0, 0.05);
  fill(m.context.payload, 4, 0.0, 0.3);
  m.context.payload.col(0) *= 100.0;
  fill(m.context.wrench, 6, -50.0, 50.0);
  m.context.sensors = {"temp_base", "temp_arm"};
  fill(m.context.temperature, 2, 15.0, 30.0);
  return m;
}

EffectEntry entry_of(const std::string& name) {
  EffectEntry out{.name = name, .joints = {}, .options = {}, .place = {}};
  if (name == "gear_ripple") out.options["cycles_per_turn"] = 8.5;
  if (name == "cross_compliance" || name == "drive_coupling") out.joints = {2, 1};
  if (name == "joint_table") out.joints = {1};
  if (name == "gravity_free") out.joints = {1, 2};
  if (name == "axis_wobble" || name == "rail_bow" || name == "pitch_error") out.joints = {0, 3};
  if (name == "pitch_error") out.options["pitch_mm"] = 450.0;
  if (name == "step") out.options["after_row"] = 60.0;
  if (name == "step") out.options["of"] = std::string("base");
  if (name == "thermal_growth") out.options["sensor"] = std::string("temp_arm");
  return out;
}

/// Every name that a report speaks of is one of the numbers that the calibration could fit.
void names_are_known(const Cell& cell, const MeasurementFiles& m, const IdentifiabilityReport& r) {
  std::set<std::string> known;
  for (const auto& p : calibration_candidates(cell, m, r.calibration.state)) known.insert(p.name);
  for (int j = 0; j < cell.joints(); ++j)
    known.insert(cell.nominal.joints[static_cast<std::size_t>(j)].name + ".d");
  for (const auto& p : r.calibration.parameters) EXPECT_TRUE(known.contains(p.name)) << p.name;
  for (const auto& s : r.separations) {
    EXPECT_TRUE(known.contains(s.parameter)) << s.parameter;
    for (const auto& partner : s.partners) EXPECT_TRUE(known.contains(partner)) << partner;
  }
  EXPECT_LE(r.rank, r.candidates);
  EXPECT_TRUE(std::isfinite(r.scaled_condition));
}

// The derivatives once belonged to other parameters than those that the calibration had used.
TEST(Identifiability, SpeaksOfTheNumbersOfTheCalibrationWhateverEffectIsInTheModel) {
  const Cell cell = heavy_arm();
  const MeasurementFiles m = rich_measurements(cell);
  std::vector<int> rows(kPoses);
  std::iota(rows.begin(), rows.end(), 0);
  int looked_at = 0;
  for (int law = 0; law < kFittedLaws; ++law) {
    const std::string name(fitted_law_info(law).name);
    if (name == "formula") continue;  // has no numbers before a user writes some
    SCOPED_TRACE(name);
    Cell with = cell;
    with.effects.push_back(entry_of(name));
    try {
      const auto report = identifiability(with, m, rows);
      names_are_known(with, m, report);
      int of_effects = 0;
      for (const auto& p : report.calibration.parameters) of_effects += p.of_effect() ? 1 : 0;
      looked_at += of_effects > 0 ? 1 : 0;
    } catch (const Failure& failure) {
      std::printf("  %s: %s\n", name.c_str(), failure.problems().front().message.c_str());
    }
  }
  EXPECT_GT(looked_at, kFittedLaws / 2);
}

}  // namespace
}  // namespace plumb::offline
