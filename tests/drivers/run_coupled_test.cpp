// SPDX-License-Identifier: Apache-2.0
// plumb-rt run of an arm whose controller shows J3 = q3 + q2, against kinematics of the test's own.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <optional>
#include <sstream>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/raw_controller.hpp"
#include "tests/drivers/rt_program.hpp"

namespace plumb::tests {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Pose = Eigen::Isometry3d;

format::Model coupled_arm() {
  format::Model out = Deployed::arm();
  for (format::Chain* const chain : {&out.nominal, &out.calibrated})
    chain->coupling = {{2, 1, -1.0}};
  for (format::Tree& tree : out.trees) tree = {};
  return out;
}

/// What [robot] coupling = [{ joint = "J3", of = "J2", share = 1 }] says.
Vector6 angles_of(const Vector6& values) {
  Vector6 out = values;
  out(2) = values(2) - values(1);
  return out;
}

/// Denavit and Hartenberg: Rz(theta + q) Tz(d) Tx(a) Rx(alpha), joint by joint.
Pose flange(const format::Chain& arm, const Vector6& q) {
  Pose out = Pose::Identity();
  for (int i = 0; i < 6; ++i) {
    const format::JointRow& row = arm.joints[static_cast<std::size_t>(i)];
    out = out * Eigen::AngleAxisd(row.theta + q(i), Eigen::Vector3d::UnitZ()) *
          Eigen::Translation3d(row.a, 0.0, row.d) *
          Eigen::AngleAxisd(row.alpha, Eigen::Vector3d::UnitX());
  }
  return out;
}

/// By how much `to` is beyond `from`: metres and radians, in the base.
Vector6 between(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  Vector6 out;
  out << to.translation() - from.translation(), turn.angle() * turn.axis();
  return out;
}

/// The angles at which an arm reaches a pose near those: what a controller does with a target.
Vector6 reached(const format::Chain& arm, const Pose& target, Vector6 q) {
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 8; ++i) {
    Eigen::Matrix<double, 6, 6> J;
    for (int k = 0; k < 6; ++k)
      J.col(k) = between(flange(arm, q), flange(arm, q + kStep * Vector6::Unit(k))) / kStep;
    q += J.fullPivLu().solve(between(flange(arm, q), target));
  }
  return q;
}

Pose pose_of(const std::vector<double>& row, std::size_t first) {
  Pose out = Pose::Identity();
  out.translation() << 1e-3 * row[first], 1e-3 * row[first + 1], 1e-3 * row[first + 2];
  out.linear() = Eigen::Quaterniond(row[first + 3], row[first + 4], row[first + 5], row[first + 6])
                     .normalized()
                     .toRotationMatrix();
  return out;
}

std::vector<double> last_row(const std::string& text) {
  const std::size_t begin = text.rfind('\n', text.size() - 2) + 1;
  std::istringstream in(text.substr(begin));
  std::vector<double> out;
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(std::stod(cell));
  return out;
}

const Vector6 kValues = (Vector6() << 0.3, -1.0, 0.4, -0.4, 1.1, 0.2).finished();

/// Many times the pose that the controller's nominal arm has at these values.
std::string rows_of(const format::Chain& nominal) {
  const Pose target = flange(nominal, angles_of(kValues));
  const Eigen::Quaterniond turn(target.linear());
  std::ostringstream row;
  row.precision(15);
  for (const double x : target.translation()) row << 1e3 * x << ',';
  row << turn.w() << ',' << turn.x() << ',' << turn.y() << ',' << turn.z();
  for (const double value : kValues) row << ',' << value;
  std::string out;
  for (int i = 0; i < 800; ++i) out += row.str() + "\n";
  return out;
}

/// The pose that plumb-rt answers with this model when the correction is complete, if it answers.
std::optional<Pose> answer_of(const format::Model& model) {
  const Deployed folder;
  folder.write_model("robot.plumb", model);
  const std::string before = folder.text("targets.csv");
  folder.write("targets.csv", before.substr(0, before.find('\n') + 1) + rows_of(model.nominal));
  const RtRan ran = plumb_rt({"run", folder.folder.string()}, folder.folder);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  std::string answers = folder.text("corrected.csv");
  if (std::count(answers.begin(), answers.end(), '\n') < 2) return std::nullopt;
  // From the middle: at the end of the file the correction is taken away.
  answers.resize(answers.find('\n', answers.size() / 2) + 1);
  return pose_of(last_row(answers), 2);
}

/// How far the real arm stands from the target, if its controller is sent this pose [m].
double missed(const Pose& answer) {
  const format::Model arm = coupled_arm();
  const Vector6 angles = angles_of(kValues);
  const Vector6 sent = reached(arm.nominal, answer, angles);
  return (flange(arm.calibrated, sent).translation() - flange(arm.nominal, angles).translation())
      .norm();
}

TEST(RunCoupled, TheRealArmStandsWhereItShouldIfItIsSentTheAnswer) {
  const format::Model arm = coupled_arm();
  EXPECT_GT(missed(flange(arm.nominal, angles_of(kValues))), 1e-3) << "without an answer";
  const auto answer = answer_of(arm);
  ASSERT_TRUE(answer);
  EXPECT_LT(missed(*answer), 2e-6);
  format::Model planted = arm;
  for (format::Chain* const chain : {&planted.nominal, &planted.calibrated})
    chain->coupling.clear();
  EXPECT_FALSE(answer_of(planted))
      << "planted: to a model without coupling the joints are elsewhere";
}

TEST(RunCoupled, APoseIsComparedAtTheAnglesAndNotAtTheValues) {
  const int port = 26'000 + static_cast<int>(::getpid() % 6'000);
  const Deployed folder(Deployed::modbus_server(port) + "[limits]\nmode = \"full\"\n");
  const format::Model arm = coupled_arm();
  folder.write_model("robot.plumb", arm);
  format::Chain planted = arm.nominal;
  planted.coupling.clear();
  const RtProgram run({"run", folder.folder.string()}, folder.folder);
  const auto robot = drivers::fingerprint(arm.serial);
  {
    RawController controller(static_cast<std::uint16_t>(port), arm.nominal, robot);
    ASSERT_TRUE(becomes([&] { return controller.sees(drivers::SessionState::kShadow); }));
    controller.press();
    EXPECT_TRUE(becomes([&] { return controller.sees(drivers::SessionState::kActive); }));
  }
  RawController controller(static_cast<std::uint16_t>(port), planted, robot);
  EXPECT_TRUE(becomes([&] { return controller.sees(drivers::SessionState::kFault); }))
      << "planted: an arm without coupling";
}

}  // namespace
}  // namespace plumb::tests
