// SPDX-License-Identifier: Apache-2.0
#include "cell/link_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cell/cell.hpp"

namespace plumb::offline {
namespace {

Cell read(const std::string& convention, const std::string& links) {
  return parse_cell("schema = \"cell/1\"\n[robot]\ndh_convention = \"" + convention +
                        "\"\njoints = [\n"
                        "{ name = \"J1\", alpha = 90, a = 100, d = 300, q = [-90, 90] },\n"
                        "{ name = \"J2\", alpha = 0, a = 600, d = 0, q = [-90, 90] },\n"
                        "{ name = \"J3\", alpha = 0, a = 500, d = 50, q = [-90, 90] }]\n" +
                        links + "[measurement]\nfiles = []\n",
                    "/cell.toml");
}

std::string link(const std::string& joint, const std::string& com, const std::string& frame) {
  return "[[robot.links]]\njoint = \"" + joint + "\"\nmass_kg = 20\ncom_mm = " + com +
         (frame.empty() ? "" : "\ncom_frame = \"" + frame + "\"") + "\n";
}

bool is_warned(const Cell& cell) {
  for (const auto& problem : cell.remarks)
    if (problem.code == "W-CELL-CENTRE") return true;
  return false;
}

void expect_at(const Cell& cell, int joint, double x, double y, double z) {
  const auto& com = *cell.mechanics[static_cast<std::size_t>(joint)].link_com_m;
  EXPECT_NEAR(com[0], x, 1e-12);
  EXPECT_NEAR(com[1], y, 1e-12);
  EXPECT_NEAR(com[2], z, 1e-12);
}

TEST(LinkFrame, ACentreOfTheDhFrameIsTurnedAndMovedAsItsRowSays) {
  // By hand, standard: Tz(300) Tx(100) Rx(90) maps (1, 2, 3) to (101, -3, 302).
  expect_at(read("standard", link("J1", "[1, 2, 3]", "dh")), 0, 0.101, -0.003, 0.302);
  expect_at(read("standard", link("J2", "[-300, 0, 0]", "dh")), 1, 0.3, 0.0, 0.0);
  // Modified: the frame of the link is the joint's own, moved by d alone.
  expect_at(read("modified", link("J1", "[1, 2, 3]", "dh")), 0, 0.001, 0.002, 0.303);
  expect_at(read("modified", link("J3", "[1, 2, 3]", "dh")), 2, 0.001, 0.002, 0.053);
}

TEST(LinkFrame, OfTheJointIsWhatIsMeantWhereNothingIsSaid) {
  for (const char* frame : {"", "joint"})
    expect_at(read("standard", link("J1", "[1, 2, 3]", frame)), 0, 0.001, 0.002, 0.003);
}

TEST(LinkFrame, ACentreFarBesideItsLinkIsSaid) {
  EXPECT_FALSE(is_warned(read("standard", link("J2", "[300, 0, 80]", ""))));
  EXPECT_FALSE(is_warned(read("standard", link("J2", "[-300, 0, 80]", "dh"))));
  EXPECT_TRUE(is_warned(read("standard", link("J2", "[-300, 0, 80]", ""))));
  EXPECT_TRUE(is_warned(read("standard", link("J2", "[300, 0, 80]", "dh"))));
}

TEST(LinkFrame, TheDistanceIsFromTheLineBetweenTheJoints) {
  const Cell cell = read("standard", "");
  EXPECT_NEAR(distance_from_link(cell.nominal, 1, {0.3, 0.04, 0.03}), 0.05, 1e-12);
  EXPECT_NEAR(distance_from_link(cell.nominal, 1, {-0.3, 0.0, 0.4}), 0.5, 1e-12);
  EXPECT_NEAR(distance_from_link(cell.nominal, 1, {0.9, 0.0, 0.4}), 0.5, 1e-12);
}

TEST(LinkFrame, AnUnknownFrameIsRefused) {
  EXPECT_THROW(read("standard", link("J1", "[1, 2, 3]", "flange")), Failure);
}

}  // namespace
}  // namespace plumb::offline
