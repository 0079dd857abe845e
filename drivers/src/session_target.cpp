// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_target.hpp"

#include <algorithm>
#include <cmath>

#include "plumb/drivers/bus_content.hpp"

namespace plumb::drivers {
namespace {

/// A target whose counter is behind by at most this many was overtaken by a later one. If it is
/// behind by more, its sender has restarted.
constexpr int kOvertaken = 16;

/// No arm reaches farther [m], and no rotation vector is longer [rad].
constexpr double kFarthest_m = 1e3, kLongest_rad = 10.0;

bool is_reachable(const BusMessage& target) noexcept {
  for (std::size_t i = 0; i < 6; ++i)
    if (!(std::abs(target.values[i]) <= (i < 3 ? kFarthest_m : kLongest_rad))) return false;
  return true;
}

/// The difference of two counters in -128 .. 127, from the 8 bits that every bus transmits.
int advance(std::uint16_t from, std::uint16_t to) noexcept {
  return static_cast<std::int8_t>(static_cast<std::uint8_t>(to - from));
}

}  // namespace

TargetVerdict TargetGate::order(const BusMessage& target) const noexcept {
  const int steps = advance(last_counter_, target.counter);
  if (steps == 0) return TargetVerdict::kRepeated;
  return steps < 0 && steps >= -kOvertaken ? TargetVerdict::kOutOfOrder : TargetVerdict::kAccepted;
}

double TargetGate::elapsed_s(const BusMessage& target) const noexcept {
  const double received_s = 1e-9 * static_cast<double>(target.time_ns - last_ns_);
  const int steps = advance(last_counter_, target.counter);
  return std::max(received_s, limits_.period_s * std::max(steps, 1));
}

TargetVerdict TargetGate::motion(const Transformd& X_BD, double elapsed_s) const noexcept {
  const Transformd last = last_;
  const double distance_m = (X_BD.p - last.p).norm();
  const double angle_rad = rotation_vector(times_transposed<double>(X_BD.R, last.R)).norm();
  if (!(distance_m <= limits_.step_m && angle_rad <= limits_.step_rad))
    return TargetVerdict::kTooFar;
  const bool slow =
      distance_m <= limits_.speed_m_s * elapsed_s && angle_rad <= limits_.speed_rad_s * elapsed_s;
  return slow ? TargetVerdict::kAccepted : TargetVerdict::kTooFast;
}

TargetVerdict TargetGate::judge(const BusMessage& target, Transformd& X_BD) noexcept {
  const bool recent =
      has_last_ && 1e-9 * static_cast<double>(target.time_ns - last_ns_) <= limits_.gap_s;
  if (recent && order(target) != TargetVerdict::kAccepted) return order(target);
  const auto pose = pose_in(target);
  if (!pose || !is_reachable(target)) return TargetVerdict::kNoPose;
  X_BD = *pose;
  const TargetVerdict out = recent ? motion(X_BD, elapsed_s(target)) : TargetVerdict::kAccepted;
  last_ = X_BD;
  last_ns_ = target.time_ns;
  last_counter_ = target.counter;
  has_last_ = true;
  return out;
}

}  // namespace plumb::drivers
