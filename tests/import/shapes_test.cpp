// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "import/completeness.hpp"
#include "tests/import/imported_text.hpp"

namespace plumb::offline {
namespace {

using tests::imported_text;
using tests::in_short;
using tests::refusal_of;
using tests::remark_of;

constexpr const char* kFanuc =
    "/PROG  CAL\r\n/ATTR\r\n/MN\r\n  1:J P[1] 50% FINE    ;\r\n/POS\r\n"
    "P[1]{\r\n   GP1:\r\n\tUF : 0, UT : 1,\t\r\n\tJ1=     54.830 deg,\tJ2=     52.466 deg,\r\n"
    "\tJ3=    -21.629 deg,\tJ4= 1.0 deg\r\n   GP2:\r\n\tJ1= 99.0 deg\r\n};\r\n"
    "P[2:\"home\"]{\r\n   GP1:\r\n\tJ1= 1 deg, J2= 2 deg, J3= 3 deg, J4= 4 deg\r\n};\r\n/END\r\n";

TEST(Programs, TheirJointPositionsAreRead) {
  EXPECT_EQ(in_short(imported_text(kFanuc)),
            "pose=P1|P2 q1_deg=54.830|1 q2_deg=52.466|2 q3_deg=-21.629|3 q4_deg=1.0|4");
  EXPECT_EQ(
      in_short(imported_text(
          "MODULE Cal\n  CONST jointtarget a1:=[[1,-2,3.5,4,5,6],[9E+09,9E9,9E9,9E9,9E9,9E9]];\n"
          "  PERS jointtarget a2 := [[7,8,9,10,11,12],[0,0,0,0,0,0]];\nENDMODULE\n")),
      "pose=a1|a2 q1_deg=1|7 q2_deg=-2|8 q3_deg=3.5|9 q4_deg=4|10 q5_deg=5|11 q6_deg=6|12");
  EXPECT_EQ(in_short(imported_text("&ACCESS RVP\nDEFDAT CAL PUBLIC\n"
                                   "DECL E6AXIS XP1={A1 -5.0,A2 -90,A3 9,A4 0,A5 1,A6 2,E1 7}\n"
                                   "DECL FDAT FP1={TOOL_NO 1,BASE_NO 0}\nENDDAT\n")),
            "pose=XP1 q1_deg=-5.0 q2_deg=-90 q3_deg=9 q4_deg=0 q5_deg=1 q6_deg=2");
  EXPECT_EQ(in_short(imported_text("&ACCESS RVP\nDEF CAL( )\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 "
                                   "0}\nEND\n")),
            "pose=1 q1_deg=0 q2_deg=-90 q3_deg=90 q4_deg=0 q5_deg=0 q6_deg=0");
  EXPECT_EQ(in_short(imported_text("def cal():\n  movej([0.1,-1.5, 1, 0, 0, 2], a=1.4, v=1.05)\n"
                                   "  movej([1,2,3,4,5,6])\nend\n")),
            "pose=1|2 q1_rad=0.1|1 q2_rad=-1.5|2 q3_rad=1|3 q4_rad=0|4 q5_rad=0|5 q6_rad=2|6");
  EXPECT_NE(remark_of(imported_text(kFanuc), "N-IMPORT-PROGRAM").find("Fanuc"), std::string::npos);
}

TEST(Programs, WithoutJointAnglesAreNamedAsWhatTheyAre) {
  const std::pair<const char*, const char*> table[] = {
      {"/PROG A\n/POS\nP[1]{\n GP1:\n UF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0',\n X = 1 mm, Y = 2 "
       "mm, Z = 3 mm,\n W = 0 deg, P = 0 deg, R = 0 deg\n};\n/END\n",
       "Fanuc"},
      {"MODULE M\nCONST robtarget p1:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n",
       "RAPID"},
      {"DEFDAT X\nDECL E6POS XP1={X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T 35}\nENDDAT\n", "KRL"},
      {"/JOB\n//NAME CAL\n//POS\n///NPOS 2,0,0,0,0,0\n///PULSE\nC00000=1,2,3,4,5,6\n", "INFORM"},
      {".PROGRAM cal()\nJMOVE #p1\n.END\n", "Kawasaki"},
      {"def p():\n movel(p[1,2,3,0,0,0])\nend\n", "Universal"},
  };
  for (const auto& [text, kind] : table) {
    const Problem refused = refusal_of(text);
    EXPECT_EQ(refused.code, "E-IMPORT-PROGRAM") << text;
    EXPECT_NE(refused.message.find(kind), std::string::npos) << refused.message;
  }
}

TEST(KeyValues, TheNamesBecomeColumns) {
  const char* texts[] = {
      "Cnt=1 X_mm=   729.060 Y_mm= -1748.770 Z_mm=1\nCnt=2 X_mm= 2 Y_mm= 3 Z_mm=4\n",
      "Tracker of today\nX_mm: 729.060, Y_mm: -1748.770, Z_mm: 1\nX_mm: 2, Y_mm: 3, Z_mm: 4\n"
      "X_mm: 2, Y_mm: 3, Z_mm: 4\nX_mm: 2, Y_mm: 3, Z_mm: 4\nX_mm: 2, Y_mm: 3, Z_mm: 4\n",
      "{\"x_mm\": 729.060, \"y_mm\": -1748.770, \"z_mm\": 1}\n"
      "{\"x_mm\": 2, \"y_mm\": 3, \"z_mm\": 4}\n",
      "X [mm] = 729.060; Y [mm] = -1748.770; Z [mm] = 1\nX [mm] = 2; Y [mm] = 3; Z [mm] = 4\n",
      "X=729.060 mm Y=-1748.770 mm Z=1 mm\nX=2 mm Y=3 mm Z=4 mm\n",
  };
  for (const char* text : texts) {
    const Imported data = imported_text(text);
    EXPECT_EQ(in_short(data).substr(0, 14), "x_mm=729.060|2") << text << in_short(data);
    EXPECT_EQ(data.find("y")->text[0], "-1748.770") << text;
    EXPECT_NE(remark_of(data, "N-IMPORT-PAIRS"), "") << text;
  }
  EXPECT_EQ(refusal_of("x_mm=1 y_mm=2 z_mm=3\nx_mm=1 y_mm=2 z_mm=3\nx_mm=1 y_mm=2 z_mm=3\n"
                       "x_mm=1 y_mm=2 z_mm=3\nx_mm=1 z_mm=2 y_mm=3\n")
                .code,
            "E-IMPORT-RAGGED");
}

TEST(KeyValues, AMissingNumberIsShownInItsPlace) {
  const Problem refused = refusal_of("x_mm=1 y_mm=2 z_mm=3\nx_mm=1 y_mm= z_mm=3\n");
  EXPECT_EQ(refused.code, "E-IMPORT-NUMBER");
  EXPECT_EQ(refused.place->column, 14);
}

std::string states(bool header) {
  std::string out = header ? "%time,field.header.seq,field.header.stamp,field.header.frame_id" : "";
  const char* names[] = {"elbow_joint",   "shoulder_lift_joint", "shoulder_pan_joint",
                         "wrist_1_joint", "wrist_2_joint",       "wrist_3_joint"};
  for (const char* kind : {"name", "position", "velocity"})
    for (int j = 0; header && j < 6; ++j) out += ",field." + std::string(kind) + std::to_string(j);
  out += header ? "\n" : "";
  for (int i = 0; i < 3; ++i) {
    out += header ? "171000000" + std::to_string(i) + "000000000,1,2,"
                  : "171000000" + std::to_string(i) + ",500000000,";
    for (const char* name : names) out += std::string(",") + name;
    for (int j = 0; j < 6; ++j) out += "," + std::to_string(j) + "." + std::to_string(i);
    out += ",0.0,0.0,0.0,0.0,0.0,0.0\n";
  }
  return out;
}

TEST(JointStates, ThePositionsBelongToTheNamesBesideThem) {
  for (const bool header : {true, false}) {
    const Imported data = imported_text(states(header));
    ASSERT_NE(data.find("q1"), nullptr) << in_short(data);
    EXPECT_EQ(data.find("q1")->heading(), "q1_rad");
    EXPECT_EQ(data.find("q1")->text[1], "2.1");  // shoulder_pan_joint
    EXPECT_EQ(data.find("q3")->text[2], "0.2");  // elbow_joint
    EXPECT_EQ(data.find("q6")->text[0], "5.0");
    EXPECT_EQ(data.find("t")->text[2], "2");
    EXPECT_NE(remark_of(data, "N-IMPORT-STATES"), "");
  }
}

TEST(JointNames, TheNamesOfTheCellAreJoints) {
  ImportWishes wishes;
  wishes.joints = {"base", "lift", "tool"};
  EXPECT_EQ(in_short(imported_text("lift [deg];Base [deg];tool/deg;x_mm\n1;2;3;4\n", wishes)),
            "q2_deg=1 q1_deg=2 q3_deg=3 x_mm=4");
  EXPECT_EQ(in_short(imported_text("lift [deg];x_mm\n1;4\n", wishes)), "x_mm=4");
  EXPECT_EQ(in_short(imported_text("panda_joint1_rad,panda_joint2_rad,panda_joint3_rad,"
                                   "panda_joint4_rad\n1,2,3,4\n")),
            "q1_rad=1 q2_rad=2 q3_rad=3 q4_rad=4");
  EXPECT_EQ(refusal_of("lift;Base;tool;x_mm\n1;2;3;4\n", wishes).code, "E-IMPORT-UNIT");
}

TEST(Shapes, ATransposedTableIsNamed) {
  const char* below = "J1_deg,1,2\nJ2_deg,3,4\nJ3_deg,5,6\nx_mm,7,8\ny_mm,9,10\n";
  EXPECT_EQ(refusal_of(std::string("pose,P1,P2\n") + below).code, "E-IMPORT-TRANSPOSED");
  EXPECT_EQ(refusal_of(std::string(",1st,2nd\n") + below).code, "E-IMPORT-TRANSPOSED");
}

TEST(Shapes, AMatrixIsAPositionAndAnOrientation) {
  const Imported data = imported_text(
      "q1_deg,T00,T01,T02,T03 [mm],T10,T11,T12,T13 [mm],T20,T21,T22,T23 [mm],T30,T31,T32,T33\n"
      "1,1,0,0,10,0,1,0,20,0,0,1,30,0,0,0,1\n2,0,-1,0,11,1,0,0,21,0,0,1,31,0,0,0,1\n");
  EXPECT_EQ(in_short(data),
            "q1_deg=1|2 x_mm=10|11 y_mm=20|21 z_mm=30|31 qw=1|0.707106781 qx=0|0 qy=0|0 "
            "qz=0|0.707106781");
  EXPECT_TRUE(data.left_out.empty());
  EXPECT_EQ(in_short(imported_text("q1_deg,x_mm,m11,m12,m13,m14,m21,m22,m23,m24,m31,m32,m33,m34\n"
                                   "1,5,1,0,0,10,0,1,0,20,0,0,1,30\n")),
            "q1_deg=1 x_mm=5");
  EXPECT_EQ(in_short(imported_text("q1_deg,m11,m12,m13,m14,m21,m22,m23,m24,m31,m32,m33,m34\n"
                                   "1,2,0,0,10,0,1,0,20,0,0,1,30\n")),
            "q1_deg=1");
}

std::string missing(const std::string& text) {
  const auto problem = missing_for_calibration(imported_text(text), 0);
  return problem ? problem->message + " / " + problem->help : "";
}

TEST(Shapes, PolarCoordinatesAndSeveralReflectorsAreNamed) {
  for (const char* header : {"Az [deg],El [deg],Dist [mm]", "Hz,V,Distance", "azimuth,zenith,range",
                             "theta [rad],phi [rad],r [m]"}) {
    const std::string said = missing(std::string("q1_deg,") + header + "\n1,2,3,4\n5,6,7,8\n");
    EXPECT_NE(said.find("polar coordinates"), std::string::npos) << header << ": " << said;
    EXPECT_NE(said.find("cos"), std::string::npos);
  }
  for (const char* header :
       {"x1_mm,y1_mm,z1_mm,x2_mm,y2_mm,z2_mm", "X1 [mm],Y1 [mm],Z1 [mm],X2 [mm],Y2 [mm],Z2 [mm]"}) {
    const std::string said = missing(std::string("q1_deg,") + header + "\n1,2,3,4,5,6,7\n");
    EXPECT_NE(said.find("2 points stand in every row"), std::string::npos) << said;
    EXPECT_NE(said.find("=x_mm"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace plumb::offline
