// SPDX-License-Identifier: Apache-2.0
#include "tests/cases/socket_arm.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

namespace plumb::offline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::array<std::array<double, 4>, 6> kNominal{{{0.0, 0.400, 0.025, -M_PI_2},
                                                         {-M_PI_2, 0.0, 0.455, 0.0},
                                                         {0.0, 0.0, 0.035, -M_PI_2},
                                                         {0.0, 0.420, 0.0, M_PI_2},
                                                         {0.0, 0.0, 0.0, -M_PI_2},
                                                         {0.0, 0.080, 0.0, 0.0}}};
constexpr std::array<double, 6> kLow{-136, -80, -120, -144, -88, -144};
constexpr std::array<double, 6> kHigh{136, 80, 48, 144, 88, 144};  // [deg]
constexpr double kPlate_m = 0.080;
constexpr double kBuilt_m = 0.3e-3, kBuilt_rad = 0.5e-3;

Matrix3d about(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

SocketArm::SocketArm(const SocketPlan& plan) : plan_(plan), state_(plan.seed * 2654435761u + 1) {
  rows_ = kNominal;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i][0] += normal(kBuilt_rad);
    if (i != 1) rows_[i][1] += normal(kBuilt_m);  // the axes of J2 and J3 are parallel
    rows_[i][2] += normal(kBuilt_m);
    rows_[i][3] += normal(kBuilt_rad);
  }
  write_touches();
}

double SocketArm::uniform(double from, double to) {
  state_ ^= state_ << 13;  // xorshift [Marsaglia 2003]
  state_ ^= state_ >> 7;
  state_ ^= state_ << 17;
  return from + (to - from) * static_cast<double>(state_ >> 11) / 9007199254740992.0;
}

double SocketArm::normal(double sigma) {
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) sum += uniform(-0.5, 0.5);
  return sigma * sum;
}

Vector3d SocketArm::ball(const Joints& q, const Vector3d& beside_T) const {
  Joints at = q;
  // Two rounds: the joints yield to the weight of what is behind them, which hangs where they are.
  for (int round = 0; round < 2; ++round) {
    Matrix3d R = Matrix3d::Identity();
    Vector3d p = Vector3d::Zero();
    std::array<Vector3d, 6> origin, axis;
    Vector3d upper, fore;
    for (std::size_t i = 0; i < 6; ++i) {
      origin[i] = p;
      axis[i] = R.col(2);
      R = R * about(Vector3d::UnitZ(), at[i] + rows_[i][0]);
      p += R * Vector3d(rows_[i][2], 0.0, rows_[i][1]);
      R = R * about(Vector3d::UnitX(), rows_[i][3]);
      if (i == 1) upper = 0.5 * (origin[1] + p);
      if (i == 3) fore = 0.5 * (origin[2] + p);
    }
    const Vector3d tip = p + R * (ball_T_ + beside_T);
    if (round == 1 || plan_.yields_rad_per_Nm == 0.0) return tip;
    const auto torque = [&](std::size_t joint, const Vector3d& at_m, double kg) {
      return axis[joint].dot((at_m - origin[joint]).cross(Vector3d(0.0, 0.0, -9.81 * kg)));
    };
    at[1] += plan_.yields_rad_per_Nm *
             (torque(1, upper, 18.0) + torque(1, fore, 11.0) + torque(1, tip, 5.0));
    at[2] += 2.0 * plan_.yields_rad_per_Nm * (torque(2, fore, 11.0) + torque(2, tip, 5.0));
  }
  return {};
}

SocketArm::Joints SocketArm::random_joints() {
  Joints q;
  for (std::size_t i = 0; i < 6; ++i) q[i] = uniform(kLow[i], kHigh[i]) * M_PI / 180.0;
  return q;
}

