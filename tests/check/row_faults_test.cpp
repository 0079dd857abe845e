// SPDX-License-Identifier: Apache-2.0
#include "check/row_faults.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <vector>

#include "check/check.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/check/scrambled.hpp"
#include "tests/check/simulated_arm.hpp"
#include "tests/random_numbers.hpp"

/// Rows that were written otherwise than the others, from one line to another.
namespace plumb::offline {
namespace {

using scrambled::Files;

constexpr int kRows = 80;
constexpr double kDegree = M_PI / 180.0;

/// The numbers of a row in the units of the headings: q1 ... q6 [deg], then x, y, z [mm].
using Row = std::vector<double>;
using Rows = std::vector<Row>;

Rows rows_of(const MeasurementFiles& m) {
  Rows out;
  for (int i = 0; i < m.size(); ++i) {
    Row row;
    for (int j = 0; j < 6; ++j) row.push_back(m.q(i, j) / kDegree);
    for (int k = 0; k < 3; ++k) row.push_back(m.p_M(i, k) * 1e3);
    out.push_back(row);
  }
  return out;
}

/// Row 0 is in line 2.
Files files_of(const Cell& cell, const Rows& rows) {
  std::string csv = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n";
  for (const Row& row : rows) csv += fmt::format("{:.9f}\n", fmt::join(row, ","));
  return {write_cell(cell), csv, {}};
}

Check checked(const Files& files) {
  const scrambled::Folder folder;
  const auto c = opened(files, folder.path());
  return check_cell(c.cell, c.measured);
}

const Problem* found(const Check& check, const std::string& code) {
  for (const auto& problem : check.findings)
    if (problem.code == code) return &problem;
  return nullptr;
}

Check after(std::uint64_t seed, const std::function<void(Rows&)>& slip, double geometry = 0.5e-3) {
  const Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = kRows;
  plan.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = geometry;
  Rows rows = rows_of(simulate(cell, plan).measured);
  slip(rows);
  return checked(files_of(cell, rows));
}

/// The warning names these lines, holds the words, and is the only explanation.
void expect_said(const Check& check, const std::string& lines, const std::string& words,
                 const std::string& remedy) {
  const Problem* problem = found(check, "W-CHECK-ROWS");
  ASSERT_NE(problem, nullptr) << verdict(check);
  EXPECT_NE(problem->message.find(lines), std::string::npos) << problem->message;
  EXPECT_NE(problem->message.find(words), std::string::npos) << problem->message;
  EXPECT_NE(problem->help.find(remedy), std::string::npos) << problem->help;
  EXPECT_EQ(found(check, "W-CHECK-CONTRADICT"), nullptr);
  EXPECT_EQ(found(check, "W-CHECK-OUTLIER"), nullptr);
}

TEST(RowFaults, AJointThatTurnsItsSignHalfWayIsNamedWithItsLines) {
  for (long seed = 1; seed <= tests::scaled(1); ++seed)
    for (const int joint : {0, 1, 2, 4})
      expect_said(after(static_cast<std::uint64_t>(seed),
                        [&](Rows& rows) {
                          for (std::size_t i = 40; i < rows.size(); ++i)
                            rows[i][static_cast<std::size_t>(joint)] *= -1.0;
                        }),
                  "lines 4", fmt::format("J{} counts the other way", joint + 1),
                  fmt::format("change the sign of q{}_deg", joint + 1));
}

TEST(RowFaults, LastRowsInMetresAreNamedHoweverManyTheyAre) {
  for (const std::size_t last : {4U, 12U, 30U})
    expect_said(after(2,
                      [&](Rows& rows) {
                        for (std::size_t i = rows.size() - last; i < rows.size(); ++i)
                          for (std::size_t k = 6; k < 9; ++k) rows[i][k] /= 1e3;
                      }),
                fmt::format("lines {} to 81", 82 - last), "the measured points are in m, not in mm",
                "multiply x_mm, y_mm, z_mm by 1000");
}

TEST(RowFaults, RowsInRadiansAreNamed) {
  expect_said(after(3,
                    [](Rows& rows) {
                      for (std::size_t i = 50; i < rows.size(); ++i)
                        for (std::size_t j = 0; j < 6; ++j) rows[i][j] *= kDegree;
                    }),
              "lines 52 to 81", "the joint angles are in rad, not in deg", "by 57.29577");
}

TEST(RowFaults, PointsOneRowAwayFromTheirJointsAreNamed) {
  const auto shift = [](Rows& rows, std::size_t from) {
    for (std::size_t i = rows.size() - 1; i > from; --i)
      std::copy(rows[i - 1].begin() + 6, rows[i - 1].end(), rows[i].begin() + 6);
  };
  expect_said(after(1, [&](Rows& rows) { shift(rows, 0); }), "lines 3 to 81", "one row above",
              "move x_mm, y_mm, z_mm of lines 3 to 81 up by one row");
  expect_said(after(2, [&](Rows& rows) { shift(rows, 39); }), "lines 42 to 81", "one row above",
              "up by one row");
  const auto up = [](Rows& rows) {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
      std::copy(rows[i + 1].begin() + 6, rows[i + 1].end(), rows[i].begin() + 6);
  };
  expect_said(after(3, up), "lines 2 to 80", "one row below", "down by one row");
}

TEST(RowFaults, ARunEndsWhereItsRepairDoes) {
  // The points of a block have moved down by one row inside of it: the last of them is lost, and
  // the first row of the block holds that of nobody.
  for (long seed = 1; seed <= tests::scaled(1); ++seed)
    expect_said(after(static_cast<std::uint64_t>(seed),
                      [](Rows& rows) {
                        for (std::size_t i = 35; i > 20; --i)
                          std::copy(rows[i - 1].begin() + 6, rows[i - 1].end(),
                                    rows[i].begin() + 6);
                        for (std::size_t k = 6; k < 9; ++k)
                          rows[20][k] = 0.5 * (rows[3][k] + rows[60][k]);
                      }),
                "lines 23 to 37", "one row above", "of lines 23 to 37 up by one row");
}

TEST(RowFaults, AllThatOneReadingGivesMovesWithItsPoint) {
  const Cell cell = random_cell(1, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = kRows;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  const Rows rows = rows_of(simulate(cell, plan).measured);
  Files files = files_of(cell, rows);
  std::istringstream lines(files.csv);
  std::string out, line, before;
  for (int i = 0; std::getline(lines, line); ++i) {
    // Joints of this row, points of the row above.
    const auto cut = [](const std::string& of) {
      std::size_t at = 0;
      for (int k = 0; k < 6; ++k) at = of.find(',', at) + 1;
      return at;
    };
    const std::string here = line.substr(0, cut(line));
    const std::string points = line.substr(cut(line));
    out += here +
           (i == 0 ? points + ",qw,qx,qy,qz,sx_um,sy_um,sz_um"
                   : (i == 1 ? points : before) + ",1,0,0,0,10,10,10") +
           "\n";
    before = points;
  }
  files.csv = out;
  const Check check = checked(files);
  const Problem* problem = found(check, "W-CHECK-ROWS");
  ASSERT_NE(problem, nullptr) << verdict(check);
  EXPECT_NE(problem->help.find("move x_mm, y_mm, z_mm, qw, qx, qy, qz, sx_um, sy_um, sz_um of"),
            std::string::npos)
      << problem->help;
}

TEST(RowFaults, SoundFilesAndOtherErrorsNameNone) {
  EXPECT_EQ(found(after(1, [](Rows&) {}), "W-CHECK-ROWS"), nullptr);
  EXPECT_EQ(found(after(
                      2, [](Rows&) {}, 3e-3),
                  "W-CHECK-ROWS"),
            nullptr);
  const auto scattered = [](Rows& rows) {
    for (std::size_t i = 0; i < rows.size(); i += 3)
      for (std::size_t k = 6; k < 9; ++k)
        rows[i][k] +=
            20.0 * std::sin(97.3 * static_cast<double>(i) + 31.0 * static_cast<double>(k));
  };
  EXPECT_EQ(found(after(3, scattered), "W-CHECK-ROWS"), nullptr);
  const auto bumped = [](Rows& rows) {
    for (std::size_t i = 40; i < rows.size(); ++i) rows[i][8] += 5.0;
  };
  EXPECT_EQ(found(after(1, bumped), "W-CHECK-ROWS"), nullptr);
}

/// A joint counts the other way in the rows first ... last.
SimulatedArm turned_in(int first, int last, int joint = 2) {
  SimulatedArm out = simulated_arm(2, kRows, 0.5e-3);
  for (int i = first; i <= last; ++i) out.measured.q(i, joint) *= -1.0;
  return out;
}

std::vector<Problem> faults_of(const SimulatedArm& at) {
  return row_fault_findings(at.cell, at.measured, at.rows,
                            place_nominal(at.cell, at.measured, at.rows));
}

TEST(RowFaults, AreSaidEachWithItsOwnLinesAndAtMostThreeOfThem) {
  SimulatedArm at = turned_in(50, 57);
  EXPECT_EQ(faults_of(at).size(), 1U);
  for (int i = 60; i < 66; ++i) at.measured.q(i, 1) *= -1.0;
  const auto two = faults_of(at);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NE(two[0].message, two[1].message);
  at.measured.p_M.middleRows(68, 5) *= 1e3;
  at.measured.q.block(75, 0, 4, 6) *= kDegree;
  EXPECT_EQ(faults_of(at).size(), 3U) << "of four";
}

TEST(RowFaults, OfAFewRowsOrOneOfTheRowsAreNotSaid) {
  EXPECT_TRUE(faults_of(turned_in(60, 60)).empty());
  SimulatedArm at = turned_in(20, 27);
  EXPECT_FALSE(faults_of(at).empty());
  const ArmState placed = place_nominal(at.cell, at.measured, at.rows);
  const std::vector<int> few(at.rows.begin(), at.rows.begin() + 29);
  EXPECT_TRUE(row_fault_findings(at.cell, at.measured, few, placed).empty());
}

TEST(RowFaults, AreNotSoughtInSeveralSetUpsNorWithOneAxisNorOutsideOfFiles) {
  const SimulatedArm at = turned_in(50, 57);
  EXPECT_EQ(faults_of(at).size(), 1U);
  const ArmState placed = place_nominal(at.cell, at.measured, at.rows);
  MeasurementFiles other = at.measured;
  other.setup.assign(static_cast<std::size_t>(other.size()), 0);
  EXPECT_TRUE(row_fault_findings(at.cell, other, at.rows, placed).empty());
  other = at.measured;
  other.tables.clear();
  EXPECT_TRUE(row_fault_findings(at.cell, other, at.rows, placed).empty());
  other = at.measured;
  other.has_axis = {true, false, false};
  EXPECT_TRUE(row_fault_findings(at.cell, other, at.rows, placed).empty());
}

TEST(RowFaults, AreNotSoughtWhereTheArmLeavesNothingToExplain) {
  const SimulatedArm sound = simulated_arm(2, kRows, 0.5e-3);
  EXPECT_TRUE(
      row_fault_findings(sound.cell, sound.measured, sound.rows, fitted_state(sound)).empty());
}

}  // namespace
}  // namespace plumb::offline
