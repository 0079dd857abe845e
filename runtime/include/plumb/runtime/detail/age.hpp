// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

namespace plumb {

/// The age of one input: how long ago it last arrived [s], infinite before it first arrives.
/// Heap: none. Thread: one. Cost: fixed. Errors: none; an age that is negative or NaN counts as
/// "never arrived".
class Age {
 public:
  /// The input arrived, `age_s` seconds ago.
  void renew(double age_s = 0.0) noexcept { age_s_ = age_s >= 0.0 ? age_s : kNever; }

  /// Lets the input grow older by dt_s.
  void advance(double dt_s) noexcept { age_s_ += dt_s; }

  /// True if the input is at most limit_s old. False if it never arrived or limit_s is NaN.
  bool within(double limit_s) const noexcept { return age_s_ <= limit_s && age_s_ < kNever; }

  double value_s() const noexcept { return age_s_; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  double age_s_ = kNever;
};

/// Measures the time between cycles on a clock that may jump, stand still or run backwards.
/// Heap: none. Thread: one. Cost: fixed. Errors: none.
class CycleTime {
 public:
  struct Tick {
    double dt_s;      // time since the last cycle; 0 in the first, or if the clock did not advance
    double ageing_s;  // dt_s, or one nominal cycle where dt_s is 0, so that inputs always age
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
