// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "arm/geometry_derivative.hpp"
#include "arm/predicted_points.hpp"
#include "compile/compiler.hpp"
#include "effects/fitted_laws.hpp"
#include "plumb/format/formula.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/corrector.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using tests::Random;

constexpr int kJoints = 6;

Cell heavy_arm(std::uint64_t seed) {
  Cell cell = random_cell(seed, kJoints, format::Convention::kStandard, ArmKind::kRevolute);
  Random dice(seed);
  for (auto& m : cell.mechanics) {
    m.link_mass_kg = dice.uniform(2, 80);
    m.link_com_m = {dice.uniform(-0.2, 0.2), dice.uniform(-0.2, 0.2), dice.uniform(-0.2, 0.2)};
  }
  cell.payload = {20.0, {0.02, -0.03, 0.1}};
  return cell;
}

/// Poses with every context there is.
Measurements rich_measurements(const Cell& cell, int n, std::uint64_t seed) {
  SimulationPlan plan;
  plan.poses = n;
  plan.seed = seed;
  plan.truth.seed = seed;
  Measurements m = simulate(cell, plan).measured;
  Random dice(seed);
  const auto fill = [&](RowsN& to, int columns, double low, double high) {
    to.resize(m.q.rows(), columns);
    for (Eigen::Index i = 0; i < to.size(); ++i) to.data()[i] = dice.uniform(low, high);
  };
  fill(m.context.direction, kJoints, -1, 1);
  m.context.direction = m.context.direction.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; });
  fill(m.context.travel, kJoints, 0.0, 0.05);
  fill(m.context.payload, 4, 0.0, 0.3);
  m.context.payload.col(0) *= 100.0;
  fill(m.context.wrench, 6, -50, 50);
  m.context.sensors = {"temp_base", "temp_arm"};
  fill(m.context.temperature, 2, 15, 30);
  return m;
}

EffectEntry entry_of(const std::string& name) {
  EffectEntry out{.name = name, .joints = {}, .options = {}, .place = {}};
  if (name == "gear_ripple") out.options["cycles_per_turn"] = 8.5;
  if (name == "cross_compliance") out.joints = {2, 1};
  if (name == "drive_coupling") out.joints = {2, 1};
  if (name == "rail_bow" || name == "pitch_error") out.joints = {1, 3};
  if (name == "pitch_error") out.options["pitch_mm"] = 450.0;
  if (name == "joint_table") out.joints = {1};
  if (name == "joint_series") out.joints = {1, 4};
  if (name == "gravity_free") out.joints = {1, 2};
  if (name == "axis_wobble") out.joints = {0, 3};
  if (name == "step") out.options["after_row"] = 3.0;
  if (name == "step") out.options["of"] = std::string("base");
  if (name == "thermal_growth") out.options["sensor"] = std::string("temp_arm");
  if (name == "formula")
    out.options = {
        {"target", std::string("pre3.rx")},
        {"expression", std::string("k * tau2 * (1 + c*abs(tau2)) + w * dir3 * sin(2*q1)"
                                   " + e * (temp_arm - temp_base) * payload / 1 [kg]")},
        {"parameters", std::vector<std::string>{"k [rad/(N m)] ~ 1e-7", "c [1/(N m)] ~ 1e-3",
                                                "w [rad] ~ 1e-4", "e [urad/K] ~ 5"}}};
  return out;
}

