// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

namespace plumb {

/// How long ago something arrived [s]; infinite until it did. The watchdog of one input.
/// Heap: none. Thread: one. Cost: fixed. Errors: none; what is no age counts as never arrived.
class Age {
 public:
  /// It arrived, so long ago.
  void renew(double age_s = 0.0) noexcept { age_s_ = age_s >= 0.0 ? age_s : kNever; }

  /// Time went by.
  void advance(double dt_s) noexcept { age_s_ += dt_s; }

  /// A limit that is no number is always exceeded.
  bool within(double limit_s) const noexcept { return age_s_ <= limit_s && age_s_ < kNever; }

  double value_s() const noexcept { return age_s_; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  double age_s_ = kNever;
};

/// Time from cycle to cycle, from a clock that may jump, stand or run backwards.
/// Heap: none. Thread: one. Cost: fixed. Errors: none.
class CycleTime {
 public:
  struct Tick {
    double dt_s;      // since the last cycle; 0 for the first and for a clock that did not advance
    double ageing_s;  // by which inputs age; then one nominal cycle: no clock hides a lost input
  };

  Tick tick(std::int64_t now_ns, double cycle_s) noexcept {
    const bool advanced = started_ && now_ns > last_ns_;
    const auto passed = static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(last_ns_);
    last_ns_ = now_ns;
    started_ = true;
    const double dt_s = advanced ? 1e-9 * static_cast<double>(passed) : 0.0;
    return {dt_s, advanced ? dt_s : cycle_s};
  }

 private:
  std::int64_t last_ns_ = 0;
  bool started_ = false;
};

}  // namespace plumb
