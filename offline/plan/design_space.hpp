// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// The parameters of a cell and what poses tell about them. Parameters are scaled by the largest
/// deviation that is expected (`width`), so that each has a prior of 1 sigma = 1.
struct DesignSpace {
  const Cell* cell = nullptr;
  ArmState state;  // where the derivatives are taken; carries the effects
  std::vector<Parameter> parameters;
  Eigen::VectorXd width;  // SI value that counts as 1
  double sigma_m = 0.0;   // 1 sigma per axis
  double sigma_rad = 0.0;
  std::array<bool, 3> has_axis{true, true, true};

  Eigen::Index size() const { return static_cast<Eigen::Index>(parameters.size()); }
  Eigen::VectorXd prior() const { return Eigen::VectorXd::Ones(size()); }
  int per_pose() const;

  /// Whitened derivatives, shape (rows * per_pose, parameters). Positions are not looked at.
  Eigen::MatrixXd lines(const Measurements& at) const;

  /// Numbers of the parameters of the effect in that place of the model.
  std::vector<Eigen::Index> columns_of_effect(int effect) const;
};

/// Geometry, frame, target and the effects that `state` carries. 5 mm and 5 mrad count as 1, frame
/// and target 1 m and 1 rad, an effect what moves the points of `typical` by 5 mm RMS. Parameters
/// that move nothing there are left out.
DesignSpace design_space(const Cell& cell, const ArmState& state, const Measurements& typical,
                         double sigma_m, double sigma_rad);

/// Poses that could be measured after `measured`: directions, steps and payload as they may come,
/// temperatures the mean of those measured (20 degC if none), time and order behind the last one.
Measurements imagined(const Cell& cell, const Measurements& measured, const RowsN& q,
                      std::uint64_t seed);

/// Nothing measured yet, but every axis would be.
Measurements nothing_measured(const Cell& cell);

}  // namespace plumb::offline