/// An arm that carries the effects with random parameters of typical size.
ArmState with_effects(const Cell& cell, const Measurements& m, Random& dice) {
  ArmState state;
  state.arm.nominal = cell.nominal;
  state.arm.calibrated = cell.nominal;
  state.arm.gravity = cell.gravity;
  state.arm.mechanics = mechanics_of(cell);
  state.arm.effects = bind_effects(cell, m);
  for (auto& row : state.arm.calibrated.joints) row.theta += dice.uniform(-1e-3, 1e-3);
  for (std::size_t e = 0; e < state.arm.effects.size(); ++e)
    for (std::size_t k = 0; k < state.arm.effects[e].parameters.size(); ++k) {
      const double typical =
          effect_parameter(state.arm, static_cast<int>(e), static_cast<int>(k)).typical;
      state.arm.effects[e].parameters[k] =
          (typical > 0.0 ? typical : 3e-7) * dice.uniform(-2.0, 2.0);
    }
  state.X_MB.p = {2.0, -1.0, 0.3};
  state.X_TG.p = {0.02, 0.03, 0.1};
  return state;
}

class EveryEffect : public ::testing::TestWithParam<int> {
 protected:
  std::string name() const { return std::string(fitted_law_info(GetParam()).name); }
};

/// The laws that a model file may contain.
class EveryRuntimeEffect : public EveryEffect {};

TEST_P(EveryEffect, HasTheDerivativesOfItsFiniteDifferences) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random dice(seed);
    Cell cell = heavy_arm(seed);
    cell.effects = {{"geometry", {}, {}, {}}, entry_of(name())};
    const Measurements m = rich_measurements(cell, 12, seed);
    const ArmState state = with_effects(cell, m, dice);
    const auto parameters = effect_parameters(state.arm);
    ASSERT_FALSE(parameters.empty());
    const auto count = static_cast<Eigen::Index>(parameters.size());
    const auto sensors = temperature_names(state.arm);
    double moved_most = 0.0;
    for (Eigen::Index row = 0; row < m.q.rows(); ++row) {
      const std::span<const double> q(m.q.row(row).data(), kJoints);
      const MeasuredContext context = context_of(m, row, sensors, from_pose(state.X_MB));
      const auto at = [&](const Eigen::VectorXd& change) {
        GeometryDerivative::Point point;
        GeometryDerivative(state, parameters, change).evaluate(q, context, point);
        return point;
      };
      const auto here = at(Eigen::VectorXd::Zero(count));
      for (Eigen::Index k = 0; k < count; ++k) {
        const double size = 1e-4 * std::max(1e-6, std::abs(value_of(state, parameters[k])));
        Eigen::VectorXd step = Eigen::VectorXd::Zero(count);
        step(k) = size;
        const Vector3 slope = (at(step).p_M - at(-step).p_M) / (2.0 * size);
        const Vector3 column = here.columns.col(k).head<3>();
        EXPECT_LT((slope - column).norm(), 1e-6 * column.norm() + 2e-15 / size)
            << parameters[k].name << ", seed " << seed;
        moved_most = std::max(moved_most, column.norm());
      }
    }
    EXPECT_GT(moved_most, 0.0) << name() << " moves nothing";
  }
}

TEST_P(EveryEffect, RunsInTheModelFileAsItWasFitted) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random dice(seed);
    Cell cell = heavy_arm(seed);
    cell.effects = {{"geometry", {}, {}, {}}, entry_of(name())};
    const Measurements m = rich_measurements(cell, 30, seed);
    offline::Run run;
    run.created = "2026-01-01T00:00:00Z";
    run.cell_sha256 = std::string(64, '0');
    run.fit.calibration.state = with_effects(cell, m, dice);
    const format::Model model = compile(cell, run);
    const EffectDomain domain = fitted_law_info(GetParam()).domain;
    const bool online = domain == EffectDomain::kRobot || domain == EffectDomain::kEnvironment;
    ASSERT_EQ(model.effects.size(), online ? 1U : 0U);
    if (!online) return;
    const auto read = format::read_model(format::write_model(model));
    ASSERT_TRUE(std::holds_alternative<format::Model>(read));
    const auto& loaded = std::get<format::Model>(read);
    ASSERT_EQ(unusable_effects(loaded), "");
    const Rows3 fitted = predict_points(run.fit.calibration.state, m);
    const ForwardModel arm(loaded);
    const Transformd X_MB = from_pose(run.fit.calibration.state.X_MB);
    const Vector3 target(0.02, 0.03, 0.1);
    for (Eigen::Index i = 0; i < m.q.rows(); ++i) {
      const Context context = context_at(m.context, i, temperature_names(loaded)).known;
      const std::span<const double> q(m.q.row(i).data(), kJoints);
      const Vector3 p = X_MB * (arm.predict(q, context).X_BT * target);
      EXPECT_LT((p - fitted.row(i).transpose()).norm(), 1e-9);
    }
  }
}

