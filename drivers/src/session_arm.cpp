// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_arm.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::drivers {
namespace {

/// The cosine of the angle between two rotations: half of trace(A^T B) - 1.
double cos_between(const Transformd& a, const Transformd& b) noexcept {
  double trace = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) trace += a.R(i, k) * b.R(i, k);
  return 0.5 * (trace - 1.0);
}

/// The distance of a point from the straight line between two others.
double distance(const Vector3& point, const Vector3& from, const Vector3& to) noexcept {
  const Vector3 way = to - from, lead = point - from;
  const double square = way.squaredNorm();
  const double share = square > 0.0 ? std::clamp(lead.dot(way) / square, 0.0, 1.0) : 0.0;
  return (lead - way * share).norm();
}

}  // namespace

ArmWatch::ArmWatch(const ArmLimits& limits) noexcept
    : limits_(limits),
      cos_angle_(std::cos(limits.angle_rad)),
      cos_moved_(std::cos(limits.moved_rad)) {}

const ArmWatch::Aim& ArmWatch::kept(int back) const noexcept {
  return path_[static_cast<std::size_t>((next_ - 1 - back + 2 * kKept) % kKept)];
}

void ArmWatch::aim(const Transformd& X_BD) noexcept {
  if (now_s_ - newest_.time_s > limits_.gap_s) {
    size_ = away_ = 0;
    near_s_ = now_s_;
    aimed_ = false;
  }
  newest_ = {X_BD, now_s_};
  const bool due = size_ == 0 || now_s_ - kept(0).time_s >= limits_.lag_s / (kKept - 2);
  if (due) {
    path_[static_cast<std::size_t>(next_)] = newest_;
    next_ = (next_ + 1) % kKept;
    size_ = std::min(size_ + 1, kKept);
  }
  if (!aimed_) X_BD_moved_ = X_BD;
  aimed_ = true;
  const Transformd X_BD_moved = X_BD_moved_;
  const bool reached = (X_BD.p - X_BD_moved.p).norm() <= limits_.moved_m &&
                       cos_between(X_BD, X_BD_moved) >= cos_moved_;
  if (reached) reached_s_ = now_s_;
}

/// The path begins anew behind a jump, which is no motion that the joints should show.
void ArmWatch::jump() noexcept {
  size_ = 0;
  aimed_ = false;
}

bool ArmWatch::near(const Aim& from, const Aim& to, const Transformd& X_BA) const noexcept {
  const Transformd begin = from.X_BD, end = to.X_BD;
  return distance(X_BA.p, begin.p, end.p) <= limits_.distance_m &&
         std::max(cos_between(begin, X_BA), cos_between(end, X_BA)) >= cos_angle_;
}

void ArmWatch::show(const Transformd& X_BA) noexcept {
  if (size_ == 0 || now_s_ - newest_.time_s > limits_.gap_s) return;
  bool found = near(kept(0), newest_, X_BA);
  for (int i = 1; i < kKept; ++i)
    found |= i < size_ && now_s_ - kept(i - 1).time_s <= limits_.lag_s &&
             near(kept(i), kept(i - 1), X_BA);
  away_ = found ? 0 : std::min(away_ + 1, kPosesAway);
  if (found) near_s_ = now_s_;
}

void ArmWatch::show_joints(std::span<const double> q) noexcept {
  if (std::equal(q.begin(), q.end(), q_.begin())) return;
  std::copy(q.begin(), q.end(), q_.begin());
  X_BD_moved_ = newest_.X_BD;
  reached_s_ = now_s_;
}

bool ArmWatch::away() const noexcept {
  return away_ >= kPosesAway && now_s_ - near_s_ > limits_.lag_s;
}

bool ArmWatch::still() const noexcept {
  return aimed_ && now_s_ - newest_.time_s <= limits_.gap_s && now_s_ - reached_s_ > limits_.lag_s;
}

}  // namespace plumb::drivers
