// SPDX-License-Identifier: Apache-2.0
#include "cell/targets.hpp"

#include <cmath>

#include "support.hpp"

namespace plumb::offline {
namespace {

const std::vector<bool> kArm{true, false};

Targets read(const std::string& text) {
  const Folder folder;
  return read_targets(folder.put("t.csv", text), kArm);
}

TEST(Targets, HavePositionOrientationAndSeed) {
  const auto t = read("x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_mm\n1,2,3,0,1,0,0,180,4\n");
  EXPECT_EQ(t.p_B(0, 2), 0.003);
  EXPECT_EQ(t.quat_B(0, 1), 1.0);
  EXPECT_DOUBLE_EQ(t.seed(0, 0), M_PI);
  EXPECT_EQ(t.seed(0, 1), 0.004);
  EXPECT_FALSE(t.commanded);
}

TEST(Targets, NeedNeitherOrientationNorSeed) {
  const auto t = read("x_mm,y_mm,z_mm\n1,2,3\n");
  EXPECT_EQ(t.quat_B.rows(), 0);
  EXPECT_EQ(t.seed.rows(), 0);
}

TEST(Targets, PreferTheCommandedJoints) {
  const auto t = read("x_mm,y_mm,z_mm,q1_rad,q2_m,qc1_rad,qc2_m\n1,2,3,4,5,6,7\n");
  EXPECT_TRUE(t.commanded);
  EXPECT_EQ(t.seed(0, 0), 6.0);
  EXPECT_EQ(t.seed(0, 1), 7.0);
}

TEST(Targets, SayAllThatIsWrongAtOnce) {
  const auto problems = problems_of([] { read("x_mm,z_mm,qw,qx,q1_deg\n1,2,1,0,3\n"); });
  EXPECT_EQ(summary(problems),
            (Summary{"E-CSV-POSITION 1:23", "E-CSV-ORIENTATION 1:11", "E-CSV-JOINT 1:23"}));
}

}  // namespace
}  // namespace plumb::offline
