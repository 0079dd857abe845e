// SPDX-License-Identifier: Apache-2.0
#include "twin/nominal_arm.hpp"

#include <gtest/gtest.h>

#include "simulate/random.hpp"
#include "simulate/simulate.hpp"
#include "twin/path.hpp"

namespace plumb::offline::twin {
namespace {

TEST(NominalArm, GoesThereAndBackOnItsBranch) {
  for (const char* name : {"clean", "compliance", "gear", "scara"}) {
    SCOPED_TRACE(name);
    const Cell cell = make_demo(name).cell;
    const NominalArm arm(cell.nominal);
    const Path path = generated_path(cell, 50, 0.6, 3);
    sim::Random random(1, "start");
    for (int k = 0; k < path.stations(); ++k) {
      const VectorXd wanted = path.q.row(k).transpose();
      VectorXd q = wanted;
      for (auto& x : q) x += random.uniform(-0.02, 0.02);
      ASSERT_TRUE(arm.inverse(arm.forward(wanted), q));
      EXPECT_LT((q - wanted).cwiseAbs().maxCoeff(), 1e-7);
    }
  }
}

TEST(NominalArm, SaysSoAndStaysWhereItCannotReach) {
  const Cell cell = make_demo("clean").cell;
  const NominalArm arm(cell.nominal);
  const VectorXd start = generated_path(cell, 2, 0.6, 3).q.row(0).transpose();
  VectorXd q = start;
  Isometry3d far = arm.forward(q);
  far.translation().x() += 5.0;
  EXPECT_FALSE(arm.inverse(far, q));
  EXPECT_EQ(q, start);
  far.translation().x() = NAN;
  EXPECT_FALSE(arm.inverse(far, q));
  EXPECT_EQ(q, start);
}

}  // namespace
}  // namespace plumb::offline::twin
