// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cell/measurements.hpp"
#include "cell/table_file.hpp"
#include "check/cell_edit.hpp"
#include "check/measurement_edit.hpp"

namespace plumb::offline {
namespace {

const char* const kCell = R"(schema = "cell/1"
[cell]
name = "Zelle für \"A\""   # größer
[robot]   # the arm
dh_convention = "standard"   # from the data sheet
angle_unit = "deg" # deg!
joints = [
  { name = "J1", alpha = 90.0, d = 300.0, theta = 0.0, q = [-170, 170] },   # first
  { alpha = 0.0, a = 400.0,
    q = [-100, 100] },  # no theta here
]
[measurement]
files = [ "a.csv",  # one
  "b]#.csv" ]   # two
held_out = "file:v.csv"
)";

TEST(CellEdit, ChangesTheValuesAndNotOneOtherCharacter) {
  CellEdit edit;
  edit.dh_convention = "modified";
  edit.angle_unit = "rad";
  edit.files = {{"a_fixed.csv", "b_fixed.csv"}};
  edit.held_out = "file:v_fixed.csv";
  std::string wanted = kCell;
  const auto replace = [&](const std::string& what, const std::string& by) {
    const auto at = wanted.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    wanted.replace(at, what.size(), by);
  };
  replace("\"standard\"", "\"modified\"");
  replace("\"deg\"", "\"rad\"");
  replace("[ \"a.csv\",  # one\n  \"b]#.csv\" ]", "[\"a_fixed.csv\", \"b_fixed.csv\"]");
  replace("file:v.csv", "file:v_fixed.csv");
  EXPECT_EQ(edited(kCell, "cell.toml", edit), wanted);
  EXPECT_EQ(edited(kCell, "cell.toml", {}), kCell);
}

TEST(CellEdit, AddsWhatTheFileLeavesOut) {
  CellEdit edit;
  edit.length_unit = "m";
  edit.theta = {{0, M_PI_2}, {1, -M_PI}};
  const std::string text = edited(kCell, "cell.toml", edit);
  const Cell cell = parse_cell(text, "/cell.toml");
  EXPECT_EQ(cell.length_unit, "m");
  EXPECT_NEAR(cell.nominal.joints[0].theta, M_PI_2, 1e-15);
  EXPECT_NEAR(cell.nominal.joints[1].theta, -M_PI, 1e-15);
  EXPECT_EQ(cell.nominal.joints[0].d, 300.0);
  EXPECT_NE(text.find("# no theta here"), std::string::npos);
  EXPECT_NE(text.find("{ theta = -180"), std::string::npos) << text;
}

TEST(CellEdit, KeepsAByteOrderMarkAndWindowsLineEnds) {
  std::string text = "\xEF\xBB\xBF";
  for (const char* c = kCell; *c != '\0'; ++c) text += *c == '\n' ? "\r\n" : std::string(1, *c);
  CellEdit edit;
  edit.dh_convention = "modified";
  const std::string out = edited(text, "cell.toml", edit);
  EXPECT_EQ(out.size(), text.size());
  EXPECT_NE(out.find("dh_convention = \"modified\"   # from"), std::string::npos);
}

const char* const kCsv =
    "# instrument: tracker\n"
    "pose;q1_deg;q2_deg;dir_j2;x_mm;y_mm;z_mm;note\n"
    "P1;10,5;-20,25;1;1,0;-2,5;3;q1_deg\n"
    "# a remark; -1\n"
    "\"P;2\";+0,5;0,000;-1;1,5e-3;0;-3;\"-7\"\n";

TEST(MeasurementEdit, RenamesHeadingsAndTurnsSignsDigitForDigit) {
  MeasurementEdit edit;
  edit.units = {{"q1", "rad"}, {"x", "m"}};
  edit.negated = {"q2", "dir_j2", "y", "x"};
  EXPECT_EQ(edited(kCsv, 2, edit),
            "# instrument: tracker\n"
            "pose;q1_rad;q2_deg;dir_j2;x_m;y_mm;z_mm;note\n"
            "P1;10,5;20,25;-1;-1,0;2,5;3;q1_deg\n"
            "# a remark; -1\n"
            "\"P;2\";+0,5;0,000;1;-1,5e-3;0;-3;\"-7\"\n");
  EXPECT_EQ(edited(kCsv, 2, {}), kCsv);
}

TEST(MeasurementEdit, SwapsAxesByTheirNames) {
  MeasurementEdit edit;
  edit.names = {{"x", "y"}, {"y", "x"}};
  const Table before = parse_table(kCsv, "a.csv");
  const Table after = parse_table(edited(kCsv, 2, edit), "b.csv");
  EXPECT_EQ(after.find("x")->values, before.find("y")->values);
  EXPECT_EQ(after.find("y")->values, before.find("x")->values);
  EXPECT_EQ(after.find("z")->values, before.find("z")->values);
}

}  // namespace
}  // namespace plumb::offline
