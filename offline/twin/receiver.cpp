// SPDX-License-Identifier: Apache-2.0
#include "twin/receiver.hpp"

#include <algorithm>

#include "plumb/drivers/bus_content.hpp"
#include "twin/transforms.hpp"

namespace plumb::offline::twin {
namespace {

using drivers::MessageKind;

/// `value` moved towards `goal` by at most `most`.
Vector3d towards(const Vector3d& value, const Vector3d& goal, double most) {
  const Vector3d way = goal - value;
  const double length = way.norm();
  return length <= most ? goal : Vector3d(value + way * (most / length));
}

}  // namespace

Offset offset_between(const Isometry3d& X_BD, const Isometry3d& X_BC) {
  const Eigen::AngleAxisd turn(X_BC.linear() * X_BD.linear().transpose());
  return {X_BC.translation() - X_BD.translation(), turn.angle() * turn.axis()};
}

Isometry3d applied(const Offset& offset, const Isometry3d& X_BD) {
  Isometry3d out = X_BD;
  out.translation() += offset.translation;
  const double angle = offset.rotation.norm();
  if (angle > 0.0) out.linear() = Eigen::AngleAxisd(angle, offset.rotation / angle) * X_BD.linear();
  return out;
}

void Receiver::sent(std::uint16_t counter, const Isometry3d& X_BD, std::int64_t now_ns) {
  sent_[counter & 0xFFU] = {true, now_ns, X_BD};
}

std::optional<Offset> Receiver::offset_in(const drivers::BusMessage& message,
                                          const Sent& target) const {
  if (message.kind == MessageKind::kOffset) {
    const Transformd X_BD = to_transform(target.X_BD);
    const Isometry3d X_BC = to_isometry(drivers::add_offset(X_BD, message));
    return offset_between(target.X_BD, X_BC);
  }
  const auto pose = drivers::pose_in(message);
  if (!pose) return std::nullopt;
  return offset_between(target.X_BD, to_isometry(*pose));
}

void Receiver::hear(const drivers::BusMessage& message, std::int64_t now_ns) {
  if (message.kind != MessageKind::kCorrected && message.kind != MessageKind::kOffset) return;
  const Sent& target = sent_[message.counter & 0xFFU];
  const double age_s = 1e-9 * static_cast<double>(now_ns - target.time_ns);
  if (!target.known || age_s > settings_.fresh_s) return void(++counters_.stale);
  if (has_goal_ && target.time_ns < goal_ns_) return void(++counters_.overtaken);
  const auto offset = offset_in(message, target);
  const bool small = offset && offset->translation.norm() <= settings_.most_m &&
                     offset->rotation.norm() <= settings_.most_rad;
  if (!small) return void(++counters_.too_large);
  goal_ = *offset;
  goal_ns_ = target.time_ns;
  has_goal_ = true;
  ++counters_.used;
  counters_.oldest_s = std::max(counters_.oldest_s, age_s);
}

bool Receiver::fresh(std::int64_t now_ns) const {
  return has_goal_ && 1e-9 * static_cast<double>(now_ns - goal_ns_) <= settings_.fresh_s;
}

const Offset& Receiver::step(std::int64_t now_ns, double dt_s) {
  const Offset goal = fresh(now_ns) ? goal_ : Offset{};
  present_.translation =
      towards(present_.translation, goal.translation, settings_.slew_m_per_s * dt_s);
  present_.rotation = towards(present_.rotation, goal.rotation, settings_.slew_rad_per_s * dt_s);
  return present_;
}

void Receiver::forget() {
  sent_.fill({});
  has_goal_ = false;
}

}  // namespace plumb::offline::twin