TEST_P(EveryRuntimeEffect, IsInvertedByTheCorrector) {
  int solved = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random dice(seed);
    Cell cell = heavy_arm(seed);
    cell.effects = {{"geometry", {}, {}, {}}, entry_of(name())};
    const Measurements m = rich_measurements(cell, 30, seed);
    format::Model model = with_effects(cell, m, dice).arm;
    model.guard.length_scale_m = reach(cell.nominal);
    model.guard.corrects = format::Corrects::kPose;
    const Corrector corrector(model);
    for (Eigen::Index i = 0; i < m.q.rows(); ++i) {
      const Context context = context_of(m, i, temperature_names(model), Transformd{}).known;
      std::array<double, kJoints> q{};
      for (int j = 0; j < kJoints; ++j) q[j] = m.q(i, j) + dice.uniform(-0.02, 0.02);
      const Transformd X_BD = corrector.nominal().forward(q);
      const std::span<const double> seed_q(m.q.row(i).data(), kJoints);
      const Correction c = corrector.solve(X_BD, seed_q, SeedKind::kMeasured, context);
      if (refused(c.status)) continue;
      ++solved;
      const Transformd there =
          corrector.forward_model().predict(std::span(c.q).first(kJoints), context).X_BT;
      EXPECT_LT((there.p - X_BD.p).norm(), 1e-8);
      EXPECT_LT(rotation_vector(there.R * X_BD.R.transpose()).norm(), 1e-8);
    }
  }
  EXPECT_GT(solved, 100);
}

std::string name_of(const ::testing::TestParamInfo<int>& law) {
  return std::string(fitted_law_info(law.param).name);
}
INSTANTIATE_TEST_SUITE_P(Library, EveryEffect, ::testing::Range(0, kFittedLaws), name_of);
INSTANTIATE_TEST_SUITE_P(Runtime, EveryRuntimeEffect, ::testing::Range(0, kEffectLaws), name_of);

/// A sound model of an arm without effects, and an effect of that arm.
format::Model bare_model() {
  offline::Run run;
  run.created = "2026-01-01T00:00:00Z";
  run.cell_sha256 = std::string(64, '0');
  const Cell cell = heavy_arm(1);
  Random dice(1);
  run.fit.calibration.state = with_effects(cell, rich_measurements(cell, 5, 1), dice);
  return compile(cell, run);
}
format::Effect bound(const std::string& name) {
  const Cell cell = heavy_arm(1);
  return bind_effect(cell, rich_measurements(cell, 5, 1), entry_of(name));
}

TEST(Effects, NoModelFileHoldsOneOfTheMeasurement) {
  for (int law = 0; law < kFittedLaws; ++law) {
    const EffectInfo& info = fitted_law_info(law);
    const bool of_robot =
        info.domain == EffectDomain::kRobot || info.domain == EffectDomain::kEnvironment;
    EXPECT_EQ(of_robot, !is_measurement_law(law)) << info.name;
    format::Model model = bare_model();
    model.effects = {bound(std::string(info.name))};
    try {
      format::write_model(model);
      EXPECT_TRUE(of_robot) << info.name;
    } catch (const std::invalid_argument& fault) {
      EXPECT_EQ(fault.what(),
                "effect '" + std::string(info.name) +
                    "' belongs to a measurement, which a model file must not contain");
    }
  }
}

