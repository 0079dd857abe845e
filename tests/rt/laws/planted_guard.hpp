// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "plumb/runtime/guard.hpp"

namespace plumb::tests {

/// A defect that the laws must catch. kNone: the guard itself.
enum class Plant : std::uint8_t {
  kNone,
  kSlew,     // the slew limits are forgotten
  kSize,     // once in kRare cycles the size limit is
  kFinite,   // and so a NaN gets out
  kHold,     // without a target the present one is passed on
  kEarly,    // output before the first valid cycle
  kResidue,  // a refused correction decays to nearly nothing
  kImpure    // solve() depends on what was before
};

/// By name; kNone for the empty one, throws std::invalid_argument for others.
Plant plant_named(std::string_view name);

/// A guard with such a defect.
class PlantedGuard {
 public:
  PlantedGuard(const format::GuardLimits& limits, Plant plant)
      : plant_(plant), limits_(limits), guard_(planted(limits)) {}

  GuardOutput step(const Transformd& X_BD, const Correction& correction, double dt_s,
                   Guard::Inputs age);
  void swap(const format::GuardLimits& limits);
  void enable(Guard::Enable on) { guard_.enable(on); }
  Correction spoiled(Correction correction) const;

 private:
  static constexpr std::uint64_t kRare = 1000;

  format::GuardLimits planted(format::GuardLimits limits) const;

  Plant plant_;
  format::GuardLimits limits_;
  Guard guard_;
  std::uint64_t steps_ = 0;
  int refused_in_a_row_ = 0;
};

}  // namespace plumb::tests
