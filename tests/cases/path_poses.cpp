// SPDX-License-Identifier: Apache-2.0
#include "tests/cases/path_poses.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "simulate/arm.hpp"
#include "simulate/random.hpp"

namespace plumb::offline {
namespace {

using sim::Random;
using sim::Vector3d;
using Pose = Eigen::Isometry3d;

constexpr double kLengthOfReach = 0.4;  // of a path, over the arm's reach
constexpr int kCloserSteps = 60;
constexpr double kThere = 1e-10;      // [m] and [rad]
constexpr double kLargestTurn = 0.3;  // of a joint in one step towards a pose [rad]
constexpr int kTries = 2000;          // places of a path
constexpr int kProbes = 16;           // on each side of it
constexpr double kMiddle = 0.8;       // of the joints' ranges, where a path begins

/// Where a path lies, and how the tool stands on it.
struct Place {
  PoseField field;
  Pose begin;
  Vector3d along, across, turn_axis;
  double length;

  /// u, v: 0 to 1.
  Pose at(double u, double v) const {
    Pose out = begin;
    switch (field) {
      case PoseField::kCurve: {
        const double angle = std::numbers::pi * u;
        out.translation() +=
            0.5 * length * ((1.0 - std::cos(angle)) * along + std::sin(angle) * across);
        out.linear() = Eigen::AngleAxisd(0.5 * angle, turn_axis) * begin.linear();
        break;
      }
      case PoseField::kSurface:
        out.translation() += length * (u * along + v * across);
        break;
      default:
        out.translation() += length * u * along;
    }
    return out;
  }
};

Pose pose_of(const sim::Arm& arm, const Eigen::VectorXd& q) { return arm.frames(q).flange; }

/// How far poses stay away from singular ones, as the least pivot of the Jacobian over the largest,
/// and within which share of the joints' ranges.
struct Room {
  double least_pivot, share_of_range;
};
constexpr Room kOfPath{0.05, 0.95}, kOfPoses{1e-3, 1.0};  // poses lie between those of a path

/// Joints that reach a pose, from others nearby.
std::optional<Eigen::VectorXd> joints_at(const Cell& cell, const sim::Arm& arm, const Pose& wanted,
                                         Room room, Eigen::VectorXd q) {
  constexpr double kDelta = 1e-6;
  for (int step = 0; step < kCloserSteps; ++step) {
    const Pose here = pose_of(arm, q);
    Eigen::Matrix<double, 6, 1> miss;
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(wanted.linear() * here.linear().transpose()));
    miss << wanted.translation() - here.translation(), turn.angle() * turn.axis();
    Eigen::Matrix<double, 6, 6> J;
    for (int j = 0; j < 6; ++j) {
      Eigen::VectorXd moved = q;
      moved(j) += kDelta;
      const Pose there = pose_of(arm, moved);
      const Eigen::AngleAxisd by(Eigen::Matrix3d(there.linear() * here.linear().transpose()));
      J.col(j) << (there.translation() - here.translation()) / kDelta,
          by.angle() * by.axis() / kDelta;
    }
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 6, 6>> qr(J);
    const auto pivots = qr.matrixR().diagonal().cwiseAbs().eval();
    if (pivots.minCoeff() < room.least_pivot * pivots.maxCoeff()) return std::nullopt;
    Eigen::VectorXd more = qr.solve(miss);
    const double largest = more.cwiseAbs().maxCoeff();
    if (largest > kLargestTurn) more *= kLargestTurn / largest;
    q += more;
    if (miss.norm() > kThere) continue;
    for (int j = 0; j < 6; ++j) {
      const auto& limits = cell.nominal.joints[static_cast<std::size_t>(j)];
      const double middle = 0.5 * (limits.q_min + limits.q_max);
      const double most = 0.5 * room.share_of_range * (limits.q_max - limits.q_min);
      if (std::abs(q(j) - middle) > most) return std::nullopt;
    }
    return q;
  }
  return std::nullopt;
}

/// Joints at points of the path, each reached from the one before it.
std::optional<RowsN> followed(const Cell& cell, const sim::Arm& arm, const Place& place,
                              const Eigen::MatrixXd& points, Room room, Eigen::VectorXd q) {
  RowsN out(points.rows(), 6);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const auto next = joints_at(cell, arm, place.at(points(i, 0), points(i, 1)), room, q);
    if (!next) return std::nullopt;
    out.row(i) = (q = *next).transpose();
  }
  return out;
}

/// Points of the path in its order, (poses, 2). coordinate: of place k of so many on a side.
Eigen::MatrixXd points_of(PoseField field, int poses,
                          const std::function<double(int k, int side)>& coordinate) {
  Eigen::MatrixXd out(poses, 2);
  const int side = field == PoseField::kSurface
                       ? std::max(2, static_cast<int>(std::ceil(std::sqrt(poses))))
                       : poses;
  for (int i = 0; i < poses; ++i) {
    const int row = i / side, at = i % side;
    const int column = row % 2 == 0 ? at : side - 1 - at;  // to and fro
    out(i, 0) = coordinate(column, side);
    out(i, 1) = coordinate(row, side);
  }
  return out;
}

/// A path all of which the arm reaches, and the joints at its beginning.
struct Reached {
  Place place;
  Eigen::VectorXd q;
};

Reached reached_path(PoseField field, const Cell& cell, const sim::Arm& arm, Random random) {
  const Eigen::MatrixXd probes =
      points_of(field, field == PoseField::kSurface ? kProbes * kProbes : kProbes,
                [](int k, int side) { return k / (side - 1.0); });  // its ends among them
  for (int attempt = 0; attempt < kTries; ++attempt) {
    Eigen::VectorXd q(6);
    for (int j = 0; j < 6; ++j) {
      const auto& limits = cell.nominal.joints[static_cast<std::size_t>(j)];
      q(j) = kMiddle * random.uniform(limits.q_min, limits.q_max);
    }
    Place place{field, pose_of(arm, q),    random.direction(),
                {},    random.direction(), kLengthOfReach * arm.reach()};
    place.across = place.along.unitOrthogonal();
    if (followed(cell, arm, place, probes, kOfPath, q)) return {place, q};
  }
  throw std::runtime_error("no such path is within reach of the arm");
}

}  // namespace

RowsN poses_on(PoseField field, const Cell& cell, int poses, std::uint64_t field_seed,
               std::uint64_t seed) {
  const sim::Arm arm(cell.nominal);
  const Reached path = reached_path(field, cell, arm, {field_seed, "place of a path"});
  Random random(seed, "points of a path");
  // Each at a random place of its share of the path.
  const auto points =
      points_of(field, poses, [&](int k, int side) { return (k + random.uniform()) / side; });
  const auto out = followed(cell, arm, path.place, points, kOfPoses, path.q);
  if (!out) throw std::runtime_error("the arm leaves its path");
  return *out;
}

}  // namespace plumb::offline
