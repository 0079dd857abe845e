// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "simulate/law.hpp"
#include "simulate/simulation.hpp"
#include "simulate/simulation_plan.hpp"

namespace plumb::offline::sim {

/// For each row, the row of the first reading of its pose.
std::vector<std::size_t> first_readings(const std::vector<int>& pose_of_row);

/// The tracker and its file. It decides the rows, their names, and the noise.
class Recording {
 public:
  /// `poses` are the distinct poses. Every tenth is measured plan.repeats times in place, and
  /// plan.revisits of them, evenly picked, once more at the end.
  Recording(const Cell& cell, const SimulationPlan& plan, const RowsN& poses,
            const std::vector<HiddenEffect>& effects);

  int rows() const { return measured_.size(); }
  const RowsN& joint_rows() const { return measured_.q; }
  const std::vector<int>& pose_of_row() const { return measured_.replicate_group; }

  /// Measures point and orientation of the reflector for one row and adds noise. The rows must be
  /// measured in order.
  void measure(int row, const Isometry3d& X_MG);

  /// Turns plan.outlier_share of the rows into gross outliers and returns them, sorted by row.
  std::vector<GrossOutlier> spoil();

  /// The context columns: time and payloads, and the directions of arrival and temperatures if they
  /// are requested or needed by an effect.
  std::vector<Column> context(const std::vector<Visit>& visits) const;

  /// The recorded joint positions are rounded here, if plan.imperfections says so.
  MeasurementFiles finish(const std::vector<Column>& context) const;

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
