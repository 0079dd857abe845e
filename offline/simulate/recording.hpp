// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "simulate/law.hpp"

namespace plumb::offline::sim {

/// The tracker and its file: which rows there are, their names, and the noise.
class Recording {
 public:
  /// `poses` are the distinct ones; every tenth is written plan.repeats times.
  Recording(const Cell& cell, const SimulationPlan& plan, const RowsN& poses);

  int rows() const { return measured_.size(); }
  const RowsN& joint_rows() const { return measured_.q; }

  /// Row by row, in order: point and orientation of the reflector, noise added.
  void measure(int row, const Isometry3d& X_MG);

  /// t_s, and how each joint arrived where asked for or needed by a hidden effect.
  std::vector<Column> context(const std::vector<Visit>& visits) const;

  Measurements finish(const std::vector<Column>& context) const;

 private:
  const Cell& cell_;
  const SimulationPlan& plan_;
  Random noise_;
  Measurements measured_;
};

}  // namespace plumb::offline::sim
