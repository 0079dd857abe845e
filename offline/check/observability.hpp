// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace plumb::offline {

/// How well poses show parameters, from the singular values s_1 >= ... >= s_m of a scaled Jacobian
/// [Sun, Hollerbach 2008]; more is better. All 0 if a singular value is 0.
struct Observability {
  double O1 = 0.0;  // (s_1 ... s_m)^(1/m) / sqrt(n), n poses [Borm, Menq 1989]
  double O2 = 0.0;  // s_m / s_1 [Driels, Pathre 1990]
  double O3 = 0.0;  // s_m [Nahvi, Hollerbach 1994]
  double O4 = 0.0;  // s_m^2 / s_1 [Nahvi, Hollerbach 1996]
  double O5 = 0.0;  // 1 / (1/s_1 + ... + 1/s_m) [Sun, Hollerbach 2008]
};

/// s: not empty, >= 0, descending.
Observability observability(const Eigen::VectorXd& s, int poses);

}  // namespace plumb::offline