/// A formula that reads the row or a last move is of the measurement, whatever its domain says.
TEST(Effects, NoModelFileHoldsAFormulaThatReadsTheOrderOfMeasuring) {
  for (const format::FormulaOp op : {format::FormulaOp::kRow, format::FormulaOp::kMove}) {
    format::Model model = bare_model();
    model.effects = {
        {.name = "formula", .version = 1, .joints = {}, .parameters = {}, .context = {}}};
    model.effects[0].formula.code = {format::instruction(op, 0)};
    EXPECT_THROW(format::write_model(model), std::invalid_argument);
    model.effects[0].formula.code = {format::instruction(format::FormulaOp::kPosition, 0)};
    EXPECT_NO_THROW(format::write_model(model));
  }
}

/// Every law alone, and behind a law of the robot: the two ways of evaluating the arm agree.
TEST_P(EveryEffect, IsPredictedAsItIsFitted) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Random dice(seed);
    Cell cell = heavy_arm(seed);
    cell.effects = {{"geometry", {}, {}, {}}, entry_of(name())};
    if (seed > 1) cell.effects.insert(cell.effects.begin() + 1, entry_of("thermal_growth"));
    const Measurements m = rich_measurements(cell, 20, seed);
    const ArmState state = with_effects(cell, m, dice);
    const GeometryDerivative geometry(state, {}, Eigen::VectorXd(0));
    const Rows3 predicted = predict_points(state, m);
    for (Eigen::Index i = 0; i < m.q.rows(); ++i) {
      GeometryDerivative::Point fitted;
      geometry.evaluate({m.q.row(i).data(), kJoints},
                        context_of(m, i, geometry.sensors(), from_pose(state.X_MB)), fitted);
      EXPECT_LT((predicted.row(i).transpose() - fitted.p_M).norm(), 1e-12) << name();
    }
  }
}

TEST(Effects, AnUnknownLawAWrongCountOrANewerVersionIsNamed) {
  format::Model model;
  model.calibrated.joints.resize(6);
  model.effects = {
      {.name = "witchcraft", .version = 1, .joints = {}, .parameters = {}, .context = {}}};
  EXPECT_EQ(unusable_effects(model), "effect 'witchcraft' is not known to this version");
  model.effects[0].name = "encoder_scale";
  model.effects[0].joints = {1};
  EXPECT_EQ(unusable_effects(model), "effect 'encoder_scale' has 0 parameters, not 1");
  model.effects[0].parameters = {1e-5};
  EXPECT_EQ(unusable_effects(model), "");
  model.effects[0].version = 7;
  EXPECT_EQ(unusable_effects(model),
            "effect 'encoder_scale' is of version 7, newer than this library");
}

TEST(Effects, AMissingInputUsesItsFallbackAndSaysSo) {
  Cell cell = heavy_arm(1);
  cell.effects = {{"geometry", {}, {}, {}}, entry_of("thermal_growth")};
  const Measurements m = rich_measurements(cell, 5, 1);
  Random dice(1);
  const ArmState state = with_effects(cell, m, dice);
  format::Model bare = state.arm;
  bare.effects.clear();
  const ForwardModel arm(state.arm), rigid(bare);
  const std::span<const double> q(m.q.row(0).data(), kJoints);
  const Prediction unknown = arm.predict(q);
  EXPECT_EQ(unknown.status, Status::kContextFallback);
  // The fallback is the reference temperature: nothing has grown.
  EXPECT_LT((unknown.X_BT.p - rigid.predict(q).X_BT.p).norm(), 1e-15);
  const Prediction known =
      arm.predict(q, context_at(m.context, 0, temperature_names(state.arm)).known);
  EXPECT_EQ(known.status, Status::kOk);
  EXPECT_GT((known.X_BT.p - unknown.X_BT.p).norm(), 1e-6);
}

}  // namespace
}  // namespace plumb::offline
