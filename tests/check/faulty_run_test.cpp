// SPDX-License-Identifier: Apache-2.0
// What is said of rows that were written otherwise than the others.
#include "check/faulty_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "cell/table_file.hpp"
#include "tests/check/simulated_arm.hpp"

namespace plumb::offline {
namespace {

constexpr int kRows = 40;

/// A file whose first row is in line 12, and every second line a comment.
Table file_with(const std::vector<std::string>& headings) {
  std::string out;
  for (int i = 0; i < 10; ++i) out += "# a comment\n";
  out += fmt::format("{}\n", fmt::join(headings, ","));
  for (int i = 0; i < kRows; ++i) {
    std::vector<double> row;
    while (row.size() < headings.size())
      row.push_back(0.01 * (i + 1) + 0.1 * static_cast<double>(row.size()));
    out += fmt::format("{}\n# a comment\n", fmt::join(row, ","));
  }
  return parse_table(out, "measurements.csv");
}

Table scara_file() {
  return file_with(
      {"q1_deg", "q2_deg", "q3_mm", "q4_deg", "x_mm", "y_mm", "z_mm", "qw", "temp_degC"});
}

/// The third joint slides.
const Cell& scara() {
  static const Cell cell = random_cell(1, 4, format::Convention::kStandard, ArmKind::kScara);
  return cell;
}

/// Rows of the file that a search looked at: all but the first five.
std::vector<int> searched() {
  std::vector<int> out;
  for (int i = 5; i < kRows; ++i) out.push_back(i);
  return out;
}

FaultyRun run_of(RowFault fault) {
  return {.fault = std::move(fault),
          .first = 10,
          .last = 19,
          .before = 0.3,
          .after = 50e-6,
          .others = 40e-6};
}

Problem said_of(RowFault fault) {
  return row_fault_finding(scara(), scara_file(), searched(), run_of(std::move(fault)));
}

RowFault shifted(int shift) { return {.kind = RowFault::Kind::kShift, .shift = shift}; }

RowFault in_radians() {
  return {.kind = RowFault::Kind::kTurnUnit, .factor = 180.0 / M_PI, .is = "rad", .says = "deg"};
}

RowFault in_metres() {
  return {.kind = RowFault::Kind::kPointUnit, .factor = 1e3, .is = "m", .says = "mm"};
}

TEST(FaultyRun, IsNamedByTheLinesOfItsRowsInTheFile) {
  for (const RowFault& fault : {RowFault{}, shifted(-1), shifted(2), in_radians(), in_metres()}) {
    const Problem said = said_of(fault);
    // Rows 15 to 24 of the file.
    EXPECT_TRUE(holds(said.message, "in lines 42 to 60 ")) << said.message;
    EXPECT_TRUE(holds(said.help, "lines 42 to 60")) << said.help;
    EXPECT_TRUE(holds(said.message, "these 10 rows")) << said.message;
    ASSERT_TRUE(said.place);
    EXPECT_EQ(said.place->line, 42);
  }
}

TEST(FaultyRun, OfAnglesIsMendedInTheColumnsThatTurnAlone) {
  const std::string help = said_of(in_radians()).help;
  EXPECT_TRUE(holds(help, "multiply q1_deg, q2_deg, q4_deg by 57.29577")) << help;
  EXPECT_FALSE(holds(help, "q3")) << help;
}

TEST(FaultyRun, OfPointsIsMendedInTheCoordinatesThatTheFileHas) {
  EXPECT_TRUE(holds(said_of(in_metres()).help, "multiply x_mm, y_mm, z_mm by 1000 in"));
  const Table flat = file_with({"q1_deg", "q2_deg", "y_mm", "z_mm"});
  const Problem said = row_fault_finding(scara(), flat, searched(), run_of(in_metres()));
  EXPECT_TRUE(holds(said.help, "multiply y_mm, z_mm by 1000 in")) << said.help;
  ASSERT_TRUE(said.place) << "there is no x";
}

TEST(FaultyRun, OfASignNamesItsOwnJoint) {
  const Problem said = said_of({.kind = RowFault::Kind::kSign, .joint = 1});
  EXPECT_TRUE(holds(said.message, scara().nominal.joints[1].name + " counts the other way"));
  EXPECT_TRUE(holds(said.help, "change the sign of q2_deg in")) << said.help;
}

/// A point that belongs to the joints above has slipped down, and goes up again.
TEST(FaultyRun, OfPointsThatSlippedSendsThemBack) {
  for (const int rows : {1, 2}) {
    const std::string many = rows == 1 ? "one row" : "two rows";
    const Problem down = said_of(shifted(-rows)), up = said_of(shifted(rows));
    EXPECT_TRUE(holds(down.message, many + " above")) << down.message;
    EXPECT_TRUE(holds(down.help, "up by " + many)) << down.help;
    EXPECT_TRUE(holds(up.message, many + " below")) << up.message;
    EXPECT_TRUE(holds(up.help, "down by " + many)) << up.help;
    EXPECT_TRUE(holds(up.help, "move x_mm, y_mm, z_mm, qw of")) << "all of one reading" << up.help;
    EXPECT_FALSE(holds(up.help, "temp")) << up.help;
  }
}

TEST(FaultyRun, ComparesWithTheOthersWhereThereAreOthers) {
  EXPECT_TRUE(holds(said_of({}).message, "and the others by 0.04 mm")) << said_of({}).message;
  FaultyRun all = run_of(shifted(-1));
  all.first = 1;
  all.last = static_cast<int>(searched().size()) - 1;  // the first has no partner
  const Problem said = row_fault_finding(scara(), scara_file(), searched(), all);
  EXPECT_FALSE(holds(said.message, "the others")) << said.message;
}

TEST(UnitsOfAFile, AreThoseOfItsHeadingsAndTheUsualOnesWhereItHasNone) {
  EXPECT_EQ(unit_of_points(file_with({"q1_deg", "z_m"})), "m");
  EXPECT_EQ(unit_of_points(file_with({"q1_deg"})), "mm");
  EXPECT_EQ(unit_of_turns(scara(), file_with({"q3_mm", "q4_rad"})), "rad") << "joint 3 slides";
  EXPECT_EQ(unit_of_turns(scara(), file_with({"q3_mm", "x_mm"})), "deg");
}

}  // namespace
}  // namespace plumb::offline
