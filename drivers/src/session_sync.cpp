// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_sync.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "plumb/drivers/bus_content.hpp"

namespace plumb::drivers {
namespace {

constexpr double kMostJoint = 1e4;  // [rad] or [m]: larger than any joint position of an arm

bool is_joint_state(std::span<const double> q) noexcept {
  return std::all_of(q.begin(), q.end(), [](double x) { return std::abs(x) <= kMostJoint; });
}

}  // namespace

void SyncCheck::restart() noexcept {
  counters_.agreed = counters_.distinct = counters_.mismatched_in_row = 0;
  counters_.worst_m = counters_.worst_rad = 0.0;
  for (auto& joints : joints_) joints.size = 0;
  actual_.size = 0;
  q_distinct_ = BusMessage::unknown();
}

void SyncCheck::hear(const BusMessage& message, const Chain& nominal) noexcept {
  if (message.kind == MessageKind::kJoints) {
    joints_[next_] = message;
    next_ = (next_ + 1) % kKept;
  } else if (message.kind == MessageKind::kActual) {
    actual_ = message;
  } else {
    return;
  }
  const auto found = std::find_if(joints_.begin(), joints_.end(),
                                  [this](const BusMessage& joints) { return paired(joints); });
  if (found == joints_.end()) return;
  compare(*found, nominal);
  actual_.size = 0;
}

bool SyncCheck::paired(const BusMessage& joints) const noexcept {
  if (joints.size == 0 || actual_.size == 0 || joints.counter != actual_.counter) return false;
  const double apart_s = 1e-9 * static_cast<double>(joints.time_ns - actual_.time_ns);
  return std::abs(apart_s) <= settings_.within_s;
}

void SyncCheck::compare(const BusMessage& joints, const Chain& nominal) noexcept {
  const auto n = static_cast<std::size_t>(nominal.joints());
  const std::span q = std::span(joints.values).first(n);
  const auto X_BA = pose_in(actual_);
  if (!X_BA || joints.size < n || !is_joint_state(q)) return;
  const Transformd X_BN = nominal.forward(q);
  counters_.last_m = (X_BA->p - X_BN.p).norm();
  counters_.last_rad = rotation_vector(times_transposed<double>(X_BA->R, X_BN.R)).norm();
  counters_.worst_m = std::max(counters_.worst_m, counters_.last_m);
  counters_.worst_rad = std::max(counters_.worst_rad, counters_.last_rad);
  count(counters_.last_m <= settings_.position_m && counters_.last_rad <= settings_.rotation_rad,
        q);
}

void SyncCheck::count(bool agrees, std::span<const double> q) noexcept {
  ++counters_.compared;
  if (!agrees) {
    ++counters_.mismatched;
    counters_.mismatched_in_row = std::min(counters_.mismatched_in_row + 1, settings_.mismatches);
    if (!agreed()) counters_.agreed = 0;
    return;
  }
  counters_.mismatched_in_row = 0;
  if (agreed()) return;
  ++counters_.agreed;
  if (!moved(q)) return;
  ++counters_.distinct;
  std::copy(q.begin(), q.end(), q_distinct_.begin());
}

bool SyncCheck::moved(std::span<const double> q) const noexcept {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (!(std::abs(q[i] - q_distinct_[i]) <= settings_.moved)) return true;
  return false;
}

}  // namespace plumb::drivers
