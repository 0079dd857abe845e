// SPDX-License-Identifier: Apache-2.0
#include "rt/csv_targets.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <numbers>

#include "program/scratch_folder.hpp"
#include "tests/drivers/rt/problem_of.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

class CsvTargets : public testing::Test {
 protected:
  std::vector<CsvTarget> read(const std::string& text, int joints = 2) const {
    std::ofstream(file, std::ios::binary) << text;
    return read_csv_targets(file, joints);
  }
  /// Refused with the code of such files, at this line, with these words.
  void refused(const std::string& text, int line, const std::string& words) const {
    const Problem problem = tests::problem_of([&] { std::ignore = read(text); });
    EXPECT_EQ(problem.code, "E-RT-CSV") << text;
    ASSERT_TRUE(problem.place) << text;
    EXPECT_EQ(problem.place->line, line) << text;
    EXPECT_NE(problem.message.find(words), std::string::npos) << problem.message;
    EXPECT_FALSE(problem.help.empty());
  }
  const ScratchFolder scratch{"plumb-targets-"};
  const std::filesystem::path file = scratch.path() / "targets.csv";
};

constexpr char kSound[] = "x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_deg\n1,2,3,1,0,0,0,4,5\n";

/// The columns of one row, and their numbers, written in this order.
std::string table(const std::vector<std::pair<std::string, double>>& cells) {
  std::string head, row;
  for (const auto& [name, value] : cells) {
    head += (head.empty() ? "" : ",") + name;
    row += (row.empty() ? "" : ",") + fmt::format("{:.17g}", value);
  }
  return head + "\n" + row + "\n";
}

TEST_F(CsvTargets, TheOrderOfTheColumnsTheirUnitsAndTheLengthOfTheQuaternionChangeNothing) {
  tests::Random random(5);
  for (long i = 0; i < tests::scaled(200); ++i) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(
        random.uniform(-3.0, 3.0),
        Eigen::Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 1.0).normalized()));
    const double length = random.uniform(0.6, 3.0) * (i % 2 == 0 ? 1.0 : -1.0);
    const double q1 = random.uniform(-3.0, 3.0), q2 = random.uniform(-3.0, 3.0);
    std::vector<std::pair<std::string, double>> cells{
        {"x_mm", 1e3 * q1},
        {"y_mm", -20.0},
        {"z_mm", 0.5},
        {"qw", length * turn.w()},
        {"qx", length * turn.x()},
        {"qy", length * turn.y()},
        {"qz", length * turn.z()},
        {"note", 7.0},
        {i % 3 == 0 ? "q1_rad" : "q1_deg", i % 3 == 0 ? q1 : q1 / kDeg},
        {i % 5 == 0 ? "q2_mm" : "q2_rad", i % 5 == 0 ? 1e3 * q2 : q2}};
    for (std::size_t k = cells.size(); k > 1; --k)
      std::swap(cells[k - 1], cells[static_cast<std::size_t>(random.below(static_cast<int>(k)))]);
    const auto rows = read(table(cells));
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_LT((rows[0].X_BD.R - turn.toRotationMatrix()).norm(), 1e-14);
    EXPECT_LT((rows[0].X_BD.p - Eigen::Vector3d(q1, -0.02, 5e-4)).norm(), 1e-14);
    ASSERT_EQ(rows[0].q.size(), 2U);
    EXPECT_NEAR(rows[0].q[0], q1, 1e-14);
    EXPECT_NEAR(rows[0].q[1], q2, 1e-14);
  }
}

TEST_F(CsvTargets, RowsKeepTheirOrderAndRemarksEmptyLinesAndEndsOfLinesAreNone) {
  const std::string text =
      "# first\r\n\r\nx_mm,y_mm,z_mm,q1_deg,q2_deg\r\n1,0,0,0,0\r\n# between\r\n\r\n2,0,0,0,0\r\n"
      "3,0,0,0,0";
  const auto rows = read(text);
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_DOUBLE_EQ(rows[i].X_BD.p.x(), 1e-3 * static_cast<double>(i + 1));
  EXPECT_TRUE(rows[0].X_BD.R.isIdentity()) << "no columns of an orientation";
}

TEST_F(CsvTargets, EveryCellThatIsNoNumberIsRefusedAtItsLineByItsColumn) {
  ASSERT_EQ(read(kSound).size(), 1U);
  const std::vector<std::string> names{"x_mm", "y_mm", "z_mm",   "qw",    "qx",
                                       "qy",   "qz",   "q1_deg", "q2_deg"};
  for (std::size_t column = 0; column < names.size(); ++column)
    for (const char* const bad : {"", "x", "1mm", "1 ", "nan", "inf", "-inf", "1e999"}) {
      std::string row;
      for (std::size_t k = 0; k < names.size(); ++k)
        row += (k == 0 ? "" : ",") + std::string(k == column ? bad : k == 3 ? "1" : "0");
      const std::string head = std::string(kSound).substr(0, std::string(kSound).find('\n') + 1);
      refused(head + "# remark\n" + row + "\n", 3, "'" + names[column] + "'");
    }
}

TEST_F(CsvTargets, AMissingColumnIsRefusedByName) {
  const std::vector<std::string> names{"x_mm", "y_mm", "z_mm", "q1_deg", "q2_deg"};
  for (std::size_t left_out = 0; left_out < names.size(); ++left_out) {
    std::vector<std::pair<std::string, double>> cells;
    for (std::size_t k = 0; k < names.size(); ++k)
      if (k != left_out) cells.emplace_back(names[k], 1.0);
    refused(table(cells), 1, "'" + names[left_out] + "'");
  }
}

/// With qw left out a quarter of a turn would be taken for another rotation.
TEST_F(CsvTargets, AnOrientationIsAllOfItsFourColumnsOrNone) {
  const char* const names[] = {"qw", "qx", "qy", "qz"};
  for (unsigned there = 1; there < 15; ++there) {
    std::vector<std::pair<std::string, double>> cells{
        {"x_mm", 1.0}, {"y_mm", 2.0}, {"z_mm", 3.0}, {"q1_deg", 0.0}, {"q2_deg", 0.0}};
    for (unsigned k = 0; k < 4; ++k)
      if ((there >> k & 1U) != 0) cells.emplace_back(names[k], 0.9);
    refused(table(cells), 1, "has no column 'q");
  }
}

TEST_F(CsvTargets, AQuaternionThatIsNoRotationIsRefused) {
  const std::string head = "x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_deg\n";
  for (const char* const turn : {"0,0,0,0", "0.1,0.1,0,0", "1e200,0,0,0", "0,-1e160,0,1e160"})
    refused(head + "1,2,3," + turn + ",4,5\n", 2, "are no rotation");
}

TEST_F(CsvTargets, AFileWithoutRowsOrWithoutAHeaderIsRefused) {
  refused("", 1, "header");
  refused("# only a remark\n", 1, "header");
  refused("x_mm,y_mm,z_mm,q1_deg,q2_deg\n# nothing\n", 2, "no rows");
  refused("x_mm,y_mm,z_mm,q1_deg,q2_deg\n1,2,3,4\n", 2, "'q2_deg'");
}

}  // namespace
}  // namespace plumb::drivers::rt
