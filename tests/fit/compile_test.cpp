// SPDX-License-Identifier: Apache-2.0
#include "compile/compiler.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "arm/predicted_points.hpp"
#include "compile/audit.hpp"
#include "compile/tool_uncertainty.hpp"
#include "compile/trained_poses.hpp"
#include "fit/cell_data.hpp"
#include "fit/fit_cell.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/corrector.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/cases/socket_arm.hpp"
#include "tests/cell/support.hpp"

namespace plumb::offline {
namespace {

struct Line {
  Cell cell;
  Simulation simulation;
  Run run;
};

Line whole_line(std::vector<std::string> effects, bool tree) {
  Line out;
  out.cell = random_cell(1, 6, format::Convention::kStandard, ArmKind::kRevolute);
  if (tree) {
    EffectEntry entry;
    entry.name = "local_tree";
    out.cell.effects.push_back(entry);
  }
  SimulationPlan plan;
  plan.poses = 1200;
  plan.truth.geometry_m = plan.truth.geometry_rad = 3e-4;
  plan.truth.effects = std::move(effects);
  out.simulation = simulate(out.cell, plan);
  out.run.created = "2026-01-01T00:00:00Z";
  out.run.cell_sha256 = std::string(64, '0');
  out.run.number = 1;
  out.run.fit = fit_cell(out.cell, out.simulation.measured);
  return out;
}

format::Model through_the_file(const format::Model& model) {
  const auto read = format::read_model(format::write_model(model));
  EXPECT_TRUE(std::holds_alternative<format::Model>(read));
  return std::get<format::Model>(read);
}

TEST(Compile, WhatIsFittedIsWhatRuns) {
  for (bool tree : {false, true}) {
    const Line line = whole_line({"joint_compliance"}, tree);
    const format::Model model = through_the_file(compile(line.cell, line.run));
    const ForwardModel arm(model);
    const ArmState& state = line.run.fit.calibration.state;
    const Rows3 fitted = predict_points(state, line.simulation.measured.q);
    const Transformd X_MB = from_pose(state.X_MB);
    const Vector3 target(state.X_TG.p[0], state.X_TG.p[1], state.X_TG.p[2]);
    for (int i = 0; i < line.simulation.measured.size(); ++i) {
      const auto row = line.simulation.measured.q.row(i);
      const auto X_BT = arm.predict({row.data(), 6}).X_BT;
      EXPECT_LT((X_MB * (X_BT * target) - fitted.row(i).transpose()).norm(), 1e-9);
    }
  }
}

TEST(Audit, WorstCorrectionIsNotExceededOnFreshPosesByMuchAndItsPlaceIsInTheBox) {
  const Line line = whole_line({}, false);
  const format::Model model = compile(line.cell, line.run);
  const Audit a = audit(model);
  const ForwardModel arm(model);
  const Chain nominal(model.nominal);
  for (int i = 0; i < line.simulation.measured.size(); ++i) {
    const auto row = line.simulation.measured.q.row(i);
    const std::span<const double> q(row.data(), 6);
    EXPECT_LT((arm.predict(q).X_BT.p - nominal.forward(q).p).norm(), 1.1 * a.worst_correction_m);
  }
  ASSERT_EQ(a.worst_q.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    EXPECT_GE(a.worst_q[k], model.domain.q_min[k]);
    EXPECT_LE(a.worst_q[k], model.domain.q_max[k]);
  }
}

TEST(Audit, OneSigmaAtTheToolIsWhatTheTrueErrorShows) {
  // 20 arms: the mean squared true error over the mean squared predicted sigma is about one.
  double truth = 0.0, predicted = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Cell cell = random_cell(seed, 6, format::Convention::kModified, ArmKind::kRevolute);
    // Frame and target given, so that the tool error is the arm's alone.
    cell.measurement.fit_frame = cell.measurement.fit_target = false;
    SimulationPlan plan;
    plan.poses = 100;
    plan.seed = seed;
    plan.noise_m = 10e-6;
    plan.truth.geometry_m = plan.truth.geometry_rad = 3e-4;
    const Simulation simulation = simulate(cell, plan);
    offline::Run run;
    run.created = "2026-01-01T00:00:00Z";
    run.cell_sha256 = std::string(64, '0');
    run.fit = fit_all(cell, simulation.measured);
    const format::Model model = compile(cell, run);
    const Rows3 p = predict_points(run.fit.calibration.state, simulation.measured.q);
    truth += (simulation.true_p_M - p).rowwise().squaredNorm().mean();
    predicted += std::pow(tool_uncertainty(model).mean_m, 2);
  }
  EXPECT_NEAR(std::sqrt(truth / predicted), 1.0, 0.2);
}

/// What the audit says of a cell with `entry` (none if its name is empty) and such data.
Audit audit_of(const std::string& hidden, const EffectEntry& entry) {
  Cell cell = random_cell(1, 6, format::Convention::kStandard, ArmKind::kRevolute);
  if (!entry.name.empty()) cell.effects.push_back(entry);
  SimulationPlan plan;
  plan.poses = 120;
  plan.truth.geometry_m = plan.truth.geometry_rad = 3e-4;
  if (!hidden.empty()) plan.truth.effects = {hidden};
  const Simulation simulation = simulate(cell, plan);
  offline::Run run;
  run.created = "2026-01-01T00:00:00Z";
  run.cell_sha256 = std::string(64, '0');
  run.fit = fit_all(cell, simulation.measured);
  return audit(compile(cell, run));
}

// A bump or a drift of the tracker shows, by its own small motion, where the axes of the base
// point, and so weakly that the tool would seem to be lost by centimetres.
TEST(Audit, WhatHappenedToTheTrackerLeavesTheToolAsCertainAsWithoutIt) {
  const double without = audit_of("", {}).tool.max_m;
  const auto step = [](const char* of) {
    EffectEntry out{.name = "step", .joints = {}, .options = {}, .place = {}};
    out.options["after_row"] = 60.0;
    out.options["of"] = std::string(of);
    return out;
  };
  const EffectEntry drift{.name = "drift", .joints = {}, .options = {}, .place = {}};
  const EffectEntry tracker{.name = "tracker", .joints = {}, .options = {}, .place = {}};
  for (const auto& [hidden, entry] :
       std::vector<std::pair<std::string, EffectEntry>>{{"step_base@at=0.5", step("base")},
                                                        {"step_reflector@at=0.5", step("tool")},
                                                        {"drift=300um", drift},
                                                        {"", tracker},
                                                        {"", step("base")},
                                                        {"", step("tool")}}) {
    const Audit with = audit_of(hidden, entry);
    EXPECT_LT(with.tool.max_m, 1.6 * without) << hidden << " " << entry.name;
    EXPECT_GT(with.tool.max_m, 0.6 * without) << hidden << " " << entry.name;
    for (const auto& remark : with.remarks) EXPECT_NE(remark.code, "W-AUDIT-SIGMA") << hidden;
  }
}

/// A tracker sees one reflector: how the last link is turned it cannot tell. Arms whose every angle
/// is 0.5 mrad off are then wrong at other points of the tool by as much as the audit says.
TEST(Audit, WhatTheOrientationCostsBesideTheReflectorIsWhatTheTrueErrorShows) {
  double said = 0.0, squares = 0.0;
  int count = 0;
  for (std::uint64_t seed = 41; seed < 51; ++seed) {
    SocketArm arm({.seed = seed, .placements = 1, .touches = 2});
    const Folder folder;
    std::string csv = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n";
    for (int i = 0; i < 80; ++i) {
      const SocketArm::Joints q = arm.random_joints();
      for (const double angle : q) csv += fmt::format("{:.7f},", angle * 180.0 / M_PI);
      const Eigen::Vector3d p = 1e3 * (arm.ball(q) + arm.noise(5e-6));
      csv += fmt::format("{:.6f},{:.6f},{:.6f}\n", p.x(), p.y(), p.z());
    }
    folder.put("measurements.csv", csv);
    Cell cell = read_cell(folder.put("cell.toml", arm.cell_toml()));
    plumb::offline::Run run;
    run.created = "2026-01-01T00:00:00Z";
    run.cell_sha256 = std::string(64, '0');
    run.number = 1;
    run.fit = fit_cell(cell, read_cell_measurements(cell));
    const ToolUncertainty a = tool_uncertainty(compile(cell, run));
    EXPECT_TRUE(a.turn_unmeasured);
    EXPECT_LT(a.mean_m, 0.5 * a.beside_m);
    said += a.beside_m * a.beside_m / 10.0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d beside = kBeside_m * Eigen::Vector3d::Unit(k);
      ArmState state = run.fit.calibration.state;
      for (std::size_t c = 0; c < 3; ++c) state.X_TG.p[c] += beside(static_cast<Eigen::Index>(c));
      for (int i = 0; i < 20; ++i, ++count) {
        const SocketArm::Joints q = arm.random_joints();
        RowsN one = Eigen::Map<const Eigen::RowVectorXd>(q.data(), 6);
        const Eigen::Vector3d found = predict_points(state, one).row(0).transpose();
        squares += (found - arm.ball(q, beside)).squaredNorm();
      }
    }
  }
  const double shown = std::sqrt(squares / count);
  EXPECT_GT(shown, 0.6 * std::sqrt(said));
  EXPECT_LT(shown, 1.6 * std::sqrt(said));
}

TEST(Audit, ACorrectionOverTheGuardsLimitIsAWarning) {
  Line line = whole_line({}, false);
  line.cell.deploy.max_correction_m = 1e-6;
  const Audit a = audit(compile(line.cell, line.run));
  ASSERT_FALSE(a.remarks.empty());
  EXPECT_EQ(a.remarks.front().code, "W-AUDIT-LIMIT");
}

}  // namespace
}  // namespace plumb::offline
