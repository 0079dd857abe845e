// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cell/measurements.hpp"
#include "plumb/format/model.hpp"
#include "program/problem.hpp"

namespace plumb::offline::cli {

/// Looks at all joint readings and warns if columns in degrees seem to hold radians: no angle is
/// beyond 2 pi degrees, the model was fitted over tens of degrees, and read as radians nearly all
/// rows lie within what it was fitted with.
class JointUnits {
 public:
  explicit JointUnits(const format::Model& model);

  /// Takes the name of the first joint's column, "q1_deg".
  void name_column(const Table& rows);

  /// q [rad] or [m], shape (joints,), as read with the unit that the file states.
  void add(std::span<const double> q);
  void add(const JointUnits& more);

  /// W-PREDICT-RADIANS, or none.
  std::optional<Problem> remark() const;

 private:
  struct Range {
    bool turns = false;
    double low = 0.0, high = 0.0;  // of the fit, and a little more [rad]
  };
  std::vector<Range> ranges_;
  std::string column_ = "q1_deg";
  bool wide_ = false;  // the model was fitted over tens of degrees
  std::size_t rows_ = 0, large_ = 0, inside_ = 0;
};

}  // namespace plumb::offline::cli
