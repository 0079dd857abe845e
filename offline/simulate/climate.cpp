// SPDX-License-Identifier: Apache-2.0
#include "simulate/climate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::offline::sim {
namespace {

constexpr double kMinute = 60.0;
constexpr double kHour = 3600.0;
constexpr int kTableSteps = 2000;
// Chosen to be like a medium arm in a hall: some kelvins in half an hour.
constexpr double kWorkInPause = 0.2;     // heat in the pause, as a share of that of full work
constexpr double kRise_K = 8.0;          // of a zone at full work, in the end
constexpr double kLag = 28.0 * kMinute;  // time constant of a zone
constexpr double kSpread = 0.3;          // largest difference of ln rise and ln lag of a zone

}  // namespace

Climate::Climate(int joints, double session_s, double spread, Random random)
    : period_s_(random.uniform(35.0, 75.0) * kMinute),
      phase_(random.uniform(-std::numbers::pi, std::numbers::pi)),
      swing_K_(random.uniform(0.6, 1.6)),
      drift_K_per_hour_(random.uniform(-0.6, 0.6)),
      pause_begin_s_(random.uniform(0.4, 0.55) * session_s),
      pause_end_s_(pause_begin_s_ + random.uniform(0.12, 0.25) * session_s),
      step_s_(std::max(session_s, 1.0) / kTableSteps),
      rise_(joints + 1),
      lag_(joints + 1) {
  for (int zone = 0; zone <= joints; ++zone) {
    rise_(zone) = kRise_K * std::exp(spread * random.uniform(-kSpread, kSpread));
    lag_(zone) = kLag * std::exp(spread * random.uniform(-kSpread, kSpread));
  }
  // Exact for a target that stays constant over one step.
  VectorXd T = VectorXd::Constant(joints + 1, air(0.0));
  table_.push_back(T);
  for (int k = 0; k < kTableSteps; ++k) {
    const double middle = (k + 0.5) * step_s_;
    const VectorXd target = (work(middle) * rise_).array() + air(middle);
    T += (1.0 - (-step_s_ / lag_.array()).exp()).matrix().cwiseProduct(target - T);
    table_.push_back(T);
  }
}

double Climate::air(double time_s) const {
  const double turn = 2.0 * std::numbers::pi * time_s / period_s_;
  return swing_K_ * std::sin(turn + phase_) + drift_K_per_hour_ * time_s / kHour;
}

double Climate::work(double time_s) const {
  return time_s > pause_begin_s_ && time_s < pause_end_s_ ? kWorkInPause : 1.0;
}

VectorXd Climate::zones(double time_s) const {
  const double at = std::clamp(time_s / step_s_, 0.0, static_cast<double>(kTableSteps));
  const auto low = std::min(static_cast<std::size_t>(at), table_.size() - 2);
  const double share = at - static_cast<double>(low);
  return (1.0 - share) * table_[low] + share * table_[low + 1];
}

}  // namespace plumb::offline::sim
