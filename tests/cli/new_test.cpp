// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sandbox.hpp"

namespace {

Ran new_from(const Sandbox& box, const std::string& table) {
  box.write("dh.csv", table);
  return box.plumb({"new", "c", "--dh", "dh.csv", "--convention", "modified", "--force"});
}

/// The rows of cell.toml that a table in the plainest form gives.
constexpr const char* kPlainTable =
    "joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,0,0,118,0\nJ2,-90,612,0,180\nJ3,60,0.5,0,-45\n";

TEST(NewDh, TheSameTableAsOtherPeopleWriteItIsTheSameArm) {
  const Sandbox box;
  ASSERT_EQ(new_from(box, kPlainTable).exit, 0);
  const std::string plain = box.read("c/cell.toml");
  for (const char* table : {
           "joint,alpha [°],a [mm],d [mm],theta "
           "[°]\nJ1,0,0,118,0\nJ2,-90,612,0,180\nJ3,60,0.5,0,-45\n",
           "Joint,Alpha (deg),A (m),D / mm,Theta (degrees)\nJ1,0,0,118,0\nJ2,-90,0.612,0,180\n"
           "J3,60,0.0005,0,-45\n",
           "name;α_{i-1} [deg];a_{i-1} [mm];d_i [mm];θ_i "
           "[deg]\nJ1;0;0;118;θ1\nJ2;-90°;612;0;q2+180\n"
           "J3;60,0;0,5;0;-45\n",
           "link\talpha_rad\ta_mm\td_mm\ttheta_rad\nJ1\t0\t0\t118\t0\nJ2\t-pi/2\t612\t0\tπ\n"
           "J3\tpi/3\t0.5\t0\t-0.25*pi\n",
           "alpha,a,d,theta,joint\n0,0,118 mm,0,J1\n−90°,0.612 m,0,180 "
           "deg,J2\n60°,0.5mm,0,-45°,J3\n",
           "i,alpha,a_mm,d_mm,theta\nJ1,0,0,118,q1\nJ2,-pi/2,612,0,q_2 + "
           "pi\nJ3,2*pi/6,0.5,0,-pi/4\n",
           // As import reads them: wide blanks, thousands, minutes of arc, brackets of all kinds.
           "joint,alpha {deg},a(i-1) <um>,d_mm,theta°\nJ1,0,0,118\u00A0mm,0\n"
           "J2,\u221290\u202F°,612'000,0,180°0′\nJ3,60°0′0″,5e2,0,-45\n",
           "\xEF\xBB\xBF# my arm\r\n#,alphai_deg,ai_mm,di_mm,thetai_deg\r\nJ1,0,0,118,0\r\n"
           "J2,-90,612,0,180\r\nJ3,60,0.5,0,-45\r\n",
       }) {
    const Ran ran = new_from(box, table);
    EXPECT_EQ(ran.exit, 0) << table << ran.err;
    EXPECT_EQ(box.read("c/cell.toml"), plain) << table;
  }
}

TEST(NewDh, AColumnWithoutUnitGetsTheProposalOfItsNumbers) {
  const Sandbox box;
  const auto helps = [&](const std::string& alpha, const std::string& a) {
    const Ran ran = new_from(box, "alpha,a,d,theta\n0,0,0,0\n" + alpha + "," + a + ",0,0\n");
    EXPECT_EQ(ran.exit, 3);
    return ran.err;
  };
  EXPECT_NE(helps("1.570796", "612").find("'alpha_rad'"), std::string::npos);
  EXPECT_NE(helps("-1.5687", "612").find("'theta_rad'"), std::string::npos) << "of one table";
  EXPECT_NE(helps("1.57", "612").find("'a_mm'"), std::string::npos);
  EXPECT_NE(helps("90", "0.612").find("'alpha_deg'"), std::string::npos);
  EXPECT_NE(helps("90", "0.612").find("'a_m'"), std::string::npos);
  EXPECT_NE(helps("1.2", "8").find("'alpha_deg', or to 'alpha_rad'"), std::string::npos);
  EXPECT_NE(helps("1.2", "8").find("'a_mm', or to 'a_m'"), std::string::npos);
}

TEST(NewDh, TheRemedyNeitherDeletesAJointNorGivesATextAUnit) {
  const Sandbox box;
  for (const auto& [table, named] : std::vector<std::pair<std::string, std::string>>{
           {"j,theta,d,a,alpha,offset\n1,q1,0.1273,0,1.5708,0\n2,q2,0,-0.612,0,0\n", "alpha_rad"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,pi/2,0,0,0\n", "write 90 there"},
           {"joint,alpha_rad,a_mm,d_mm,theta_rad\nJ1,90°,0,0,0\n", "write 1.57079632679489"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,x,0,0,0\n", "'x' is not a number"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,0,\"1,234\",0,0\n", "'1,234' is not a number"},
           {"joint,alpha_deg,a [furlong],d_mm,theta_deg\nJ1,0,3,0,0\n", "'furlong' is not a unit"},
           {"joint,alpha_deg,a_mmm,d_mm,theta_deg\nJ1,0,3,0,0\n", "'mmm' is not a unit"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,,0,0,0\n", "has an empty cell"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,0,0,0\n", "complete this row"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,0,0,q1,0\n", "prismatic"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,0,0,0,q2\n", "variable of joint 1"},
           {"joint,alpha_deg,a_mm,d_mm,theta_deg,type\nJ1,0,0,0,q1,prismatic\n", "prismatic"},
           {"joint,alpha_deg,a_cm,d_mm,theta_deg\nJ1,0,3,0,0\n", "1 cm = 10 mm"},
           {"0,0,118,0\n90,0,0,0\n", "the names of the columns"},
           {"alpha_deg a_mm d_mm theta_deg\n0 0 118 0\n", "nothing separates"},
           {"kinematics:\n  theta: [0,0,0]\n  a: [0,1,2]\n", "YAML"},
           {"- {alpha: 0, a: 1, d: 2, theta: 0}\n", "YAML"},
           {"{\"alpha\": [0, 1], \"a\": [0, 1]}\n", "JSON"},
           {"<robot name=\"a\"/>\n", "XML"},
           {"[robot]\njoints = []\n", "TOML"},
           {"| alpha_deg | a_mm | d_mm | theta_deg |\n", "Markdown"},
           {"L(1) = Link([0 0.4 0.025 pi/2]);\n", "assignments"},
           {std::string("\xFF\xFE\x61\x00", 4), "iconv -f UTF-16 "},
           {"PK\x03\x04 and more", "spreadsheet"},
           {"", "no header"}}) {
    const Ran ran = new_from(box, table);
    EXPECT_EQ(ran.exit, 3) << table << ran.err;
    EXPECT_NE(ran.err.find(named), std::string::npos) << table << ran.err;
    for (const char* wrong :
         {"delete the row", "delete this row", "j_mm", "name_mm", "plumb import"})
      EXPECT_EQ(ran.err.find(wrong), std::string::npos) << table << ran.err;
  }
}

TEST(NewDh, LimitsMayStandInColumnsOfBothKindsAndBeEmptyButNotTwiceInOneKind) {
  const Sandbox box;
  const std::string head = "alpha_deg,a_mm,d_mm,theta_deg,type,q_min_deg,q_max_deg,q_min_mm,";
  const Ran ran = new_from(box, head +
                                    "q_max_mm\n0,0,0,0,,-90,80,,\n0,0,0,0,prismatic,,,0,1500\n"
                                    "0,1,0,0,,,,,\n");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  const std::string cell = box.read("c/cell.toml");
  EXPECT_NE(cell.find("q = [-90, 80]"), std::string::npos) << cell;
  EXPECT_NE(cell.find("q = [0, 1500]"), std::string::npos) << cell;
  EXPECT_NE(ran.err.find("N-DH-LIMITS"), std::string::npos) << ran.err;
  const Ran twice = new_from(box, head + "q_min_rad\n0,0,0,0,,-90,80,,-1\n");
  EXPECT_EQ(twice.exit, 3);
  EXPECT_NE(twice.err.find("'q_min_deg' and 'q_min_rad' are the same quantity"), std::string::npos);
  const Ran none = new_from(box, "alpha_deg,a_mm,d_mm,theta_deg,q_min\n0,0,0,0,1.2\n");
  EXPECT_NE(none.err.find("rename it to 'q_min_deg'"), std::string::npos) << none.err;
}

TEST(NewDh, EveryMistakeOfTheTextIsToldAtOnce) {
  const Sandbox box;
  const Ran ran = new_from(box,
                           "joint,alpha,a_cm,d_mm,theta_deg,mass\nJ1,1.5708,1,x,0,2\nJ2,0,1,,0,2\n"
                           "J3,0,0,0\n");
  for (const char* told : {"'alpha' has no unit", "'cm' is not a unit", "'x' is not a number",
                           "empty cell", "4 cells where the header has 6", "column 'mass'"})
    EXPECT_NE(ran.err.find(told), std::string::npos) << told << ran.err;
}

TEST(NewReach, AnArmInAnotherUnitOfLengthIsDoubted) {
  const Sandbox box;
  const auto doubted = [&](const std::string& unit, const std::string& a) {
    const Ran ran =
        new_from(box, "alpha_deg,a_" + unit + ",d_mm,theta_deg\n0," + a + ",0,0\n90,0,0,0\n");
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.err.find("W-NEW-REACH") != std::string::npos;
  };
  EXPECT_TRUE(doubted("m", "612"));
  EXPECT_TRUE(doubted("mm", "0.612"));
  EXPECT_FALSE(doubted("mm", "612"));
  EXPECT_FALSE(doubted("m", "12"));
  EXPECT_FALSE(doubted("mm", "0")) << "a wrist has no links";
  const auto urdf = [&](const std::string& xyz) {
    box.write("a.urdf",
              "<robot name='a'><link name='b'/><link name='l'/><joint name='j' "
              "type='continuous'><origin xyz='" +
                  xyz +
                  "'/><parent link='b'/>"
                  "<child link='l'/></joint></robot>");
    return box.plumb({"new", "u", "--urdf", "a.urdf", "--force"}).err;
  };
  EXPECT_EQ(urdf("0 0 0.35").find("W-NEW-REACH"), std::string::npos);
}

}  // namespace
