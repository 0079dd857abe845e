// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cell/measurements.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline {

/// Where an arm stands, with its frame loosened to any linear map M: p_BT = M p_M + b - R_BT t,
/// t being the reflector in the tool frame. Loosened, it is linear least squares: the exact frame
/// shows as M = s R, s the ratio of the two length units, det < 0 a left-handed file.
struct LinearPlacement {
  double misfit = 0.0;  // RMS of what is left, over s and the RMS size of the measured cloud
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();         // columns of missing axes are zero
  Eigen::Vector3d target_T = Eigen::Vector3d::Zero();  // in the unit of the arm
  double ratio = 0.0;                                  // s
  bool left_handed = false;
  double left = 0.0;  // sum of squares, in the unit of the arm
};

/// The measured side of the problem, prepared once for many arms.
class LinearPlacer {
 public:
  /// p_M: shape (n, 3), n >= 8.
  LinearPlacer(const Rows3& p_M, const std::array<bool, 3>& has_axis);

  /// X_BT: tool poses of the n rows. Cost: about 60 n multiplications; no allocation after the
  /// first call.
  LinearPlacement place(const std::vector<Transformd>& X_BT);

  /// The misfit of `place`, to 1e-6, in a quarter of the time: to pass over what fits no better.
  double quick_misfit(const std::vector<Transformd>& X_BT) const;

  /// Adds the distance of M from the nearest s R to the misfit: any linear map could hide, for
  /// example, a sliding joint in the wrong unit. Cost: a 3 x 3 singular value decomposition.
  void tighten(LinearPlacement& placement) const;

 private:
  Eigen::Index axes_ = 0;
  std::array<int, 3> axis_{};                         // measured axes
  Eigen::Matrix3d spread_ = Eigen::Matrix3d::Zero();  // covariance of the measured cloud
  double size_ = 0.0;                                 // RMS distance from the mean
  using Columns4 = Eigen::Matrix<double, 4, Eigen::Dynamic>;
  Columns4 rows_;                 // the rows of the basis, with zeros up to four
  Eigen::MatrixXd basis_;         // orthonormal, of (p_M, 1); shape (n, axes + 1)
  Eigen::MatrixXd to_map_;        // coefficients of (p_M, 1) from those of the basis
  Eigen::MatrixXd sides_;         // p_x p_y p_z, then the rows of R_BT; shape (n, 12)
  Eigen::MatrixXd coefficients_;  // of the sides on the basis
};

}  // namespace plumb::offline
