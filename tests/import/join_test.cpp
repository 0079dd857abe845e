// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "import/importer.hpp"
#include "import/joining.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/import/temporary_file.hpp"

namespace plumb::offline {
namespace {

/// Joints in one file, points in another, as controller and tracker write them.
struct TwoFiles {
  Cell cell = random_cell(5, 6, format::Convention::kStandard, ArmKind::kRevolute);
  Simulation s;
  std::string joints = "pose,t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n";
  std::string points = "pose,t_s,x_mm,y_mm,z_mm\n";

  /// `late`: rows at the beginning that the tracker missed.
  explicit TwoFiles(int late) {
    SimulationPlan plan;
    plan.poses = 40;
    plan.truth.geometry_m = plan.truth.geometry_rad = 5e-4;
    s = simulate(cell, plan);
    for (int i = 0; i < s.measured.size(); ++i) {
      joints += fmt::format("P{},{}", i, 10 * i);
      for (int j = 0; j < 6; ++j) joints += fmt::format(",{}", s.measured.q(i, j));
      joints += '\n';
      if (i < late) continue;
      const auto p = s.measured.p_M.row(i) * 1e3;
      points += fmt::format("P{},{},{},{},{}\n", i, 10 * i + 0.3, p(0), p(1), p(2));
    }
  }

  Imported joined(const JoinWishes& wishes) const {
    const tests::TemporaryFolder folder;
    return join(import_file(folder.put("joints.csv", joints), {}),
                import_file(folder.put("points.csv", points), {}), wishes);
  }

  void expect_partners(const Imported& data, int first) const {
    for (int i = 0; i < data.rows(); ++i) {
      EXPECT_EQ(std::stod(std::string(data.find("q1")->text[i])), s.measured.q(first + i, 0));
      EXPECT_NEAR(std::stod(std::string(data.find("x")->text[i])),
                  s.measured.p_M(first + i, 0) * 1e3, 1e-9);
    }
  }
};

TEST(Join, ByPoseAndByTimeFindsThePartners) {
  const TwoFiles files(3);
  for (const JoinBy by : {JoinBy::kPose, JoinBy::kTime}) {
    const Imported data = files.joined({.by = by});
    EXPECT_EQ(data.rows(), files.s.measured.size() - 3);
    EXPECT_EQ(data.remarks.back().code, "W-IMPORT-PARTNERS");
    files.expect_partners(data, 3);
  }
  EXPECT_THROW((void)files.joined({.by = JoinBy::kTime, .max_gap_s = 0.1}), Failure);
}

TEST(Join, ByOrderFindsTheMissingRowsFromTheResidual) {
  for (int late = 0; late <= 4; ++late) {
    const TwoFiles files(late);
    const Imported data = files.joined({.by = JoinBy::kOrder, .cell = &files.cell});
    EXPECT_EQ(data.rows(), files.s.measured.size() - late);
    files.expect_partners(data, late);
    const bool told = std::any_of(data.remarks.begin(), data.remarks.end(),
                                  [](const Problem& p) { return p.code == "W-IMPORT-SHIFT"; });
    EXPECT_EQ(told, late > 0);
  }
}

TEST(Join, ByOrderWithoutAnArmAsksForEqualCounts) {
  EXPECT_THROW((void)TwoFiles(1).joined({.by = JoinBy::kOrder}), Failure);
  EXPECT_EQ(TwoFiles(0).joined({.by = JoinBy::kOrder}).rows(), TwoFiles(0).s.measured.size());
}

}  // namespace
}  // namespace plumb::offline
