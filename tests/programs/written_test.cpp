// SPDX-License-Identifier: Apache-2.0
#include "programs/written.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/random_numbers.hpp"

namespace plumb::offline::programs {
namespace {

constexpr double kDeg = 3.14159265358979323846 / 180.0;

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

TEST(Written, NotationsMeanWhatTheManualsOfTheControllersSay) {
  using V = Eigen::Vector3d;
  const auto X = V::UnitX(), Y = V::UnitY(), Z = V::UnitZ();
  const std::vector<double> wpr{1, 2, 3, 10, 20, 30}, abc{1, 2, 3, 30, 20, 10};
  const Eigen::Matrix3d R = about(Z, 30 * kDeg) * about(Y, 20 * kDeg) * about(X, 10 * kDeg);
  EXPECT_LT((pose_of(Notation::kXyz, wpr)->R - R).norm(), 1e-12);
  EXPECT_LT((pose_of(Notation::kZyx, abc)->R - R).norm(), 1e-12);
  EXPECT_NEAR(pose_of(Notation::kXyz, wpr)->p(2), 0.003, 1e-15);
  const Eigen::AngleAxisd turn(R);
  const V r = turn.axis() * turn.angle();
  EXPECT_LT(
      (pose_of(Notation::kVector, std::vector<double>{1, 2, 3, r(0), r(1), r(2)})->R - R).norm(),
      1e-9);
  EXPECT_NEAR(pose_of(Notation::kVector, std::vector<double>{1, 2, 3, 0, 0, 0})->p(2), 3.0, 1e-15);
  const Eigen::Quaterniond q(R);
  EXPECT_LT(
      (pose_of(Notation::kQuaternion, std::vector<double>{1, 2, 3, q.w(), q.x(), q.y(), q.z()})->R -
       R)
          .norm(),
      1e-12);
  EXPECT_FALSE(pose_of(Notation::kQuaternion, std::vector<double>{1, 2, 3, 0.9, 0, 0, 0}));
  EXPECT_FALSE(pose_of(Notation::kXyz, std::vector<double>{1, 2, 3}));
}

TEST(Written, ASmallTurnChangesTheNumbersOfAnOrientationLittleWhateverTheyAre) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(-200.0, 200.0), small(-1e-4, 1e-4);
  const long count = tests::scaled(20000);
  for (long k = 0; k < count; ++k) {
    for (const Notation notation : {Notation::kXyz, Notation::kZyx, Notation::kVector}) {
      const bool vector = notation == Notation::kVector;
      std::vector<double> like{1, 2, 3, angle(random), 0.4 * angle(random), angle(random)};
      if (vector)
        for (std::size_t i = 3; i < 6; ++i) like[i] *= 0.01;
      Transformd X = *pose_of(notation, like);
      X.R = product(X.R, rotation_of({small(random), small(random), small(random)}));
      const auto now = numbers_like(X, notation, like);
      ASSERT_LT((pose_of(notation, now)->R - X.R).norm(), 1e-9);
      if (vector) {
        const double norm = std::hypot(like[3], like[4], like[5]);
        if (std::abs(std::remainder(norm, 6.283185307)) < 0.3) continue;  // any direction
      }
      const bool locked = !vector && std::abs(std::cos(like[4] * kDeg)) < 0.05;
      for (std::size_t i = 3; i < 6 && !locked; ++i)
        ASSERT_NEAR(now[i], like[i], vector ? 0.01 : 0.5)
            << like[3] << " " << like[4] << " " << like[5];
    }
  }
  std::printf("%ld orientations, seed 7\n", 3 * count);
}

TEST(Written, TheSignOfAQuaternionStays) {
  const std::vector<double> like{0, 0, 0, -0.5, -0.5, 0.5, 0.5};
  const auto now = numbers_like(*pose_of(Notation::kQuaternion, like), Notation::kQuaternion, like);
  for (std::size_t i = 3; i < 7; ++i) EXPECT_NEAR(now[i], like[i], 1e-12);
}

TEST(Written, NumbersAreWrittenInTheMannerOfTheirNeighbours) {
  EXPECT_EQ(written_like(0.126, 3, ".125"), ".126");
  EXPECT_EQ(written_like(-0.126, 3, "-.125"), "-.126");
  EXPECT_EQ(written_like(-0.126, 3, "0.125"), "-0.126");
  EXPECT_EQ(written_like(1.2, 3, ".999"), "1.200");
  EXPECT_EQ(written_like(-0.0001, 3, "0.1"), "0.000");
  EXPECT_EQ(written_like(10.04, 1, "9.9"), "10.0");
  EXPECT_EQ(written_like(600.4, 0, "600"), "600");
}

TEST(Written, DecimalsCountWithThePowerOfTen) {
  EXPECT_EQ(decimals_of("600"), 0);
  EXPECT_EQ(decimals_of("600.250"), 3);
  EXPECT_EQ(decimals_of("-1.5E-3"), 4);
  EXPECT_EQ(decimals_of("1.25e+1"), 1);
  EXPECT_EQ(decimals_of("9E9"), 0);
}

}  // namespace
}  // namespace plumb::offline::programs
