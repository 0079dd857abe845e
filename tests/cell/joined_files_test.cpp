// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell/measurement_reader.hpp"
#include "cell/measurements.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

constexpr double kDeg = M_PI / 180.0;

/// J2 = q2 + q1.
format::Chain coupled_arm() {
  format::Chain out;
  out.joints.resize(2);
  out.coupling = {{1, 0, -1.0}};
  return out;
}

TEST(CoupledJoints, AreValuesInFilesAndAnglesInMemory) {
  const Folder folder;
  const auto file =
      folder.put("m.csv", "q1_deg,q2_deg,x_mm,y_mm,z_mm\n10,25,1,2,3\n-20,30,4,5,6\n");
  const auto m = read_measurements({file}, coupled_arm(), Needs::kJointsAndPosition);
  EXPECT_NEAR(m.q(0, 1), 15 * M_PI / 180, 1e-12);
  EXPECT_NEAR(m.q(1, 1), 50 * M_PI / 180, 1e-12);
  EXPECT_NEAR(m.q(1, 0), -20 * M_PI / 180, 1e-12);
  const auto text = write_measurements(m, coupled_arm(), {}, {});
  const auto raw =
      read_measurements({folder.put("b.csv", text)}, {true, true}, Needs::kJointsAndPosition);
  EXPECT_NEAR(raw.q(0, 1), 25 * M_PI / 180, 1e-12);
}

