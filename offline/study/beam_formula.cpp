// SPDX-License-Identifier: Apache-2.0
#include "study/beam_formula.hpp"

#include <cmath>
#include <numbers>

#include "numbers/pivoted_qr.hpp"

namespace plumb::offline::study {
namespace {

constexpr double kDiameter_m = 0.060;  // as printed in the study
constexpr double kYoung_Pa = 210e9;

/// The deflection of the printed bars for 1 / EI = 1. The formula is proportional to 1 / EI.
Samples deflection_of_one(const RowsN& q) {
  const double EI = kYoung_Pa * std::numbers::pi * std::pow(kDiameter_m, 4) / 64.0;
  Samples out(q.rows(), 2);
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    out.row(i) = EI * planar_deflection(PlanarVariant::kPrinted, q(i, 0), q(i, 1)).transpose();
  return out;
}

}  // namespace

BeamFormula fit_beams(const PlanarPoses& measured) {
  const Eigen::Index n = measured.q.rows();
  const Samples bent = deflection_of_one(measured.q);
  const double scale = bent.norm();
  Eigen::MatrixXd A(2 * n, 5);
  Eigen::VectorXd b(2 * n);
  for (int k = 0; k < 4; ++k) {
    const Samples column = rigid_points(Links::Unit(k), measured.q);
    A.col(k) << column.col(0), column.col(1);
  }
  A.col(4) << bent.col(0) / scale, bent.col(1) / scale;
  b << measured.p_AC_A.col(0), measured.p_AC_A.col(1);
  const Eigen::VectorXd x = PivotedQr(A).solve(b);
  return {x.head<4>(), x(4) / scale};
}

Samples points(const BeamFormula& model, const RowsN& q) {
  return rigid_points(model.d, q) + model.flexibility * deflection_of_one(q);
}

}  // namespace plumb::offline::study