double SocketArm::error_at_fresh_joints(
    const std::function<Eigen::Vector3d(const Joints&)>& predicted) {
  constexpr Eigen::Index kFresh = 200;
  Eigen::Matrix3Xd found(3, kFresh), truth(3, kFresh);
  for (Eigen::Index i = 0; i < kFresh; ++i) {
    const Joints q = random_joints();
    found.col(i) = predicted(q);
    truth.col(i) = ball(q);
  }
  found.colwise() -= found.rowwise().mean().eval();
  truth.colwise() -= truth.rowwise().mean().eval();
  const Eigen::JacobiSVD<Matrix3d> svd(truth * found.transpose(),
                                       Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  return (R * found - truth).colwise().norm().mean();
}

/// Newton's method from random joints, derivatives by differences.
bool SocketArm::touch(const Vector3d& point, Joints& q) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    q = random_joints();
    for (int step = 0; step < 40; ++step) {
      const Vector3d missed = ball(q) - point;
      if (missed.norm() < 1e-12) break;
      Eigen::Matrix<double, 3, 6> J;
      for (std::size_t k = 0; k < 6; ++k) {
        Joints there = q;
        there[k] += 1e-6;
        J.col(static_cast<Eigen::Index>(k)) = (ball(there) - ball(q)) / 1e-6;
      }
      const Matrix3d damped = J * J.transpose() + 1e-9 * Matrix3d::Identity();
      const Eigen::Matrix<double, 6, 1> change = -J.transpose() * damped.ldlt().solve(missed);
      for (std::size_t k = 0; k < 6; ++k)
        q[k] += std::clamp(change(static_cast<Eigen::Index>(k)), -0.5, 0.5);
    }
    bool inside = (ball(q) - point).norm() < 1e-9;
    for (std::size_t k = 0; k < 6; ++k)
      inside = inside && q[k] > kLow[k] * M_PI / 150.0 && q[k] < kHigh[k] * M_PI / 150.0;
    if (inside) return true;
  }
  return false;
}

void SocketArm::write_touches() {
  csv_ = "pose,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,position,point";
  csv_ += plan_.known_distance ? ",to_point,distance_mm\n" : "\n";
  int pose = 0;
  for (int placement = 0; placement < plan_.placements;) {
    const double turn = uniform(-2.4, 2.4), far = uniform(0.35, 0.75), high = uniform(0.0, 0.7);
    const Vector3d first(far * std::cos(turn), far * std::sin(turn), high);
    const Vector3d along = Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    std::string rows;
    int touched = 0;
    for (int socket = 0; socket < 2; ++socket)
      for (int k = 0; k < plan_.touches; ++k) {
        const bool moved = placement == 0 && socket == 0 && 2 * k >= plan_.touches;
        const Vector3d point = first + kPlate_m * socket * along +
                               Vector3d(0.0, moved ? plan_.moved_m : 0.0, 0.0) +
                               noise(plan_.play_m);
        Joints q;
        if (!touch(point, q)) continue;
        ++touched;
        rows += fmt::format("T{}", pose + touched);
        for (const double angle : q) rows += fmt::format(",{:.7f}", angle * 180.0 / M_PI);
        rows += fmt::format(",place {0},{0}/{1}", placement, socket);
        rows += plan_.known_distance ? fmt::format(",{}/{},80\n", placement, 1 - socket) : "\n";
      }
    if (touched < 2 * plan_.touches) continue;  // out of reach: another place
    csv_ += rows;
    pose += touched;
    sockets_.push_back(first);
    sockets_.push_back(first + kPlate_m * along);
    ++placement;
  }
}

std::string SocketArm::cell_toml() const {
  std::string joints;
  for (std::size_t i = 0; i < kNominal.size(); ++i)
    joints +=
        fmt::format("  {{ name = \"J{}\", theta = {:g}, d = {:g}, a = {:g}, alpha = {:g} }},\n",
                    i + 1, kNominal[i][0] * 180.0 / M_PI, kNominal[i][1] * 1e3,
                    kNominal[i][2] * 1e3, kNominal[i][3] * 180.0 / M_PI);
  return "schema = \"cell/1\"\n[cell]\nname = \"sockets\"\ntolerance_mm = 0.1\n[robot]\n"
         "name = \"six axes\"\ndh_convention = \"standard\"\nlength_unit = \"mm\"\n"
         "angle_unit = \"deg\"\njoints = [\n" +
         joints + "]\n[measurement]\nfiles = [\"measurements.csv\"]\n[effects]\ngeometry = true\n";
}

}  // namespace plumb::offline