TEST(Measurements, JoinFilesRowByRowWithTheirUnits) {
  const Folder folder;
  const auto a = folder.put("a.csv", "q1_deg,q2_mm,x_mm,z_mm,set\n90,5,1,3,fit\n-90,6,2,4,held\n");
  const auto b = folder.put("b.csv", "z_m,x_m,q2_m,q1_rad\n0.5,0.25,0.125,1\n");
  const auto m = read_measurements({a, b}, {true, false}, Needs::kJointsAndPosition);
  ASSERT_EQ(m.size(), 3);
  EXPECT_DOUBLE_EQ(m.q(0, 0), 90 * kDeg);
  EXPECT_EQ(m.q(0, 1), 0.005);
  EXPECT_EQ(m.q(2, 0), 1.0);
  EXPECT_EQ(m.q(2, 1), 0.125);
  EXPECT_EQ(m.p_M(1, 0), 0.002);
  EXPECT_EQ(m.p_M(2, 2), 0.5);
  EXPECT_EQ(m.has_axis, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(m.p_M(2, 1), 0.0);
  EXPECT_EQ(m.pose, (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_EQ(m.set, (std::vector<SetMark>{SetMark::kFit, SetMark::kHeld, SetMark::kUnmarked}));
  EXPECT_FALSE(m.has_orientation());
  EXPECT_EQ(m.sigma_m.rows(), 0);
  EXPECT_EQ(m.tables.size(), 2u);
}

TEST(Measurements, MustAgreeOnTheMeasuredAxes) {
  const Folder folder;
  const auto a = folder.put("a.csv", "q1_deg,x_mm,y_mm\n1,2,3\n");
  const auto b = folder.put("b.csv", "q1_deg,x_mm,z_mm\n1,2,3\n");
  const auto problems = problems_of([&] {
    read_measurements({a, b}, {true}, Needs::kJointsAndPosition);
  });
  EXPECT_EQ(summary(problems), (Summary{"E-CSV-MIXED 1:17", "E-CSV-MIXED 1:17"}));
}

TEST(Measurements, DropWhatNotEveryFileHasAndSaySo) {
  const Folder folder;
  const auto a = folder.put("a.csv", "q1_deg,x_mm,sx_um,nx_mm,qw,qx,qy,qz\n1,2,3,4,1,0,0,0\n");
  const auto b = folder.put("b.csv", "q1_deg,x_mm\n1,2\n");
  const auto m = read_measurements({a, b}, {true}, Needs::kJointsAndPosition);
  EXPECT_EQ(m.sigma_m.rows(), 0);
  EXPECT_EQ(m.nominal_B.rows(), 0);
  EXPECT_FALSE(m.has_orientation());
  EXPECT_TRUE(m.tables[0].remarks.empty());
  EXPECT_EQ(summary(m.tables[1].remarks),
            (Summary{"W-CSV-MIXED 1:12", "W-CSV-MIXED 1:12", "W-CSV-MIXED 1:12"}));
}

TEST(Measurements, NormaliseQuaternions) {
  const Folder folder;
  const auto a = folder.put("a.csv", "q1_deg,x_mm,qw,qx,qy,qz\n1,2,0.7072,0,0.7072,0\n");
  const auto m = read_measurements({a}, {true}, Needs::kJointsAndPosition);
  EXPECT_NEAR(m.quat_M(0, 0), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(m.quat_M.row(0).norm(), 1.0, 1e-15);
}

// R = Rz Ry Rx multiplied out by hand, in long double.
TEST(Measurements, TurnAboutFixedAxesXThenYThenZ) {
  const long double a = 0.3L, b = -1.1L, c = 2.4L;
  const long double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
  const long double cc = std::cos(c), sc = std::sin(c);
  const long double R[3][3] = {{cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa},
                               {sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa},
                               {-sb, cb * sa, cb * ca}};
  const Folder folder;
  const auto file =
      folder.put("a.csv", "# rot: xyz-fixed\nq1_deg,x_mm,rx_rad,ry_rad,rz_rad\n1,2,0.3,-1.1,2.4\n");
  const auto m = read_measurements({file}, {true}, Needs::kJointsAndPosition);
  const double w = m.quat_M(0, 0), x = m.quat_M(0, 1), y = m.quat_M(0, 2), z = m.quat_M(0, 3);
  const double Q[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(Q[i][k], static_cast<double>(R[i][k]), 1e-15);
}

TEST(Pick, TakesRowsInOrderAndKeepsTheirContext) {
  const Folder folder;
  const auto a =
      folder.put("a.csv", "pose,q1_deg,x_mm,temp_degC\nA,1,10,20\nB,2,20,21\nC,3,30,22\n");
  const auto b = folder.put("b.csv", "pose,q1_deg,x_mm,t_s\nD,4,40,5\nE,5,50,6\n");
  const auto all = read_measurements({a, b}, {true}, Needs::kJointsAndPosition);
  const auto some = pick(all, {2, 0, 4, 3});
  EXPECT_EQ(some.pose, (std::vector<std::string>{"C", "A", "E", "D"}));
  EXPECT_EQ(some.p_M(2, 0), 0.05);
  ASSERT_EQ(some.tables.size(), 2u);
  EXPECT_EQ(some.tables[0].find("temp")->values, (std::vector<double>{22, 20}));
  EXPECT_EQ(some.tables[0].raw_rows[1], "A,1,10,20");
  EXPECT_EQ(some.tables[0].lines, (std::vector<int>{4, 2}));
  EXPECT_EQ(some.tables[1].find("t")->values, (std::vector<double>{6, 5}));
  EXPECT_EQ(some.tables[1].sha256, all.tables[1].sha256);
  EXPECT_EQ(pick(all, {}).size(), 0);
}

TEST(Pick, AlwaysHasAsManyTableRowsAsPoses) {
  const Folder folder;
  const auto a = folder.put("a.csv", "q1_deg,x_mm\n1,10\n2,20\n");
  const auto b = folder.put("b.csv", "q1_deg,x_mm\n3,30\n4,40\n");
  const auto all = read_measurements({a, b}, {true}, Needs::kJointsAndPosition);
  const auto mixed = pick(all, {0, 2, 1, 3, 3});
  std::vector<double> x;
  for (const auto& table : mixed.tables)
    for (const double value : table.find("x")->values) x.push_back(value);
  ASSERT_EQ(x.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(x[static_cast<std::size_t>(i)], mixed.p_M(i, 0));
}

}  // namespace
}  // namespace plumb::offline
