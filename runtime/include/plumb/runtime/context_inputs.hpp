// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "plumb/runtime/context.hpp"
#include "plumb/runtime/detail/age.hpp"
#include "plumb/runtime/detail/last_move.hpp"

namespace plumb {

/// A reading that arrives with a cycle: its value and how long ago it was taken [s].
/// If the age is NaN, nothing has arrived: the previous reading stays valid and grows older.
struct Reading {
  double value = kUnknown;
  double age_s = kUnknown;
};

/// The readings that may arrive with a cycle. SI units, temperatures in [degC].
struct ContextReadings {
  Reading payload_kg;
  std::array<double, 3> payload_com_m{kUnknown, kUnknown, kUnknown};  // flange frame; read only
                                                                      // if payload_kg arrived
  std::array<Reading, format::kMaxTemperatures> temperature_degC;     // in temperature_name's order
  Reading time_s;  // process time; it runs on by itself between two readings
};

/// How old a reading may be [s]. A limit that is NaN accepts no reading.
struct ContextLimits {
  double payload_s = std::numeric_limits<double>::max();  // valid until the next gripper event
  double temperature_s = 60.0;  // an arm warms up over an hour; sensors report every second
  double time_s = 60.0;
};

/// Keeps the last reading of every input with its age, and makes the Context of the cycle from
/// them.
///
/// An input that never arrived, is too old, is not finite or exceeds kMaxReading is kUnknown in the
/// Context; each effect then uses its declared fallback, and the status is kContextFallback.
/// Heap: none. Thread: one. Cost: fixed. Errors: none; every bit pattern is allowed.
class ContextInputs {
 public:
  /// Larger values are rejected: no physical quantity in SI units, and no time since 1970 in
  /// seconds, reaches it.
  static constexpr double kMaxReading = 1e12;

  explicit ContextInputs(const ContextLimits& limits) noexcept : limits_(limits) {}

  /// To be called once a cycle: takes the readings that arrived and lets all others grow older by
  /// ageing_s [s].
  void step(const ContextReadings& came, double ageing_s) noexcept;

  /// The context as known now, with the directions and travels of the first `joints` joints.
  Context context(const LastMove& move, int joints) const noexcept;

 private:
  struct Input {
    double value = kUnknown;
    Age age;
    bool step(const Reading& came, double ageing_s) noexcept;
    double now(double limit_s) const noexcept;
  };

  ContextLimits limits_;
  Input payload_kg_;
  std::array<double, 3> payload_com_m_{kUnknown, kUnknown, kUnknown};
  std::array<Input, format::kMaxTemperatures> temperature_degC_;
  Input time_s_;
};

}  // namespace plumb
