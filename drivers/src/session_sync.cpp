// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_sync.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/session_inputs.hpp"

namespace plumb::drivers {
void SyncCheck::restart() noexcept {
  counters_.agreed = counters_.distinct = counters_.mismatched_in_row = 0;
  counters_.worst_m = counters_.worst_rad = 0.0;
  for (auto& joints : joints_) joints.size = 0;
  actual_.size = 0;
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
  compared_.renew();
  if (!agrees) {
    ++counters_.mismatched;
    counters_.mismatched_in_row = std::min(counters_.mismatched_in_row + 1, settings_.mismatches);
    if (!agreed()) counters_.agreed = counters_.distinct = 0;
    return;
  }
  counters_.mismatched_in_row = 0;
  if (agreed()) return;
  counters_.agreed = std::min(counters_.agreed + 1, settings_.poses);
  if (!is_distinct(q)) return;
  std::copy(q.begin(), q.end(), distinct_[static_cast<std::size_t>(counters_.distinct)].begin());
  ++counters_.distinct;
}

bool SyncCheck::apart(std::span<const double> q, const Values& from) const noexcept {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (!(std::abs(q[i] - from[i]) < settings_.moved)) return true;
  return false;
}

bool SyncCheck::is_distinct(std::span<const double> q) const noexcept {
  const auto known = std::span(distinct_).first(static_cast<std::size_t>(counters_.distinct));
  return counters_.distinct < kMostDistinct &&
         std::all_of(known.begin(), known.end(),
                     [&](const Values& from) { return apart(q, from); });
}

}  // namespace plumb::drivers
