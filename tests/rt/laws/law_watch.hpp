// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "tests/rt/laws/planted_guard.hpp"
#include "tests/rt/laws/random_life.hpp"

namespace plumb::tests {

/// Thrown with the law's words.
struct BrokenLaw : std::logic_error {
  using std::logic_error::logic_error;
};

/// What was looked at.
struct LawTally {
  std::uint64_t cycles = 0;     // predict, solve and guard step each
  std::uint64_t lives = 0;      // models
  std::uint64_t corrected = 0;  // of the cycles, solved and not refused
  std::uint64_t invented = 0;   // the guard was given something made up instead
  std::uint64_t repeated = 0;   // solved twice, bit for bit
  std::uint64_t stale = 0;      // inputs said to be too old
  std::uint64_t swapped = 0;    // other limits from here on
  std::uint64_t held = 0;       // no target: the last output
  std::uint64_t limited = 0;    // cut by size or slew
  std::uint64_t decays = 0;     // refused until nothing was left
  LawTally& operator+=(const LawTally& other);
};

/// One guard's life, watched from outside against the limits of its model alone:
///  * every output, prediction and correction is finite;
///  * the correction on top of the present target stays within its size limits, or, after a swap to
///    narrower ones, never grows;
///  * from cycle to cycle it changes by slew x dt at most, dt cut to 0 .. 2 cycles;
///  * a refusal is passed on; refusals alone leave exactly the target, bit for bit, after as many
///    cycles as the limits say, and stale inputs alone after as many more as the ramp takes;
///  * no output before the first valid cycle;
///  * without a target the last output stands, bit for bit;
///  * solve() takes the same steps and gives the same bits for the same input; when it refuses, the
///  target itself; else a
///    residual and a distance from the seed within their limits.
class LawWatch {
 public:
  LawWatch(std::uint64_t seed, Plant plant, LawTally& tally);

  /// One cycle, now and then a decay after it. Throws BrokenLaw.
  void cycle();

 private:
  struct Added {
    Vector3 p = Vector3::Zero();  // [m]
    Vector3 r = Vector3::Zero();  // rotation vector [rad]
    double slack_m = 0.0;         // what rounding on top of a far target may hide
  };

  Correction correction_for(const CycleInput& input);
  void check_prediction(const CycleInput& input) const;
  void check_solved(const CycleInput& input, const Correction& correction);
  void check_output(const CycleInput& input, const Correction& correction, const GuardOutput& out);
  void check_held(const GuardOutput& out) const;
  void check_bounds(const Added& now, double dt_s) const;
  int cycles_to_decay(Guard::Inputs age) const;
  void decay(Guard::Inputs age);
  void swap();
  double elapsed(double dt_s) const;
  static Added added(const Transformd& X_BC, const Transformd& X_BD);

  format::Model model_;
  format::GuardLimits limits_;
  Corrector corrector_;
  RandomInputs inputs_;
  PlantedGuard guard_;
  LawTally& tally_;
  CycleInput input_;
  Added before_;
  Transformd last_;
  int steps_ = 0;       // of the first solve()
  bool valid_ = false;  // there has been a valid cycle
};

}  // namespace plumb::tests
