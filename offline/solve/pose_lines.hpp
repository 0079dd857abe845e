// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/geometry_derivative.hpp"
#include "arm/parameter.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Rows that one thread evaluates as one job.
inline constexpr int kRowsOfOneThread = 256;

/// The measured poses as lines of a least-squares problem: their whitened residuals, pose by pose,
/// and the derivatives of these.
class PoseLines {
 public:
  /// Keeps references to both.
  PoseLines(const FitData& data, const std::vector<Parameter>& parameters)
      : data_(data), parameters_(parameters), slopes_(data.touches.slopes_of(parameters)) {}

  /// A row, and the effect that has no value there; -1 if all effects have one.
  struct Undefined {
    int row = -1, effect = -1;
  };

  /// Writes the residuals of data.rows[first] up to but without data.rows[last], and unless
  /// `jacobian` is null their derivatives, row by row. May be called from any thread.
  Undefined evaluate(const GeometryDerivative& geometry, int first, int last, double* residual,
                     double* jacobian) const;

 private:
  void read_point(ReadingKind kind, const ArmState& state, int setup,
                  GeometryDerivative::Point& point) const;

  const FitData& data_;
  const std::vector<Parameter>& parameters_;
  Eigen::RowVectorXd slopes_;  // of data.touches
};

}  // namespace plumb::offline
