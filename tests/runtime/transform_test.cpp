// SPDX-License-Identifier: Apache-2.0
// Against Eigen's rotations in long double.
#include "plumb/runtime/transform.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/random_numbers.hpp"

namespace plumb {
namespace {

using Long3 = Eigen::Matrix<long double, 3, 1>;
using LongMatrix = Eigen::Matrix<long double, 3, 3>;

/// Angles that matter: none, tiny, ordinary, close to a half turn, beyond it.
const double kAngles[] = {0.0, 1e-300, 1e-12, 1e-8,        1e-5,        9.99e-3, 1.001e-2,
                          0.3, 1.0,    2.0,   M_PI - 1e-3, M_PI - 1e-9, M_PI,    4.0};

format::Twist random_twist(tests::Random& random, double angle) {
  Vector3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  axis *= angle / std::sqrt(dot(axis, axis));
  return {{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)},
          {axis(0), axis(1), axis(2)}};
}

LongMatrix exact_rotation(const Long3& e) {
  const long double angle = e.norm();
  if (angle == 0.0L) return LongMatrix::Identity();
  return Eigen::AngleAxis<long double>(angle, e / angle).toRotationMatrix();
}

/// Integral of exp(s [e]x) over s in 0 .. 1, by Gauss-Legendre on 200 pieces.
LongMatrix exact_v(const Long3& e) {
  LongMatrix sum = LongMatrix::Zero();
  const long double g = std::sqrt(0.6L);
  constexpr int kPieces = 200;
  for (int i = 0; i < kPieces; ++i)
    for (int k = -1; k <= 1; ++k)
      sum += exact_rotation(e * ((i + 0.5L + 0.5L * g * k) / kPieces)) * (k == 0 ? 8.0L : 5.0L) /
             18.0L;
  return sum / kPieces;
}

TEST(Exp, IsTheExponentialOfTheTwistAtEveryAngle) {
  tests::Random random(1);
  for (double angle : kAngles)
    for (int i = 0; i < 20; ++i) {
      const format::Twist xi = random_twist(random, angle);
      const Long3 d(xi.d[0], xi.d[1], xi.d[2]), e(xi.e[0], xi.e[1], xi.e[2]);
      const Transformd X = exp(xi);
      EXPECT_LT((X.R.cast<long double>() - exact_rotation(e)).cwiseAbs().maxCoeff(), 8e-16L)
          << angle;
      EXPECT_LT((X.p.cast<long double>() - exact_v(e) * d).cwiseAbs().maxCoeff(), 3e-15L) << angle;
    }
}

TEST(RotationVector, UndoesExpUpToAHalfTurn) {
  tests::Random random(2);
  for (double angle : kAngles) {
    if (angle > M_PI) continue;
    for (int i = 0; i < 50; ++i) {
      const format::Twist xi = random_twist(random, angle);
      const Vector3 e(xi.e[0], xi.e[1], xi.e[2]);
      const Vector3 back = rotation_vector(exp(xi).R);
      const double either = std::min((back - e).norm(), angle > 3.0 ? (back + e).norm() : 1.0);
      EXPECT_LT(either, 1e-14 + 1e-15 * angle) << angle;
    }
  }
}

TEST(Pose, RoundTripsThroughAQuaternionWithPositiveRealPart) {
  tests::Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const Transformd X = exp(random_twist(random, random.uniform(0, 2 * M_PI)));
    const format::Pose pose = to_pose(X);
    EXPECT_GE(pose.q[0], 0.0);
    double norm2 = 0.0;
    for (double q : pose.q) norm2 += q * q;
    EXPECT_NEAR(norm2, 1.0, 1e-15);
    const Transformd back = from_pose(pose);
    ASSERT_LT((back.R - X.R).cwiseAbs().maxCoeff(), 4e-15);
    ASSERT_EQ(back.p, X.p);
  }
}

TEST(Pose, AgreesWithEigenAtAllHalfTurns) {
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1),
                              Vector3(0.6, 0.8, 0), Vector3(0, -0.6, 0.8), Vector3(-0.6, 0, 0.8)}) {
    Transformd X;
    X.R = Eigen::AngleAxisd(M_PI, axis).toRotationMatrix();
    EXPECT_LT((from_pose(to_pose(X)).R - X.R).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_NEAR(rotation_vector(X.R).norm(), M_PI, 1e-14);
  }
}

TEST(Transform, IsAGroup) {
  tests::Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const Transformd A = exp(random_twist(random, 2.0)), B = exp(random_twist(random, 1.0)),
                     C = exp(random_twist(random, 3.0));
    const Transformd left = (A * B) * C, right = A * (B * C), one = A * A.inverse();
    EXPECT_LT((left.R - right.R).cwiseAbs().maxCoeff(), 2e-15);
    EXPECT_LT((left.p - right.p).cwiseAbs().maxCoeff(), 2e-14);
    EXPECT_LT((one.R - Matrix3::Identity()).cwiseAbs().maxCoeff(), 2e-15);
    EXPECT_LT(one.p.cwiseAbs().maxCoeff(), 5e-15);
  }
}

TEST(ElementaryMotions, TurnAboutTheirAxisByTheRightHand) {
  EXPECT_LT((rot_x(M_PI_2) * Vector3(0, 1, 0) - Vector3(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((rot_y(M_PI_2) * Vector3(0, 0, 1) - Vector3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((rot_z(M_PI_2) * Vector3(1, 0, 0) - Vector3(0, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(translation(1, 2, 3) * Vector3(1, 1, 1), Vector3(2, 3, 4));
}

}  // namespace
}  // namespace plumb
