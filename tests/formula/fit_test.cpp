// SPDX-License-Identifier: Apache-2.0
// A formula through the whole line: fitted, kept, compiled, predicted.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "compile/compiler.hpp"
#include "fit/calibrate.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/corrector.hpp"
#include "runs/run_json.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

EffectEntry formula(const std::string& target, const std::string& expression,
                    std::vector<std::string> parameters, const std::string& domain = "robot") {
  return {.name = "formula",
          .joints = {},
          .options = {{"name", std::string("own")},
                      {"target", target},
                      {"expression", expression},
                      {"parameters", std::move(parameters)},
                      {"domain", domain}},
          .place = {}};
}

/// A simulated arm whose second joint yields.
BlindCase yielding_arm() {
  BlindRequest request;
  request.effects = {"joint_compliance:J2:8"};
  request.sigma_m = 20e-6;
  request.poses = 200;
  request.seed = 3;
  return make_blind_case(request);
}

std::vector<int> all_rows(const Measurements& m) {
  std::vector<int> out(static_cast<std::size_t>(m.size()));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<int>(i);
  return out;
}

Calibration calibrated(Cell cell, const Measurements& m, const EffectEntry& effect) {
  cell.effects.push_back(effect);
  return calibrate(cell, m, all_rows(m));
}

double rms(const Rows3& a) { return std::sqrt(a.squaredNorm() / static_cast<double>(a.size())); }

