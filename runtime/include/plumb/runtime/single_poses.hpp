// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/detail/known_range.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb {

/// Whether this correction exceeds the limits of the guard.
bool beyond_guard(const Transformd& X_BD, const Transformd& X_BC,
                  const format::GuardLimits& limits) noexcept;

/// The correction that the guard outputs once its slew limit has settled: scaled down to the
/// largest allowed size and marked kLimited if it exceeds that. Refused corrections are returned
/// unchanged.
Correction guarded(const Correction& correction, const Transformd& X_BD,
                   const format::GuardLimits& limits) noexcept;

/// Predicts and corrects poses one at a time, without a cycle and its state: `correct` gives what
/// the cycle outputs in the end while target, joints and context stay as they are. Lists of poses
/// are answered with it, those of files and those of arrays.
///
/// Pure: no state, no heap, fixed cost for a given model; any thread. Refers to the model's memory:
/// the model must outlive it.
class SinglePoses {
 public:
  explicit SinglePoses(const format::Model& model) noexcept;

  const Corrector& corrector() const noexcept { return corrector_; }

  /// As ForwardModel::predict. Status: also kOutsideDomain where the pose or its context lies
  /// outside what the model was fitted with, and kLimited where the arm is farther from its nominal
  /// pose than the guard lets a correction be; the prediction is whole even so.
  Prediction predict(std::span<const double> q, const Context& context) const noexcept;

  /// As Corrector::solve, cut to the size that the guard allows. A sound target that is refused
  /// because the context lies so far outside that every correction has faded to zero is answered
  /// with itself and kOutsideDomain.
  Correction correct(const Transformd& X_BD, std::span<const double> seed, SeedKind kind,
                     const Context& context) const noexcept;

 private:
  bool faded_everywhere(const Context& context) const noexcept;

  Corrector corrector_;
  KnownRange known_;
  std::array<double, kMaxJoints> middle_{};  // of the trained box
};

}  // namespace plumb
