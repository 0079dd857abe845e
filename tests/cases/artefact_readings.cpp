// SPDX-License-Identifier: Apache-2.0
#include "tests/cases/artefact_readings.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

namespace plumb::offline {
namespace {

using Eigen::Vector3d;
using Kind = ArtefactPlan::Kind;

constexpr double kRadius_m = 0.120, kZero_m = 0.3127, kPatch_m = 0.2, kHighest_m = 0.010;

const char* columns(Kind kind) {
  switch (kind) {
    case Kind::kPlane:
      return "plane";
    case Kind::kHeight:
      return "plane,height_mm";
    case Kind::kSphere:
      return "sphere";
    case Kind::kBall:
      return "sphere,radius_mm";
    case Kind::kDistance:
      return "anchor,distance_mm";
    case Kind::kWire:
      return "anchor,extension_mm";
  }
  return "";
}

Vector3d direction(SocketArm& arm) {
  return Vector3d(arm.normal(1.0), arm.normal(1.0), arm.normal(1.0)).normalized();
}

/// An artefact: its origin, and the normal of a plane.
struct Artefact {
  Vector3d origin, normal;
};

Artefact placed(SocketArm& arm) {
  const double turn = arm.uniform(-2.4, 2.4), far = arm.uniform(0.4, 0.7);
  return {{far * std::cos(turn), far * std::sin(turn), arm.uniform(0.1, 0.6)}, direction(arm)};
}

/// Joints of one reading and the texts of its columns behind the label; false: out of reach.
bool reading(SocketArm& arm, const ArtefactPlan& plan, const Artefact& at, SocketArm::Joints& q,
             std::string& read) {
  const double noise = arm.normal(plan.sigma_m);
  switch (plan.kind) {
    case Kind::kPlane:
    case Kind::kHeight: {
      const Vector3d u = at.normal.unitOrthogonal(), v = at.normal.cross(u);
      const double height = plan.kind == Kind::kHeight ? arm.uniform(0.0, kHighest_m) : 0.0;
      const Vector3d on =
          at.origin + arm.uniform(-kPatch_m, kPatch_m) * u + arm.uniform(-kPatch_m, kPatch_m) * v;
      if (plan.kind == Kind::kHeight) read = fmt::format(",{:.5f}", (height + noise) * 1e3);
      return arm.touch(on + (plan.kind == Kind::kHeight ? height : noise) * at.normal, q);
    }
    case Kind::kSphere:
    case Kind::kBall:
      if (plan.kind == Kind::kBall) read = fmt::format(",{:g}", kRadius_m * 1e3);
      return arm.touch(at.origin + (kRadius_m + noise) * direction(arm), q);
    default: {
      q = arm.random_joints();
      const double zero = plan.kind == Kind::kWire ? kZero_m : 0.0;
      const double distance = (arm.ball(q) - at.origin).norm();
      read = fmt::format(",{:.5f}", (distance - zero + noise) * 1e3);
      return distance > 0.05;
    }
  }
}

}  // namespace

std::string artefact_readings(SocketArm& arm, const ArtefactPlan& plan) {
  std::string csv = "pose,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,position,";
  csv += columns(plan.kind);
  csv += "\n";
  int pose = 0;
  for (int k = 0; k < plan.artefacts;) {
    Artefact at = placed(arm);
    std::string rows, read;
    int out_of_reach = 0, count = 0;
    SocketArm::Joints q;
    while (count < plan.readings && out_of_reach < 3) {
      if (k == 0 && 2 * count == plan.readings) at.origin.z() += plan.moved_m;
      if (!reading(arm, plan, at, q, read)) {
        ++out_of_reach;
        continue;
      }
      rows += fmt::format("R{}", pose + ++count);
      for (const double angle : q) rows += fmt::format(",{:.7f}", angle * 180.0 / M_PI);
      rows += fmt::format(",place {0},A{0}{1}\n", k, read);
    }
    if (count < plan.readings) continue;
    csv += rows;
    pose += count;
    ++k;
  }
  return csv;
}

}  // namespace plumb::offline
