// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "arm/context_needs.hpp"
#include "effects/measured_context.hpp"
#include "plumb/runtime/detail/known_range.hpp"
#include "plumb/runtime/status.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// Decides for each row whether a prediction can be trusted: whether the row lies inside the range
/// that the model was fitted with, and has every input that an effect needs. Counts rows that do
/// not, for one warning of each kind.
class KnownInputs {
 public:
  explicit KnownInputs(const format::Model& model);

  /// q: shape (joints,). `placed`: whether the row has a place in the cell's own series
  /// (SeriesPlace); rows of a compiled model need none. Returns the worse of `said`, the status of
  /// the prediction, and of what is found here: refused, outside-domain, context-fallback, ok.
  Status mark(std::span<const double> q, const MeasuredContext& at, bool placed, Status said);

  /// Rows that an effect needs a place of in the cell's own series, while nothing tells it.
  int without_place() const;

  /// Adds the counts of another object of the same model.
  void add(const KnownInputs& more);

  /// W-PREDICT-INPUT and W-PREDICT-OUTSIDE, or none.
  std::vector<Problem> remarks() const;

 private:
  struct LackingInput {
    ContextWant want;
    int rows = 0;
  };
  struct OutsideRange {
    int rows = 0;
    double farthest = 0.0;  // largest distance from the middle of the range
    double value = 0.0;     // the value at that distance
  };

  bool lacks(const ContextWant& want, const MeasuredContext& at, bool placed) const;
  void look_beyond(std::span<const double> q, const Context& at);
  void note(double value, double low, double high, OutsideRange& out) const;
  static void add(const std::vector<OutsideRange>& more, std::vector<OutsideRange>& out);
  std::string assumed(const ContextWant& want) const;
  Problem of_lacks() const;
  Problem of_outside() const;

  KnownRange known_;
  format::Domain domain_;
  std::vector<format::JointRow> joints_;
  double payload_kg_;
  std::vector<LackingInput> lacks_;
  std::vector<OutsideRange> joint_beyond_, context_beyond_;
  int rows_ = 0;
  int outside_ = 0;
};

}  // namespace plumb::offline
