// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/context_ranges.hpp"
#include "plumb/format/model.hpp"
#include "plumb/runtime/context.hpp"

namespace plumb {

/// The ranges of joints and context that the model was fitted with, and how far beyond them a
/// correction may be trusted.
///
/// Joints: the trained box, widened by kEdge, because poses chosen like those of the fit often lie
/// a degree or two outside their box. Beyond it the correction is unchanged for one step of `fade`
/// spans (at least kLeastStep), then fades smoothly to zero over kFadingSteps further steps.
/// Context: the ranges in the model, each widened by a margin (5 K; a tenth of the payload). Beyond
/// it the correction is unchanged for one step, which is as wide as the range but at least 10 K or
/// half the payload, and fades in the same way. An unknown input counts as inside, because its
/// fallback is used. For a model without box and ranges nothing is outside.
///
/// Heap: none. Cost: fixed for a given model. Any thread. Does not refer to the model.
class KnownRange {
 public:
  /// [rad]; for prismatic joints times length_scale_m. Chosen: 2 deg.
  static constexpr double kEdge = 0.035, kLeastStep = 0.035;
  /// Chosen: the correction fades over several times the way on which it is still unchanged.
  static constexpr double kFadingSteps = 5.0;

  struct Found {
    bool outside = false;
    double weight = 1.0;  // factor on the correction: 1 inside and near by, 0 far outside
  };

  KnownRange() = default;
  explicit KnownRange(const format::Model& model) noexcept;

  /// Finds out whether a pose is outside. q: shape (n,) [rad] or [m], finite. `context`: the one
  /// that the effects of the model are given.
  Found look(std::span<const double> q, const Context& context) const noexcept;

  /// True if this joint, or the input of range number `range` of the model, is outside.
  bool joint_outside(std::size_t joint, double q) const noexcept;
  bool context_outside(std::size_t range, const Context& context) const noexcept;

  /// The input in the context that range number `range` of the model is about; NaN if unknown.
  double value(std::size_t range, const Context& context) const noexcept;

 private:
  static constexpr std::size_t kRoom = 12;  // kMaxJoints, rounded up to whole registers
  struct Range {
    std::size_t place = 0;  // index of the input in the context, counted in doubles
    double mid = 0.0;
    double half = 0.0;
    double per_step = 0.0;
  };

  void add_joint(const format::Model& model, std::size_t i) noexcept;
  void add_range(const format::Model& model, const format::ContextRange& range) noexcept;

  std::size_t joints_ = 0;
  std::size_t ranges_ = 0;
  std::array<double, kRoom> mid_{};
  std::array<double, kRoom> half_{};      // half width of the box, kEdge included
  std::array<double, kRoom> per_step_{};  // 1 / step [1/rad] or [1/m]
  std::array<Range, format::kMaxContextRanges> context_{};
};

}  // namespace plumb
