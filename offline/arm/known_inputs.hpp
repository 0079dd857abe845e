// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "arm/context_needs.hpp"
#include "effects/measured_context.hpp"
#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/detail/known_range.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Watches rows go by, and says of each what a prediction there is worth: whether it lies outside
/// what the model was fitted with, and whether it lacks what an effect needs. One warning of each
/// kind at the end, however many rows there were.
class KnownInputs {
 public:
  explicit KnownInputs(const format::Model& model);

  /// q: shape (joints,). `placed`: whether the row has a place in the cell's own series
  /// (SeriesPlace); rows of a compiled model need none. Returns what counts more, `said` or what is
  /// found: refused, outside-domain, context-fallback, ok.
  Status mark(std::span<const double> q, const MeasuredContext& at, bool placed, Status said);

  /// Whether the context alone, whatever the joints, lies so far outside that the correction has
  /// faded to nothing.
  bool beyond_correction(const Context& at) const;

  /// Rows whose place in the cell's own series an effect needs and nothing tells.
  int without_place() const;

  /// Counts what another one of the same model has seen.
  void add(const KnownInputs& more);

  /// W-PREDICT-INPUT and W-PREDICT-OUTSIDE, or none.
  std::vector<Problem> remarks() const;

 private:
  struct Lack {
    ContextWant want;
    int rows = 0;
  };
  struct Beyond {
    int rows = 0;
    double farthest = 0.0;  // from the middle
    double value = 0.0;
  };

  bool lacks(const ContextWant& want, const MeasuredContext& at, bool placed) const;
  void look_beyond(std::span<const double> q, const Context& at);
  void note(double value, double low, double high, Beyond& out) const;
  static void add(const std::vector<Beyond>& more, std::vector<Beyond>& out);
  std::string assumed(const ContextWant& want) const;
  Problem of_lacks() const;
  Problem of_outside() const;

  KnownRange known_;
  format::Domain domain_;
  std::vector<format::JointRow> joints_;
  double payload_kg_;
  std::vector<Lack> lacks_;
  std::vector<Beyond> joint_beyond_, context_beyond_;
  int rows_ = 0;
  int outside_ = 0;
};

/// Whether the guard would cut this correction to its size.
bool beyond_guard(const Transformd& X_BD, const Transformd& X_BC,
                  const format::GuardLimits& limits);

/// A correction as the guard lets it through once it has settled: cut to its largest size, and then
/// marked kLimited. Refused ones as they are.
Correction guarded(const Correction& correction, const Transformd& X_BD,
                   const format::GuardLimits& limits);

}  // namespace plumb::offline
