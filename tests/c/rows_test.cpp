// SPDX-License-Identifier: Apache-2.0
// Lists of poses: what the cycle comes to, one answer a row, and clear errors.
#include <cstring>
#include <limits>

#include "tests/c/support.hpp"

namespace plumb::tests {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kRows = 5;

/// Rows whose joints differ a little, with payload and temperature.
struct Rows {
  plumb_rows in{};
  std::vector<double> q, payload, com, temperature;
  std::vector<plumb_pose> target, pose{kRows};
  std::vector<std::int32_t> status = std::vector<std::int32_t>(kRows, 77);

  Rows() : payload(kRows, 8.0), com(3 * kRows, 0.0), temperature(kRows, 31.0) {
    const Chain nominal(one_arm().nominal);
    for (int row = 0; row < kRows; ++row) {
      for (int i = 0; i < 6; ++i) q.push_back(home()[i] + 0.01 * row);
      target.push_back(pose_of(nominal.forward(std::span(q).last(6))));
    }
    in.size = sizeof in;
    in.seed = PLUMB_MEASURED;
    in.count = kRows;
    in.q = q.data();
    in.payload_kg = payload.data();
    in.payload_com_m = com.data();
    in.temperature_degC = temperature.data();
  }

  plumb_result predict(const plumb_robot* robot) {
    return plumb_predict_rows(robot, &in, pose.data(), status.data());
  }
  plumb_result correct(const plumb_robot* robot, double* joints = nullptr) {
    return plumb_correct_rows(robot, &in, target.data(), pose.data(), joints, status.data());
  }
};

double distance(const plumb_pose& a, const plumb_pose& b) {
  return std::hypot(a.p_m[0] - b.p_m[0], a.p_m[1] - b.p_m[1], a.p_m[2] - b.p_m[2]);
}

bool same(const plumb_pose& a, const plumb_pose& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(Rows, AreCorrectedToWhatTheCycleSettlesAt) {
  const Robot robot;
  Rows rows;
  std::vector<double> q(6 * kRows);
  ASSERT_EQ(rows.correct(robot.get(), q.data()), PLUMB_OK);
  for (std::size_t row = 0; row < kRows; ++row) {
    const Robot another;
    plumb_input in = sound_input();
    in.X_BD = rows.target[row];
    std::copy_n(&rows.q[6 * row], 6, in.q_measured);
    plumb_output out = blank_output();
    for (int k = 0; k < 300; ++k) {
      in.now_ns += kTick_ns;
      ASSERT_EQ(plumb_correct(another.get(), &in, &out), PLUMB_OK);
      for (std::size_t i = 0; i < 6 && k == 0; ++i) EXPECT_EQ(q[6 * row + i], out.q[i]) << row;
    }
    EXPECT_EQ(rows.status[row], out.status) << row;
    EXPECT_LT(distance(rows.pose[row], out.X_BC), 1e-12) << row;
    EXPECT_GT(distance(rows.pose[row], rows.target[row]), 1e-4) << row;
  }
}

TEST(Rows, ArePredictedAsInACycleOfTheSameContext) {
  const Robot robot;
  plumb_input in = sound_input();
  plumb_output out = blank_output();
  ASSERT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_OK);
  Rows rows;
  ASSERT_EQ(rows.predict(robot.get()), PLUMB_OK);
  for (std::size_t row = 0; row < kRows; ++row) {
    plumb_joints at{sizeof at, 0, {}};
    std::copy_n(&rows.q[6 * row], 6, at.q);
    plumb_prediction there{};
    there.size = sizeof there;
    ASSERT_EQ(plumb_predict(robot.get(), &at, &there), PLUMB_OK);
    EXPECT_TRUE(same(rows.pose[row], there.X_BT)) << row;
  }
}

TEST(Rows, AnswerToWhatIsKnownOfEach) {
  const Robot robot;
  Rows rows, other;
  rows.predict(robot.get());
  EXPECT_EQ(rows.status[2], PLUMB_STATUS_CONTEXT_FALLBACK);  // nothing tells the direction
  const std::vector<double> direction(6 * kRows, 1.0), travel(6 * kRows, 0.5);
  other.in.direction = direction.data();
  other.in.travel = travel.data();
  other.payload[2] = 20.0;
  ASSERT_EQ(other.predict(robot.get()), PLUMB_OK);
  EXPECT_EQ(other.status[2], PLUMB_STATUS_OK);
  EXPECT_GT(distance(rows.pose[2], other.pose[2]), 1e-6);
}

TEST(Rows, OfANumberThatIsNoneAreRefusedAloneAndStayFinite) {
  const Robot robot;
  Rows clean, rows;
  ASSERT_EQ(clean.correct(robot.get()), PLUMB_OK);
  rows.target[1].p_m[2] = kNaN;
  rows.q[3 * 6] = HUGE_VAL;
  rows.payload[4] = -HUGE_VAL;  // unknown
  std::vector<double> q(6 * kRows);
  ASSERT_EQ(rows.correct(robot.get(), q.data()), PLUMB_OK);
  EXPECT_EQ(rows.status[1], PLUMB_STATUS_NOT_FINITE);
  EXPECT_EQ(rows.pose[1].R[0], 1.0);
  EXPECT_EQ(rows.status[3], PLUMB_STATUS_NOT_FINITE);
  EXPECT_TRUE(same(rows.pose[3], rows.target[3]));
  EXPECT_EQ(rows.status[4], PLUMB_STATUS_CONTEXT_FALLBACK);
  for (const std::size_t row : {0, 2}) EXPECT_TRUE(same(rows.pose[row], clean.pose[row]));
  ASSERT_EQ(rows.predict(robot.get()), PLUMB_OK);
  EXPECT_EQ(rows.status[3], PLUMB_STATUS_NOT_FINITE);
  EXPECT_EQ(rows.pose[3].p_m[0], 0.0);
}

TEST(Rows, MayBeCorrectedInPlace) {
  const Robot robot;
  Rows rows;
  ASSERT_EQ(rows.correct(robot.get()), PLUMB_OK);
  plumb_pose* const at = rows.target.data();
  ASSERT_EQ(plumb_correct_rows(robot.get(), &rows.in, at, at, nullptr, rows.status.data()),
            PLUMB_OK);
  for (std::size_t row = 0; row < kRows; ++row) EXPECT_TRUE(same(rows.target[row], rows.pose[row]));
}

TEST(Rows, OfAWrongCallAreNotTouched) {
  const Robot robot;
  Rows rows;
  const auto odd = [](auto* pointer) {
    using T = decltype(pointer);
    return reinterpret_cast<T>(reinterpret_cast<std::uintptr_t>(pointer) + 1);
  };
  plumb_pose* const X = rows.pose.data();
  std::int32_t* const status = rows.status.data();
  EXPECT_EQ(plumb_predict_rows(nullptr, &rows.in, X, status), PLUMB_NULL);
  EXPECT_EQ(plumb_predict_rows(robot.get(), nullptr, X, status), PLUMB_NULL);
  EXPECT_EQ(plumb_predict_rows(robot.get(), &rows.in, nullptr, status), PLUMB_NULL);
  EXPECT_EQ(plumb_predict_rows(robot.get(), &rows.in, X, nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_predict_rows(robot.get(), &rows.in, odd(X), status), PLUMB_MISALIGNED);
  EXPECT_EQ(plumb_correct_rows(robot.get(), &rows.in, nullptr, X, nullptr, status), PLUMB_NULL);
  Rows wrong;
  wrong.in.q = nullptr;
  EXPECT_EQ(wrong.predict(robot.get()), PLUMB_NULL);
  wrong = Rows();
  wrong.in.q = rows.q.data();
  wrong.in.payload_kg = odd(rows.payload.data());
  EXPECT_EQ(wrong.predict(robot.get()), PLUMB_MISALIGNED);
  rows.in.seed = 0;
  EXPECT_EQ(rows.correct(robot.get()), PLUMB_BAD_NUMBER);
  rows.in.size = 8;
  EXPECT_EQ(rows.predict(robot.get()), PLUMB_BAD_SIZE);
  for (const std::int32_t one : rows.status) EXPECT_EQ(one, 77);
}

TEST(Rows, MayBeNone) {
  const Robot robot;
  plumb_rows none{};
  none.size = sizeof none;
  none.seed = PLUMB_COMMANDED;
  EXPECT_EQ(plumb_predict_rows(robot.get(), &none, nullptr, nullptr), PLUMB_OK);
  EXPECT_EQ(plumb_correct_rows(robot.get(), &none, nullptr, nullptr, nullptr, nullptr), PLUMB_OK);
}

}  // namespace
}  // namespace plumb::tests
