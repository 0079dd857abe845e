// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "cell/cell.hpp"
#include "cell/measurement_reader.hpp"
#include "cell/measurements.hpp"
#include "tests/cell/support.hpp"

namespace plumb::offline {
namespace {

const Problem* found(const std::vector<Problem>& problems, const std::string& code) {
  for (const auto& problem : problems)
    if (problem.code == code) return &problem;
  return nullptr;
}

std::vector<Problem> remarks_of(const std::string& robot) {
  return parse_cell(
             "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n"
             "joints = [{ name = \"J1\", a = 300, q = [-90, 90] }]\n" +
                 robot + "[measurement]\nfiles = []\n",
             "/cell.toml")
      .remarks;
}

TEST(CellSense, AGravityOfAnotherUnitIsSaidWithTheOneToWrite) {
  const std::pair<const char*, const char*> kCases[] = {{"[0, 0, -9810]", "mm/s^2"},
                                                        {"[0, -981, 0]", "cm/s^2"},
                                                        {"[0, 0, -1]", "multiples"},
                                                        {"[0, 0, -5]", "no place on Earth"}};
  for (const auto& [gravity, words] : kCases) {
    const auto remarks = remarks_of(std::string("gravity = ") + gravity + "\n");
    const Problem* problem = found(remarks, "W-CELL-GRAVITY");
    ASSERT_NE(problem, nullptr) << gravity;
    EXPECT_NE(problem->place->label.find(words), std::string::npos) << problem->place->label;
    EXPECT_NE(problem->help.find("-9.81"), std::string::npos) << problem->help;
  }
  for (const char* sound : {"[0, 0, -9.81]", "[0, 0, 0]", "[6.937, 0, -6.937]", "[0, 0, 9.8]"})
    EXPECT_EQ(found(remarks_of(std::string("gravity = ") + sound + "\n"), "W-CELL-GRAVITY"),
              nullptr)
        << sound;
}

TEST(CellSense, MassesOfTonnesAreSaid) {
  const std::string link = "[[robot.links]]\njoint = \"J1\"\nmass_kg = ";
  EXPECT_NE(found(remarks_of(link + "60000\n"), "W-CELL-MASS"), nullptr);
  EXPECT_EQ(found(remarks_of(link + "1200\n"), "W-CELL-MASS"), nullptr);
  EXPECT_NE(found(remarks_of("payload = { mass_kg = 60000 }\n"), "W-CELL-MASS"), nullptr);
}

/// The remarks about a file that holds this number in a column of this name.
std::vector<Problem> remarks_of_column(const std::string& header, const std::string& value) {
  const Folder folder;
  const auto file = folder.put(
      "m.csv", "pose,q1_deg,x_mm," + header + "\nA,1,100," + value + "\nB,2,200," + value + "\n");
  return read_measurements({file}, {true}, Needs::kJointsAndPosition).tables[0].remarks;
}

TEST(CellSense, AColumnInAnotherUnitIsSaid) {
  const std::pair<const char*, const char*> kOdd[] = {
      {"temp_degC", "293.5"}, {"temp_J2_degC", "300"}, {"temp_degC", "70"},
      {"temp_K", "21.5"},     {"payload_kg", "60000"}, {"travel_j1_deg", "1e6"}};
  for (const auto& [header, value] : kOdd)
    EXPECT_NE(found(remarks_of_column(header, value), "W-CSV-VALUE"), nullptr) << header;
  const std::pair<const char*, const char*> kSound[] = {
      {"temp_degC", "21.5"}, {"temp_J2_degC", "72"}, {"temp_degC", "-20"},    {"temp_K", "293.5"},
      {"payload_kg", "600"}, {"payload_g", "60000"}, {"travel_j1_deg", "350"}};
  for (const auto& [header, value] : kSound)
    EXPECT_EQ(found(remarks_of_column(header, value), "W-CSV-VALUE"), nullptr) << header;
}

}  // namespace
}  // namespace plumb::offline
