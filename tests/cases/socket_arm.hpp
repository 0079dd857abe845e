// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace plumb::offline {

/// What a simulated arm with six axes hides, and how its sockets are touched.
struct SocketPlan {
  std::uint64_t seed = 1;
  int placements = 6;              // of a plate with two sockets, 80 mm apart
  int touches = 20;                // of each socket
  double play_m = 30e-6;           // 1 sigma of the ball in its socket, each axis
  double yields_rad_per_Nm = 0.0;  // of J2; J3 yields twice as much
  double moved_m = 0.0;            // the first socket moves by this half-way through its touches
  bool known_distance = false;     // columns to_point, distance_mm
};

/// An arm that touches sockets with a ball. Its kinematics are written here anew, with rotation
/// matrices and nothing of the program's, so that a fit of its readings has independent evidence.
class SocketArm {
 public:
  using Joints = std::array<double, 6>;

  explicit SocketArm(const SocketPlan& plan);

  /// cell.toml of the nominal arm, and its measurements.csv.
  std::string cell_toml() const;
  std::string measurements_csv() const { return csv_; }

  /// The ball in the base frame [m], or a point of the tool `beside_T` away from it.
  Eigen::Vector3d ball(const Joints& q,
                       const Eigen::Vector3d& beside_T = Eigen::Vector3d::Zero()) const;

  /// A normal vector with this standard deviation of each axis [m].
  Eigen::Vector3d noise(double sigma_m) {
    return {normal(sigma_m), normal(sigma_m), normal(sigma_m)};
  }

  /// Where the sockets are [m], in the order of the file.
  const std::vector<Eigen::Vector3d>& sockets() const { return sockets_; }

  /// Joint readings within the limits.
  Joints random_joints();

  /// Joints that bring the ball to a point; false where none are found.
  bool touch(const Eigen::Vector3d& point, Joints& q);

  /// Evenly distributed, and normal.
  double uniform(double from, double to);
  double normal(double sigma);

  /// Mean distance [m] of predicted and true balls at 200 fresh joints, after the rigid motion that
  /// lays the predicted ones on the true ones: where the base stands is open.
  double error_at_fresh_joints(const std::function<Eigen::Vector3d(const Joints&)>& predicted);

  /// True rows theta, d, a, alpha of standard DH [rad, m].
  const std::array<std::array<double, 4>, 6>& rows() const { return rows_; }

 private:
  void write_touches();

  SocketPlan plan_;
  std::uint64_t state_;
  std::array<std::array<double, 4>, 6> rows_;
  Eigen::Vector3d ball_T_{0.0123, -0.0081, 0.095};
  std::vector<Eigen::Vector3d> sockets_;
  std::string csv_;
};

}  // namespace plumb::offline
