// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <numbers>
#include <span>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/detail/kept_pose.hpp"

namespace plumb::drivers {

/// How far the arm may be from the targets.
///
/// The arm follows a target with a delay of up to `lag_s`, so it is compared with the whole path of
/// the targets of that time: at 2 m/s a delay of 0.3 s is 600 mm, and a limit of that size would
/// find nothing. What is left is the correction itself, a few millimetres, and the corners that the
/// controller cuts: 2 m/s times its time constant of position of 5 ms, 10 mm. 20 mm is both.
struct ArmLimits {
  double distance_m = 0.02;
  double angle_rad = 10.0 * std::numbers::pi / 180.0;
  double lag_s = 0.3;  // longest delay of the arm behind its targets; infinite: nothing is watched
  double moved_m = 0.002;  // motion of the target that the joints must show
  double moved_rad = 0.2 * std::numbers::pi / 180.0;
  double gap_s = 0.1;  // after a longer silence of the targets their path begins anew
};

/// Tells whether the arm is where the targets are.
///
///     targets    o--o--o--o--o   the path of the last lag_s
///     arm             x          near it: the distance from the path, not from the last target
///
/// Away: at least three poses of the arm in a row, over at least lag_s, were farther from the path
/// than the limits. Still: the target has been away for lag_s from where it was when a joint last
/// changed its position, if only by one count of the bus. An arm at rest under a target at rest is
/// neither.
///
/// Heap: none. Thread: one. Cost: fixed; kKept distances from a line for a pose of the arm.
class ArmWatch {
 public:
  explicit ArmWatch(const ArmLimits& limits) noexcept;

  /// To be called once a cycle.
  void step(double ageing_s) noexcept { now_s_ += ageing_s; }

  void aim(const Transformd& X_BD) noexcept;             // an accepted target
  void jump() noexcept;                                  // one beyond its limits of motion
  void show(const Transformd& X_BA) noexcept;            // the controller's pose of the arm
  void show_joints(std::span<const double> q) noexcept;  // joints that are numbers

  bool away() const noexcept;
  bool still() const noexcept;

 private:
  static constexpr int kKept = 16;
  static constexpr int kPosesAway = 3;
  struct Aim {
    KeptPose X_BD;
    double time_s = 0.0;
  };

  const Aim& kept(int back) const noexcept;  // 0: the newest in the ring
  bool near(const Aim& from, const Aim& to, const Transformd& X_BA) const noexcept;

  ArmLimits limits_;
  double cos_angle_;
  double cos_moved_;
  double now_s_ = 0.0;
  std::array<Aim, kKept> path_;  // a ring of targets, lag_s / (kKept - 2) apart or more
  int size_ = 0;
  int next_ = 0;
  Aim newest_;
  double near_s_ = 0.0;  // when the arm was last near the path
  int away_ = 0;         // poses in a row that were not
  std::array<double, kMaxMessageValues> q_ = BusMessage::unknown();
  KeptPose X_BD_moved_;     // the target when a joint last moved
  double reached_s_ = 0.0;  // when the target was last within moved_m of it
  bool aimed_ = false;      // a target has come
};

}  // namespace plumb::drivers
