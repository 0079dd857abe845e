// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// Noise of a whitened coordinate and the data it is judged against.
struct EvidenceScale {
  double variance = 1.0;  // s^2, of the noise
  double dof = 4.0;       // behind it
  double lines = 0.0;     // independent coordinates: lines less rank of the model
};

/// ln B of columns that must not be chosen: their sign is wrong, or they are not finite.
inline constexpr double kImpossible = -1e6;

/// Evidence for one block of columns over none.
struct Evidence {
  double ln_bayes = 0.0;  // ln of the mean of B over the widths of the prior
  double width = 1.0;     // the width with the largest B: 1 is the typical size
};

/// Bayes factor of columns X with effects theta ~ N(0, tau^2 I), tau on {0.1, 0.3, 1, 3, 10, 30},
/// and noise of a scaled inverse chi^2 around s^2, the residual y and X being cleared of the model:
///
///   ln B = -1/2 sum ln(1 + w_i tau^2 / s^2)
///          - (n + nu)/2 ln[(nu s^2 + Q - sum u_i^2 / (w_i + s^2 / tau^2)) / (nu s^2 + Q)]
///
/// with X^T X = V diag(w) V^T, u = V^T X^T y, Q = y^T y, n = scale.lines and nu = scale.dof.
/// Columns are scaled so that 1 is a typical size; many parameters are penalised for their
/// flexibility. [Bishop 2006, 3.4; Kass & Raftery 1995]
///
/// Without columns, as of a law that moves nothing at these poses, it is 0.
///
/// @param gram  X^T X, shape (b, b).
/// @param v     X^T y, shape (b,).
/// @param Q     y^T y.
Evidence evidence(const Eigen::MatrixXd& gram, const Eigen::VectorXd& v, double Q,
                  const EvidenceScale& scale);

}  // namespace plumb::offline
