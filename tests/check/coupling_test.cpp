// SPDX-License-Identifier: Apache-2.0
// Controllers that couple joints: what they show is made here by hand, without the code that is
// tested.
#include <gtest/gtest.h>

#include <functional>

#include "check/convention_search.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/check/scrambled.hpp"

namespace plumb::offline {
namespace {

using Couplings = std::vector<format::JointCoupling>;
using Shown = std::function<void(RowsN& q)>;  // joint angles to what the controller shows

Simulation seen(const Cell& cell, std::uint64_t seed) {
  SimulationPlan plan;
  plan.poses = 60;
  plan.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  return simulate(cell, plan);
}

Cell arm(std::uint64_t seed) {
  return random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
}

/// The search over readings of a controller that shows its joints in this way, and the cell and the
/// measurements as it says that they are meant.
struct Detected {
  Detection detection;
  Cell meant;
  double left_m = 0.0;  // largest difference of a joint angle from the true one
};

Detected found(std::uint64_t seed, const Shown& show) {
  Cell cell = arm(seed);
  Simulation simulation = seen(cell, seed);
  const RowsN angles = simulation.measured.q;
  show(simulation.measured.q);
  const scrambled::Folder folder;
  const auto c =
      scrambled::opened({write_cell(cell), simulated_csv(cell, simulation), {}}, folder.path());
  Detected out{detect_convention(c.cell, c.measured), {}, 0.0};
  const Convention& labels = out.detection.present.convention;
  const Convention& best = out.detection.best.convention;
  const std::string edit = edited(c.cell.text, "cell.toml", cell_edit(c.cell, labels, best));
  out.meant = parse_cell(edit, c.cell.file);
  out.left_m = (read_as(c.measured, c.cell, labels, best).q - angles).cwiseAbs().maxCoeff();
  return out;
}

constexpr double kRounding = 1e-6;

TEST(CouplingSearch, OfAnyTwoNeighboursIsFoundAndWritten) {
  for (int i = 1; i < 6; ++i)
    for (const double share : {1.0, -1.0}) {
      const Detected out = found(static_cast<std::uint64_t>(3 + i),
                                 [&](RowsN& q) { q.col(i) += share * q.col(i - 1); });
      const Couplings expected{
          {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i - 1), -share}};
      EXPECT_EQ(out.detection.best.convention.coupling, expected) << i << " " << share;
      EXPECT_EQ(out.meant.nominal.coupling, expected);
      EXPECT_LT(out.left_m, kRounding);
    }
}

TEST(CouplingSearch, OfHalfAnAngleIsFound) {
  const Detected out = found(8, [](RowsN& q) { q.col(2) += 0.5 * q.col(1); });
  EXPECT_EQ(out.meant.nominal.coupling, (Couplings{{2, 1, -0.5}}));
}

TEST(CouplingSearch, OfBothWristJointsIsFound) {
  const Detected out = found(9, [](RowsN& q) {
    q.col(5) += q.col(4);
    q.col(4) += q.col(3);
  });
  EXPECT_LT(out.left_m, kRounding);
  EXPECT_EQ(out.meant.nominal.coupling.size(), 3U);  // q6 = J6 - q5 = J6 - J5 + J4
}

TEST(CouplingSearch, OfElbowAndWristIsFound) {
  const Detected out = found(10, [](RowsN& q) {
    q.col(2) += q.col(1);
    q.col(5) -= q.col(4);
  });
  EXPECT_LT(out.left_m, kRounding);
}

TEST(CouplingSearch, WithJointsThatCountTheOtherWayIsFound) {
  for (const auto& turned : {std::vector<int>{2}, {1}, {1, 2}, {0, 4}}) {
    const Detected out = found(11, [&](RowsN& q) {
      q.col(2) += q.col(1);
      for (const int j : turned) q.col(j) *= -1.0;
    });
    EXPECT_FALSE(out.meant.nominal.coupling.empty());
    EXPECT_TRUE(out.detection.changed);
    EXPECT_LT(out.detection.best.fitted_m, 1e-3);
  }
}

TEST(CouplingSearch, WithAZeroTurnedByAQuarterIsFound) {
  const Detected out = found(12, [](RowsN& q) {
    q.col(2) += q.col(1);
    q.col(3).array() += M_PI_2;
  });
  EXPECT_EQ(out.meant.nominal.coupling, (Couplings{{2, 1, -1.0}}));
}

TEST(CouplingSearch, WithColumnsInAnotherOrderIsFound) {
  const Detected out = found(13, [](RowsN& q) {
    q.col(2) += q.col(1);
    q.col(3).swap(q.col(5));
  });
  EXPECT_EQ(out.meant.nominal.coupling, (Couplings{{2, 1, -1.0}}));
  EXPECT_LT(out.left_m, kRounding);
}

TEST(CouplingSearch, IsSaidInWords) {
  const Detected out = found(14, [](RowsN& q) { q.col(2) += q.col(1); });
  const auto words =
      in_words(arm(14), out.detection.present.convention, out.detection.best.convention);
  EXPECT_EQ(words, std::vector<std::string>{
                       "the joint values are coupled: J3 = q3 + q2 (coupling: J3 of J2, share 1)"});
}

TEST(CouplingSearch, OfAHealthyArmIsNotFound) {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    const Detected out = found(seed, [](RowsN&) {});
    EXPECT_FALSE(out.detection.changed) << seed;
    EXPECT_TRUE(out.meant.nominal.coupling.empty()) << seed;
  }
}

TEST(CouplingSearch, ThatTheCellStatesButTheControllerDoesNotHaveIsTakenBack) {
  Cell cell = arm(15);
  const Simulation simulation = seen(cell, 15);
  const std::string csv = simulated_csv(cell, simulation);
  cell.nominal.coupling = {{2, 1, -1.0}};
  const scrambled::Folder folder;
  const auto c = scrambled::opened({write_cell(cell), csv, {}}, folder.path());
  const Detection out = detect_convention(c.cell, c.measured);
  EXPECT_TRUE(out.changed);
  EXPECT_TRUE(out.best.convention.coupling.empty());
}

TEST(CouplingSearch, ThatTheCellStatesRightlyStays) {
  Cell cell = arm(16);
  cell.nominal.coupling = {{2, 1, -1.0}};
  const scrambled::Folder folder;
  const auto c =
      scrambled::opened({write_cell(cell), simulated_csv(cell, seen(cell, 16)), {}}, folder.path());
  EXPECT_FALSE(detect_convention(c.cell, c.measured).changed);
}

}  // namespace
}  // namespace plumb::offline
