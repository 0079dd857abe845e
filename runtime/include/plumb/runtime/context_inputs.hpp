// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "plumb/runtime/age.hpp"
#include "plumb/runtime/context.hpp"
#include "plumb/runtime/last_move.hpp"

namespace plumb {

/// A reading that comes with a cycle: its value and how long ago it was taken [s].
/// Without an age nothing has come: the reading before stands and grows older.
struct Reading {
  double value = kUnknown;
  double age_s = kUnknown;
};

/// What may come with a cycle, SI, temperatures in [degC].
struct ContextReadings {
  Reading payload_kg;
  std::array<double, 3> payload_com_m{kUnknown, kUnknown, kUnknown};  // with the payload, flange
  std::array<Reading, format::kMaxTemperatures> temperature_degC;     // as temperature_name counts
  Reading time_s;  // process time; runs on by itself between two readings
};

/// How old a reading may be [s]; a limit that is no number allows nothing.
struct ContextLimits {
  double payload_s = std::numeric_limits<double>::max();  // stands until the next gripper event
  double temperature_s = 60.0;  // an arm warms up over an hour; sensors report every second
  double time_s = 60.0;
};

/// The context of the cycle: each input with its validity and age.
///
/// An input that never came, is too old, not finite, or beyond kMaxReading is kUnknown in the
/// Context; each effect then uses its declared fallback, and the status says kContextFallback.
/// Heap: none. Thread: one. Cost: fixed. Errors: none; every bit pattern is allowed.
class ContextInputs {
 public:
  /// Nothing physical in SI, nor seconds since 1970, is larger.
  static constexpr double kMaxReading = 1e12;

  explicit ContextInputs(const ContextLimits& limits) noexcept : limits_(limits) {}

  /// Once a cycle: what came, and by how much the others aged [s].
  void step(const ContextReadings& came, double ageing_s) noexcept;

  /// What is known now, with the directions and travels of the first `joints` joints.
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
