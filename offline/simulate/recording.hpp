// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "simulate/law.hpp"

namespace plumb::offline::sim {

/// The tracker and its file: which rows there are, their names, and the noise.
class Recording {
 public:
  /// `poses` are the distinct ones; every tenth is written plan.repeats times.
  Recording(const Cell& cell, const SimulationPlan& plan, const RowsN& poses,
            const std::vector<HiddenEffect>& effects);

  int rows() const { return measured_.size(); }
  const RowsN& joint_rows() const { return measured_.q; }

  /// Row by row, in order: point and orientation of the reflector, noise added.
  void measure(int row, const Isometry3d& X_MG);

  /// Moves plan.outlier_share of the rows far away and says which, by row.
  std::vector<GrossOutlier> spoil();

  /// t_s; payloads; how each joint arrived and temperatures where asked for or needed by an effect.
  std::vector<Column> context(const std::vector<Visit>& visits) const;

  Measurements finish(const std::vector<Column>& context) const;

 private:
  void add_temperatures(std::vector<Column>& out, const std::vector<Visit>& visits) const;
  void add_directions(std::vector<Column>& out, const std::vector<Visit>& visits) const;

  const Cell& cell_;
  const SimulationPlan& plan_;
  const std::vector<HiddenEffect>& effects_;
  Random noise_;
  Measurements measured_;
};

}  // namespace plumb::offline::sim
