// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "plumb/format/model.hpp"

/// Arms for the differential tests: random ones, and the shapes that people own.
namespace plumb::test {

inline constexpr double kPi = std::numbers::pi;

class RandomArm {
 public:
  explicit RandomArm(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool coin(double chance = 0.5) { return uniform(0.0, 1.0) < chance; }

  format::Twist twist(double length, double angle) {
    format::Twist xi;
    for (auto& d : xi.d) d = uniform(-length, length);
    for (auto& e : xi.e) e = uniform(-angle, angle);
    return xi;
  }

  format::Pose pose(double length) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(
        uniform(-kPi, kPi),
        Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1)).normalized()));
    return {{uniform(-length, length), uniform(-length, length), uniform(-length, length)},
            {q.w(), q.x(), q.y(), q.z()}};
  }

  /// Nothing left out: either convention, sliding joints, beta, scales, offsets, large twists.
  format::Chain anything() {
    format::Chain chain;
    chain.convention = coin() ? format::Convention::kStandard : format::Convention::kModified;
    chain.base = pose(1.0);
    chain.base_twist = twist(0.1, 0.5);
    chain.tool_twist = twist(0.1, 0.5);
    chain.tool = pose(0.3);
    chain.joints.resize(static_cast<std::size_t>(integer(1, format::kMaxJoints)));
    for (auto& row : chain.joints) {
      row.type = coin(0.2) ? format::JointType::kPrismatic : format::JointType::kRevolute;
      row.alpha = coin() ? kPi / 2 * integer(-2, 2) : uniform(-kPi, kPi);
      row.a = coin() ? 0.0 : uniform(-0.8, 0.8);
      row.d = uniform(-0.5, 0.5);
      row.theta = coin() ? 0.0 : uniform(-kPi, kPi);
      row.beta = coin() ? 0.0 : uniform(-0.3, 0.3);
      row.scale = coin() ? 1.0 : uniform(0.9, 1.1);
      row.offset = uniform(-0.1, 0.1);
      if (coin()) row.pre = twist(0.05, 0.2);
      if (coin()) row.post = twist(0.05, 0.2);
    }
    return chain;
  }

  /// Joint positions within the rows' limits.
  std::vector<double> positions(const format::Chain& chain) {
    std::vector<double> q;
    for (const auto& row : chain.joints) q.push_back(uniform(row.q_min, row.q_max));
    return q;
  }

  /// The arm as built: errors of a millimetre and a milliradian, in rows and in twists.
  format::Chain as_built(format::Chain chain) {
    for (auto& row : chain.joints) {
      row.a += uniform(-1e-3, 1e-3);
      row.d += uniform(-1e-3, 1e-3);
      row.alpha += uniform(-1e-3, 1e-3);
      row.beta += uniform(-1e-3, 1e-3);
      row.offset += uniform(-1e-3, 1e-3);
      row.scale *= 1.0 + uniform(-2e-4, 2e-4);
      if (coin()) row.pre = twist(5e-4, 5e-4);
      if (coin()) row.post = twist(5e-4, 5e-4);
    }
    chain.base_twist = twist(1e-3, 1e-3);
    chain.tool_twist = twist(1e-3, 1e-3);
    return chain;
  }

 private:
  std::mt19937_64 engine_;
};

/// One DH row; revolute unless said otherwise.
inline format::JointRow row(double alpha, double a, double d, double theta = 0.0) {
  format::JointRow out;
  out.alpha = alpha;
  out.a = a;
  out.d = d;
  out.theta = theta;
  out.q_min = -2.8;
  out.q_max = 2.8;
  return out;
}

inline format::JointRow sliding(double alpha, double a, double theta, double q_min, double q_max) {
  format::JointRow out = row(alpha, a, 0.0, theta);
  out.type = format::JointType::kPrismatic;
  out.q_min = q_min;
  out.q_max = q_max;
  return out;
}

inline format::Chain chain_of(format::Convention convention, std::vector<format::JointRow> joints) {
  format::Chain out;
  out.convention = convention;
  out.joints = std::move(joints);
  return out;
}

/// Like a UR10: standard, three parallel axes.
inline format::Chain ur10() {
  const double h = kPi / 2;
  return chain_of(format::Convention::kStandard,
                  {row(h, 0, 0.1273), row(0, -0.612, 0), row(0, -0.5723, 0), row(h, 0, 0.1639),
                   row(-h, 0, 0.1157), row(0, 0, 0.0922)});
}

/// Like a Staubli TX200: modified, two parallel axes, spherical wrist.
inline format::Chain tx200() {
  const double h = kPi / 2;
  return chain_of(format::Convention::kModified,
                  {row(0, 0, 0.642), row(-h, 0.25, 0, -h), row(0, 0.95, 0, h), row(h, 0, 0.8),
                   row(-h, 0, 0), row(h, 0, 0.194)});
}

/// Like a KUKA iiwa: seven joints.
inline format::Chain iiwa() {
  const double h = kPi / 2;
  return chain_of(format::Convention::kStandard,
                  {row(-h, 0, 0.34), row(h, 0, 0), row(h, 0, 0.4), row(-h, 0, 0), row(-h, 0, 0.4),
                   row(h, 0, 0), row(0, 0, 0.126)});
}

/// Two turning joints, one sliding, one turning tool.
inline format::Chain scara() {
  return chain_of(format::Convention::kStandard, {row(0, 0.35, 0.3), row(kPi, 0.3, 0),
                                                  sliding(0, 0, 0, 0.0, 0.3), row(0, 0, 0.05)});
}

inline format::Chain planar(int joints) {
  format::Chain out;
  for (int i = 0; i < joints; ++i) out.joints.push_back(row(0, i == 0 ? 0.5 : 0.4, 0));
  return out;
}

/// Five joints: base, three parallel, tool roll.
inline format::Chain five_axes() {
  const double h = kPi / 2;
  return chain_of(
      format::Convention::kStandard,
      {row(h, 0.05, 0.3), row(0, 0.4, 0), row(0, 0.35, 0), row(h, 0, 0.02), row(0, 0, 0.15)});
}

}  // namespace plumb::test
