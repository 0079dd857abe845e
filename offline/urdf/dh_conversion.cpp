// SPDX-License-Identifier: Apache-2.0
#include "urdf/dh_conversion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kNearParallel = 0.01;  // sine of the angle between neighbouring axes
constexpr double kOnTheAxis_m = 1e-9;   // nearer points are on the axis, to rounding

struct Link {
  double a = 0.0, alpha = 0.0, beta = 0.0;
  Transformd motion() const { return translation(a, 0, 0) * rot_x(alpha) * rot_y(beta); }
};

/// The place on a joint axis where the DH frame must be, so that one DH link leads to the next
/// axis.
struct Foot {
  Vector3 point, x;
};

Foot foot_of(const Transformd& G, const JointAxis& next) {
  const Vector3 z = G.R.col(2);
  const Vector3 across = z.cross(next.direction);
  const double sine = across.norm();
  Foot out{G.p, G.R.col(0)};
  if (sine < kNearParallel) {
    // For parallel axes: where the next axis crosses the plane through the present origin.
    const double along = z.dot(G.p - next.point) / z.dot(next.direction);
    const Vector3 there = next.point + along * next.direction - G.p;
    if (there.norm() > kOnTheAxis_m) out.x = there.normalized();
    return out;
  }
  const Vector3 normal = across / sine;
  // The point of the axis nearest to the next one.
  out.point = G.p + z * ((next.point - G.p).cross(next.direction).dot(normal) / sine);
  out.x = (next.point - out.point).dot(normal) < 0.0 ? -normal : normal;
  return out;
}

Link link_to(const Transformd& F, const JointAxis& next) {
  const Vector3 z = F.R.transpose() * next.direction;
  const Vector3 p = F.R.transpose() * (next.point - F.p);
  Link out;
  out.beta = std::asin(std::clamp(z(0), -1.0, 1.0));
  out.alpha = std::atan2(-z(1), z(2));
  // The next axis meets the x axis of F here.
  const double along = std::abs(z(2)) > std::abs(z(1)) ? -p(2) / z(2) : -p(1) / z(1);
  out.a = p(0) + along * z(0);
  if (std::abs(out.beta) < 1e-12) out.beta = 0.0;
  return out;
}

Transformd start_on(const JointAxis& axis) {
  Transformd out;
  const Vector3 other = std::abs(axis.direction(0)) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 x = (other - axis.direction * other.dot(axis.direction)).normalized();
  out.R << x, axis.direction.cross(x), axis.direction;
  out.p = axis.point;
  return out;
}

void put(const Link& link, format::JointRow& row) {
  row.a = link.a;
  row.alpha = link.alpha;
  row.beta = link.beta;
}

}  // namespace

DhArm to_dh(const std::vector<JointAxis>& axes, const Transformd& X_RT,
            format::Convention convention) {
  DhArm out;
  out.chain.convention = convention;
  Transformd G = start_on(axes.front());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    format::JointRow row;
    row.name = axes[i].name;
    row.type = axes[i].type;
    row.q_min = axes[i].q_min;
    row.q_max = axes[i].q_max;
    out.chain.joints.push_back(row);
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    auto& row = out.chain.joints[i];
    const bool last = i + 1 == axes.size();
    const Foot foot = last ? Foot{G.p, G.R.col(0)} : foot_of(G, axes[i + 1]);
    const Vector3 x = G.R.transpose() * foot.x;
    const double theta = std::atan2(x(1), x(0));
    const double d = G.R.col(2).dot(foot.point - G.p);
    const Transformd turned = G * rot_z(theta);
    const Transformd F = turned * translation(0, 0, d);
    if (i == 0) {
      out.chain.base = to_pose(F);
    } else {
      row.theta = theta;
      row.d = d;
    }
    const bool slides = row.type == format::JointType::kPrismatic;
    out.behind_joint.push_back(i == 0 || slides ? F : turned);
    if (last) {
      out.chain.tool = to_pose(F.inverse() * X_RT);
      break;
    }
    const Link link = link_to(F, axes[i + 1]);
    put(link, convention == format::Convention::kStandard ? row : out.chain.joints[i + 1]);
    G = F * link.motion();
  }
  return out;
}

}  // namespace plumb::offline
