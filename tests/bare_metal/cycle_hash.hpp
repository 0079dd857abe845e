// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/runtime/corrector.hpp"
#include "tests/bit_hash.hpp"
#include "tests/random_numbers.hpp"

/// The same inputs and one number for all outputs, on the board and on every other machine.
namespace plumb::bare_metal {

inline constexpr int kCycles = 1000;
inline constexpr std::uint64_t kSeed = 13;

/// Of the predictions and corrections of tests::cycle_model(). All machines agree on
/// it; it changes when the cycle's arithmetic does, and test_bare_metal_hash prints the new one.
inline constexpr std::uint64_t kHash = 0x2c3290270efc1ba3U;

struct Input {
  std::array<double, 6> q{};     // [rad]
  std::array<double, 6> seed{};  // near it
  Context context;
};

inline Input draw(tests::Random& random) {
  Input out;
  for (std::size_t i = 0; i < out.q.size(); ++i) {
    out.q[i] = random.uniform(-2.7, 2.7);
    out.seed[i] = out.q[i] + random.uniform(-0.01, 0.01);
    out.context.direction[i] = random.below(2) == 0 ? -1.0 : 1.0;
  }
  return out;
}

/// Runs kCycles cycles. `predicting` and `correcting` call what they are given, once; they may
/// measure it.
template <class Predicting, class Correcting>
std::uint64_t hash_of_cycles(const Corrector& corrector, Predicting predicting,
                             Correcting correcting) {
  tests::Random random(kSeed);
  tests::BitHash hash;
  for (int i = 0; i < kCycles; ++i) {
    const Input in = draw(random);
    Prediction prediction;
    predicting([&] { prediction = corrector.forward_model().predict(in.q, in.context); });
    Correction correction;
    correcting([&] {
      correction = corrector.solve(prediction.X_BT, in.seed, SeedKind::kMeasured, in.context);
    });
    hash.add(prediction.X_BT);
    hash.add(correction.X_BC);
    hash.add(static_cast<double>(correction.status));
  }
  return hash.value();
}

}  // namespace plumb::bare_metal