TEST(FormulaFit, OfALawOfTheLibraryGivesWhatThatLawGives) {
  const BlindCase blind = yielding_arm();
  const Measurements& m = blind.measured.measured;
  const auto own = calibrated(blind.cell, m, formula("dq2", "k * tau2", {"k [rad/(N m)] ~ 1e-6"}));
  const auto law = calibrated(blind.cell, m, {"joint_compliance", {1}, {}, {}});
  const auto& fresh = blind.fresh.measured;
  const Rows3 p = predict_points(own.state, fresh), q = predict_points(law.state, fresh);
  EXPECT_LT((p - q).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(own.state.arm.effects[0].parameters[0] / law.state.arm.effects[0].parameters[0], 1.0,
              1e-5);
  const Estimate& k = own.estimates.back();
  EXPECT_EQ(k.name, "formula.own.k");
  EXPECT_EQ(k.unit, "rad/(N m)");
  EXPECT_NEAR(k.std / law.estimates.back().std, 1.0, 1e-3);
  // And it is the truth: the error on fresh poses falls below the noise.
  const auto none = calibrate(blind.cell, m, all_rows(m));
  const double before = rms(blind.fresh.true_p_M - predict_points(none.state, fresh));
  const double after = rms(blind.fresh.true_p_M - p);
  std::printf("true error %.1f -> %.1f um, sigma 20 um\n", before * 1e6, after * 1e6);
  EXPECT_LT(after, 0.2 * before);
  EXPECT_LT(after, 20e-6);
}

/// Measurements without noise of an arm that obeys `effect` with these parameters.
Measurements obeying(const Cell& cell, Measurements m, const EffectEntry& effect,
                     const std::vector<double>& parameters, ArmState& truth) {
  Cell with = cell;
  with.effects = {effect};
  truth.arm.nominal = truth.arm.calibrated = cell.nominal;
  for (std::size_t i = 0; i < truth.arm.calibrated.joints.size(); ++i) {
    truth.arm.calibrated.joints[i].theta += 3e-4 * static_cast<double>(i % 3);
    truth.arm.calibrated.joints[i].a += 2e-4;
  }
  truth.arm.gravity = cell.gravity;
  truth.arm.mechanics = mechanics_of(cell);
  truth.arm.effects = bind_effects(with, m);
  truth.arm.effects[0].parameters = parameters;
  truth.X_MB.p = {2.0, -1.0, 0.3};
  truth.X_TG.p = {0.02, 0.03, 0.1};
  m.p_M = predict_points(truth, m);
  return m;
}

TEST(FormulaFit, FindsNonLinearParametersThatHideBehindOneThatIsZero) {
  const BlindCase blind = yielding_arm();
  struct Row {
    const char* target;
    const char* expression;
    std::vector<std::string> parameters;
    std::vector<double> truth;
  };
  for (const Row& row : std::vector<Row>{
           {"dq2",
            "k * tau2 * (1 + c*abs(tau2))",
            {"k [rad/(N m)] ~ 1e-7", "c [1/(N m)] ~ 1e-3"},
            {3e-7, 4e-4}},
           {"dq3", "b*tanh(tau3/r)", {"b [urad] ~ 200", "r [N m] ~ 200"}, {3e-4, 350.0}},
           {"dq1",
            "A*sin(w*q1 + p)",
            {"A [rad] ~ 2e-4", "w [1] ~ 1 = 7", "p [rad] ~ 1"},
            {2.5e-4, 7.2, 0.7}},
           // It begins at right angles to the truth; begun at size 0 it ends at its twin (-A, p -
           // pi).
           {"dq1",
            "A*sin(3*q1 + p)*cos(w*q2)",
            {"A [rad] ~ 2e-4", "p [rad] ~ 1", "w [1] ~ 1 = 2.2"},
            {2.5e-4, 2.5707, 2.0}}}) {
    ArmState truth;
    const EffectEntry effect = formula(row.target, row.expression, row.parameters);
    const Measurements m = obeying(blind.cell, blind.measured.measured, effect, row.truth, truth);
    const Calibration c = calibrated(blind.cell, m, effect);
    EXPECT_LT(rms(m.p_M - predict_points(c.state, m)), 1e-8) << row.expression;
    for (std::size_t k = 0; k < row.truth.size(); ++k)
      EXPECT_NEAR(c.state.arm.effects[0].parameters[k], row.truth[k], 1e-3 * std::abs(row.truth[k]))
          << row.expression << ", parameter " << k;
  }
}

TEST(FormulaFit, EveryTargetIsFittedAndRunsInTheModelFileAsItWasFitted) {
  const BlindCase blind = yielding_arm();
  for (const char* target : {"dq1", "dq6", "pre1.rx", "pre4.dy", "post2.dz", "post3.rz", "base.rx",
                             "base.dz", "tool.dx", "tool.ry", "tcp.x", "tcp.z"}) {
    const std::string text = target;
    const bool length = text.starts_with("tcp") || text.find(".d") != std::string::npos;
    const EffectEntry effect =
        formula(target, "k * sin(2*q2) * cos(q4)", {length ? "k [um] ~ 5000" : "k [urad] ~ 5000"});
    ArmState truth;
    const Measurements m = obeying(blind.cell, blind.measured.measured, effect, {7e-5}, truth);
    offline::Run run;
    run.created = "2026-01-01T00:00:00Z";
    run.cell_sha256 = std::string(64, '0');
    run.fit.calibration = calibrated(blind.cell, m, effect);
    const ArmState& state = run.fit.calibration.state;
    EXPECT_NEAR(state.arm.effects[0].parameters[0], 7e-5, 1e-8) << target;
    const auto read = format::read_model(format::write_model(compile(blind.cell, run)));
    ASSERT_TRUE(std::holds_alternative<format::Model>(read)) << target;
    const auto& model = std::get<format::Model>(read);
    ASSERT_EQ(model.effects.size(), 1u);
    EXPECT_EQ(model.provenance.parameter_names.back(), "formula.own.k");
    const ForwardModel arm(model);
    const Corrector corrector(model);
    const Rows3 fitted = predict_points(state, m);
    const Vector3 target_T(state.X_TG.p[0], state.X_TG.p[1], state.X_TG.p[2]);
    int solved = 0;
    for (Eigen::Index i = 0; i < m.q.rows(); ++i) {
      const std::span<const double> q(m.q.row(i).data(), 6);
      const Vector3 p = from_pose(state.X_MB) * (arm.predict(q).X_BT * target_T);
      EXPECT_LT((p - fitted.row(i).transpose()).norm(), 1e-9) << target;
      const Transformd X_BD = corrector.nominal().forward(q);
      const Correction c = corrector.solve(X_BD, q, SeedKind::kMeasured);
      if (refused(c.status) || c.status == Status::kPartial) continue;
      ++solved;
      EXPECT_LT((arm.predict(std::span(c.q).first(6)).X_BT.p - X_BD.p).norm(), 1e-9) << target;
    }
    EXPECT_GT(solved, 100) << target;
  }
}

TEST(FormulaFit, OfTheMeasurementIsThrownAway) {
  const BlindCase blind = yielding_arm();
  const Measurements& m = blind.measured.measured;
  offline::Run run;
  run.created = "2026-01-01T00:00:00Z";
  run.cell_sha256 = std::string(64, '0');
  run.fit.calibration =
      calibrated(blind.cell, m, formula("base.dz", "k * row", {"k [um] ~ 0.1"}, "measurement"));
  EXPECT_EQ(run.fit.calibration.state.arm.effects.size(), 1u);
  const format::Model model = compile(blind.cell, run);
  EXPECT_TRUE(model.effects.empty());
  for (const auto& name : model.provenance.parameter_names)
    EXPECT_FALSE(name.starts_with("formula.")) << name;
}

TEST(FormulaFit, IsKeptInARunAndComesBackTheSame) {
  const BlindCase blind = yielding_arm();
  const Measurements& m = blind.measured.measured;
  offline::Run run;
  run.fit.calibration =
      calibrated(blind.cell, m,
                 formula("dq2", "k * tau2 + 0.5e-9 [rad/(N m)] * tau3", {"k [urad/(N m)] ~ 1"}));
  const offline::Run back = run_from_json(nlohmann::ordered_json::parse(run_to_json(run).dump()));
  EXPECT_EQ(back.fit.calibration.state.arm.effects, run.fit.calibration.state.arm.effects);
  EXPECT_FALSE(back.fit.calibration.state.arm.effects[0].formula.code.empty());
}

Problem refusal(const Cell& cell, const Measurements& m, const EffectEntry& effect) {
  try {
    calibrated(cell, m, effect);
  } catch (const Failure& failure) {
    return failure.problems().front();
  }
  return {.message = "nothing was refused"};
}

TEST(FormulaFit, WithoutAValueAtAPoseIsRefusedByThatPose) {
  const BlindCase blind = yielding_arm();
  Measurements m = blind.measured.measured;
  for (Eigen::Index i = 0; i < m.q.rows(); ++i) m.q(i, 0) = std::abs(m.q(i, 0)) + 0.01;
  m.q(17, 0) = -0.3;
  const Problem p = refusal(blind.cell, m, formula("dq2", "k*log(q1)", {"k [rad] ~ 1e-4"}));
  EXPECT_EQ(p.code, "E-FIT-FORMULA");
  EXPECT_EQ(p.message, "formula 'own' has no value at pose '" + m.pose[17] + "': dq2 = k*log(q1)");
}

TEST(FormulaFit, WithoutItsColumnsIsRefusedWithWhatThereIs) {
  const BlindCase blind = yielding_arm();
  Measurements m = blind.measured.measured;
  m.context.direction.resize(0, 0);
  m.context.travel.resize(0, 0);
  m.context.time_s.resize(0);
  m.context.sensors = {"temp_base"};
  m.context.temperature.setConstant(m.q.rows(), 1, 20.0);
  const auto words = [&](const char* expression, const char* parameter) {
    const Problem p = refusal(blind.cell, m, formula("dq2", expression, {parameter}));
    return p.code + ": " + p.message + " / " + p.help;
  };
  const std::string order = "if the rows are consecutive moves: plumb import --dir from-order";
  EXPECT_EQ(words("k*dir2", "k [rad] ~ 1e-4"),
            "E-EFFECT-DATA: formula 'own' needs columns dir_j1 … / " + order);
  EXPECT_EQ(words("k*travel2", "k [1] ~ 1e-4"),
            "E-EFFECT-DATA: formula 'own' needs columns travel_j1_deg … / " + order);
  EXPECT_EQ(words("k*t", "k [rad/s] ~ 1e-4"),
            "E-EFFECT-DATA: formula 'own' needs the time of each row / add a column t_s");
  EXPECT_EQ(
      words("k*temp_arm", "k [rad/K] ~ 1e-4"),
      "E-EFFECT-DATA: formula 'own' needs column temp_arm_degC / these files have: temp_base");
}

}  // namespace
}  // namespace plumb::offline
